//! From derivatives of variables to directions in the Jacobian of the manipulator, and back.

use super::dependency::Known;
use super::derivative_role::DerivativeRole;
use super::host_values::{HostValues, UncheckedPose};
use super::neighbours::{Neighbours, mutual_wrenches};
use super::variable::{Index, Variable};
use crate::error::Error;
use crate::manipulator::{Input, Jacobian, Manipulator, Output};

/// The derivatives of inputs and parameters along a direction; those that are zero are left out.
pub(super) struct Direction<'a> {
    inputs: Vec<(&'a Variable, f64)>,
    parameters: Vec<(&'a Variable, f64)>,
}

impl<'a> Direction<'a> {
    /// The direction in which these variables have these derivatives.
    pub(super) fn of(knowns: &[&'a Variable], seed: &[f64]) -> Self {
        let moving = knowns.iter().copied().zip(seed.iter().copied()).filter(|(_, rate)| *rate != 0.0);
        // How accurately an equilibrium is computed does not move it.
        let moving = moving.filter(|(known, _)| known.known != Known::Accuracy);
        let (inputs, parameters) = moving.partition(|(known, _)| known.derivative_role.is_known());
        Self { inputs, parameters }
    }

    /// What of it moves or changes magnets and coils.
    fn of_sources(&self) -> Vec<(&'a Variable, f64)> {
        let all = self.inputs.iter().chain(&self.parameters).copied();
        all.filter(|(known, _)| known.known == Known::Source).collect()
    }
}

/// The equilibrium at which derivatives are taken.
pub(super) struct At<'a> {
    pub(super) jacobian: &'a Jacobian,
    pub(super) manipulator: &'a Manipulator,
    pub(super) values: &'a HostValues,
}

impl At<'_> {
    /// The derivatives of outputs along a direction.
    ///
    /// # Errors
    /// [`Error::NoDerivatives`] where the equilibrium does not change smoothly; those of values beside the present ones.
    pub(super) fn derivatives(
        &self,
        unknowns: &[&Variable],
        direction: &Direction,
    ) -> Result<Vec<f64>, Error> {
        let has = |of: fn(DerivativeRole) -> bool| unknowns.iter().any(|unknown| of(unknown.derivative_role));
        let along_jacobian = self.along_jacobian(&direction.inputs).ok_or_else(no_input)?;
        let rows = self.jacobian.along(&along_jacobian)?;

        let of_neighbours = has(|role| role == DerivativeRole::Neighbours) && !direction.inputs.is_empty();
        let along_inputs = of_neighbours
            .then(|| Neighbours::along(self.manipulator, self.values, &direction.inputs))
            .transpose()?;
        let of_shapes = has(|role| !matches!(role, DerivativeRole::MutualWrench(_)));
        let parameters = direction.parameters.iter().filter(|_| of_shapes);
        let by_parameters = parameters
            .map(|(parameter, rate)| Ok((Neighbours::by(self.manipulator, self.values, parameter)?, *rate)));
        let by_parameters: Vec<(Neighbours, f64)> = by_parameters.collect::<Result<_, Error>>()?;
        let of_sources = direction.of_sources();
        let wrenches =
            if of_sources.is_empty() || !has(|role| matches!(role, DerivativeRole::MutualWrench(_))) {
                Vec::new()
            } else {
                mutual_wrenches(self.values, &of_sources)?
            };

        let derivative = |unknown: &&Variable| {
            let by_inputs = match unknown.derivative_role {
                DerivativeRole::MutualWrench(part) => {
                    let Index { item, component } = unknown.index;
                    return Some(wrenches.get(item).map_or(0.0, |wrench| part.of(wrench)[component]));
                }
                DerivativeRole::Neighbours => {
                    along_inputs.as_ref().map_or(Some(0.0), |along| along.derivative(unknown))
                }
                _ => self.of_row(rows.as_slice(), unknown),
            };
            by_parameters.iter().try_fold(by_inputs?, |sum, (neighbours, rate)| {
                Some(sum + rate * neighbours.derivative(unknown)?)
            })
        };
        unknowns.iter().map(|unknown| derivative(unknown).ok_or_else(|| no_output(unknown))).collect()
    }

    /// The direction in the space of the manipulator's inputs in which variables with these derivatives move; `None` if one of
    /// them is no input.
    ///
    /// A quaternion stands for the rotation that it describes when it is normalised, one that is not connected for its start value.
    fn along_jacobian(&self, derivatives: &[(&Variable, f64)]) -> Option<Vec<f64>> {
        let mut direction = vec![0.0; self.jacobian.matrix().ncols()];
        let mut add = |input: Input, component: usize, derivative: f64| -> Option<()> {
            direction[self.jacobian.columns(input)?].get_mut(component).map(|entry| *entry += derivative)
        };
        for &(variable, derivative) in derivatives {
            let component = variable.index.component;
            match variable.derivative_role {
                DerivativeRole::Input(input) => add(input, component, derivative)?,
                DerivativeRole::InputQuaternion(input) => {
                    let mut quaternion_rate = [0.0; 4];
                    quaternion_rate[component] = derivative;
                    let spin = self.posed(input)?.spin(quaternion_rate);
                    (0..3).try_for_each(|axis| add(input, axis, spin[axis]))?;
                }
                _ => return None,
            }
        }
        Some(direction)
    }

    /// The pose whose rotation an input is.
    fn posed(&self, input: Input) -> Option<&UncheckedPose> {
        match input {
            Input::SourceRotation(number) => self.values.sources.get(number).map(|source| &source.pose),
            _ => Some(&self.values.base),
        }
    }

    /// The derivative of one output, taken from those of every row of the Jacobian; `None` if the variable is no output that
    /// has derivatives.
    fn of_row(&self, all: &[f64], variable: &Variable) -> Option<f64> {
        let rows = |output: Output| self.jacobian.rows(output).and_then(|rows| all.get(rows));
        let component = variable.index.component;
        match variable.derivative_role {
            DerivativeRole::Unaffected => Some(0.0),
            #[expect(clippy::cast_precision_loss, reason = "a centreline has far fewer points than 2^53")]
            DerivativeRole::ShareOfFeed { part, of } => {
                Some(rows(Output::FeedLength)?.first()? * part as f64 / of as f64)
            }
            DerivativeRole::Output(output) => rows(output)?.get(component).copied(),
            DerivativeRole::TipQuaternion => {
                let spin = nalgebra::Vector3::from_column_slice(rows(Output::TipRotation)?);
                Some(self.manipulator.outputs().tip.quaternion_rate(&spin)[component])
            }
            _ => None,
        }
    }
}

fn no_input() -> Error {
    Error::NoDerivatives("what moves is no input".into())
}

fn no_output(variable: &Variable) -> Error {
    Error::NoDerivatives(format!("{} is no continuous output", variable.name))
}

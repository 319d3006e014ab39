//! Where a variable stands in the Jacobian of the manipulator.

use super::host_values::HostValues;
use super::variable::Variable;
use crate::geometry::Pose;
use crate::manipulator::{Input, Jacobian, Output, Outputs};

/// How a variable takes part in the derivatives of outputs with respect to inputs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DerivativeRole {
    /// It takes no part: a fixed parameter, a constant, or an output about the solution process.
    None,
    /// An output that no input changes, so that its derivatives are 0.
    Unaffected,
    /// A component of an input of the manipulator.
    Input(Input),
    /// A component of the quaternion that describes this rotation.
    InputQuaternion(Input),
    /// A component of an output of the manipulator.
    Output(Output),
    /// A component of the quaternion of the tip.
    TipQuaternion,
}

impl DerivativeRole {
    /// Whether outputs have derivatives with respect to the variable.
    #[must_use]
    pub fn is_known(self) -> bool {
        matches!(self, Self::Input(_) | Self::InputQuaternion(_))
    }

    /// Whether the variable is an output that has derivatives.
    #[must_use]
    pub fn is_unknown(self) -> bool {
        matches!(self, Self::Unaffected | Self::Output(_) | Self::TipQuaternion)
    }
}

/// The direction in the space of the manipulator's inputs in which variables with these derivatives move; `None` if one of
/// them is no input.
///
/// A quaternion stands for the rotation that it describes when it is normalised.
pub(super) fn direction<'a>(
    jacobian: &Jacobian,
    values: &HostValues,
    derivatives: impl Iterator<Item = (&'a Variable, f64)>,
) -> Option<Vec<f64>> {
    let mut direction = vec![0.0; jacobian.matrix().ncols()];
    let mut add = |input: Input, component: usize, derivative: f64| -> Option<()> {
        direction[jacobian.columns(input)?].get_mut(component).map(|entry| *entry += derivative)
    };
    for (variable, derivative) in derivatives {
        let component = variable.index.component;
        match variable.derivative_role {
            DerivativeRole::Input(input) => add(input, component, derivative)?,
            DerivativeRole::InputQuaternion(input) => {
                let of_magnet = input == Input::MagnetRotation;
                let pose = if of_magnet { &values.magnet } else { &values.base };
                let mut quaternion_rate = [0.0; 4];
                quaternion_rate[component] = derivative;
                let spin = Pose::rotation_rate(pose.orientation, quaternion_rate);
                (0..3).try_for_each(|axis| add(input, axis, spin[axis]))?;
            }
            _ => return None,
        }
    }
    Some(direction)
}

/// The derivative of one output along a direction, taken from `all`, those of every row of the Jacobian; `None` if the
/// variable is no output that has derivatives.
pub(super) fn output_derivative(
    jacobian: &Jacobian,
    all: &[f64],
    outputs: &Outputs,
    variable: &Variable,
) -> Option<f64> {
    let rows = |output: Output| jacobian.rows(output).and_then(|rows| all.get(rows));
    let component = variable.index.component;
    match variable.derivative_role {
        DerivativeRole::Unaffected => Some(0.0),
        DerivativeRole::Output(output) => rows(output)?.get(component).copied(),
        DerivativeRole::TipQuaternion => {
            let spin = nalgebra::Vector3::from_column_slice(rows(Output::TipRotation)?);
            Some(outputs.tip.quaternion_rate(&spin)[component])
        }
        DerivativeRole::None | DerivativeRole::Input(_) | DerivativeRole::InputQuaternion(_) => None,
    }
}

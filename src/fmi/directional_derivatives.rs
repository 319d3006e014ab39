//! From derivatives of variables to directions in the Jacobian of the manipulator, and back.

use super::derivative_role::DerivativeRole;
use super::host_values::HostValues;
use super::variable::Variable;
use crate::geometry::Pose;
use crate::manipulator::{Input, Jacobian, Output, Outputs};

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
                let pose = match input {
                    Input::MagnetRotation => &values.magnet,
                    Input::SourceRotation(number) => &values.further.get(number)?.pose,
                    _ => &values.base,
                };
                let mut quaternion_rate = [0.0; 4];
                quaternion_rate[component] = derivative;
                let spin = Pose::rotation_rate(pose.acting(), quaternion_rate);
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
        #[expect(clippy::cast_precision_loss, reason = "a centreline has far fewer points than 2^53")]
        DerivativeRole::ShareOfFeed { part, of } => {
            Some(rows(Output::FeedLength)?.first()? * part as f64 / of as f64)
        }
        DerivativeRole::Output(output) => rows(output)?.get(component).copied(),
        DerivativeRole::TipQuaternion => {
            let spin = nalgebra::Vector3::from_column_slice(rows(Output::TipRotation)?);
            Some(outputs.tip.quaternion_rate(&spin)[component])
        }
        DerivativeRole::None | DerivativeRole::Input(_) | DerivativeRole::InputQuaternion(_) => None,
    }
}

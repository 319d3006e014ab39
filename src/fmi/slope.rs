//! Where a variable stands in the device's Jacobian.

use super::given::Given;
use super::variable::Variable;
use crate::geometry::Pose;
use crate::manipulator::{Input, Jacobian, Output, Outputs};

/// How a variable takes part in derivatives of outputs by inputs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Slope {
    /// Not at all: a parameter, or a number about the solve.
    None,
    /// An output that no input moves.
    Still,
    /// A component of an input.
    Input(Input),
    /// A component of the quaternion behind the rotation of this input.
    InputQuaternion(Input),
    /// A component of an output.
    Output(Output),
    /// A component of the quaternion of the tip.
    TipQuaternion,
}

/// The direction of the device's inputs when these variables change at these rates; `None` if one is no input.
///
/// A quaternion stands for the rotation that it describes when it is normalised.
pub(super) fn direction<'a>(
    jacobian: &Jacobian,
    given: &Given,
    rates: impl Iterator<Item = (&'a Variable, f64)>,
) -> Option<Vec<f64>> {
    let mut direction = vec![0.0; jacobian.matrix().ncols()];
    let mut add = |input: Input, axis: usize, rate: f64| -> Option<()> {
        direction[jacobian.columns(input)?].get_mut(axis).map(|entry| *entry += rate)
    };
    for (variable, rate) in rates {
        let axis = variable.at.axis;
        match variable.slope {
            Slope::Input(input) => add(input, axis, rate)?,
            Slope::InputQuaternion(input) => {
                let of_magnet = input == Input::MagnetRotation;
                let placement = if of_magnet { &given.magnet } else { &given.base };
                let mut quaternion_rate = [0.0; 4];
                quaternion_rate[axis] = rate;
                let spin = Pose::rotation_rate(placement.orientation, quaternion_rate);
                (0..3).try_for_each(|axis| add(input, axis, spin[axis]))?;
            }
            _ => return None,
        }
    }
    Some(direction)
}

/// The rate of an output, out of those of all rows of the Jacobian; `None` if the variable is none of them.
pub(super) fn rate(
    jacobian: &Jacobian,
    rates: &[f64],
    outputs: &Outputs,
    variable: &Variable,
) -> Option<f64> {
    let rows = |output: Output| jacobian.rows(output).and_then(|rows| rates.get(rows));
    match variable.slope {
        Slope::Still => Some(0.0),
        Slope::Output(output) => rows(output)?.get(variable.at.axis).copied(),
        Slope::TipQuaternion => {
            let spin = nalgebra::Vector3::from_column_slice(rows(Output::TipRotation)?);
            Some(outputs.tip.quaternion_rate(&spin)[variable.at.axis])
        }
        Slope::None | Slope::Input(_) | Slope::InputQuaternion(_) => None,
    }
}

//! Poses and turns of a scene's tables.

use nalgebra::{Matrix3, Vector3};

use super::ranges::TURN;
use super::units::MM_PER_M;
use crate::error::{Error, check};
use crate::geometry::{Pose, RotationVector};

/// Default axis of rotation: a right-handed rotation about it takes +z to +y.
pub(super) const TURN_AXIS: [f64; 3] = [-1.0, 0.0, 0.0];

/// Right-handed rotation by `degrees` about an axis of any positive length, of the table of this name.
pub(super) fn turn(table: &str, axis: [f64; 3], degrees: f64) -> Result<Matrix3<f64>, Error> {
    let axis = Vector3::from(axis);
    let length = axis.norm();
    check(&format!("length of {table}.turn_axis"), length, |v| v > 0.0, "> 0")?;
    TURN.check(&format!("{table}.turn_deg"), degrees)?;
    Ok(RotationVector::new(axis * (degrees.to_radians() / length)).matrix())
}

pub(super) fn in_metres(position_mm: [f64; 3]) -> [f64; 3] {
    position_mm.map(|x| x / MM_PER_M)
}

/// A pose of the table of this name; position in m.
pub(super) fn pose(table: &str, position: [f64; 3], orientation_wxyz: [f64; 4]) -> Result<Pose, Error> {
    Pose::new(position, orientation_wxyz).map_err(|error| match error {
        Error::Range { value, allowed, .. } => {
            Error::range(format!("norm of {table}.orientation_wxyz"), value, allowed)
        }
        other => other,
    })
}

/// The pose rotated about its own origin.
pub(super) fn turned(turn: &Matrix3<f64>, pose: Pose) -> Pose {
    Pose { rotation: turn * pose.rotation, ..pose }
}

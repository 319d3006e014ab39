//! Rotations and poses.

mod pose;
mod rotation;

pub use pose::Pose;
pub use rotation::{RotationVector, axial, hat, rotation_log};

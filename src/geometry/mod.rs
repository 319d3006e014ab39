//! Rotations and poses.

mod pose;

pub use pose::Pose;

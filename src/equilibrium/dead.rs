//! Loads that are not magnetic, and the wrench that loads add up to.

use nalgebra::Vector3;

use crate::geometry::Pose;
use crate::magnetics::Wrench;
use crate::rod::{Load, Station};

/// Weight of a station's material and backbone; `pose` is the station's, in world axes.
pub(super) fn weight(station: &Station, pose: &Pose, gravity: &Vector3<f64>) -> Load {
    let material = station.density * station.material.volume;
    let first = station.material.first * station.density;
    let lever = pose.rotation * Vector3::new(first.x, first.y, 0.0);
    let mass = material + station.line_mass;
    Load {
        energy: -gravity.dot(&(pose.position * mass + lever)),
        force: gravity * -mass,
        couple: gravity * lever.transpose() * -1.0,
        ..Load::zero()
    }
}

/// No wrench.
pub(super) fn no_wrench() -> Wrench {
    Wrench { force: Vector3::zeros(), torque: Vector3::zeros() }
}

/// Adds the wrench of a load with the given derivatives by position and rotation, whose frame's origin is at
/// `arm` (m) from the reference point.
pub(super) fn add_wrench(
    wrench: &mut Wrench,
    force: &Vector3<f64>,
    moment: &Vector3<f64>,
    arm: &Vector3<f64>,
) {
    wrench.force -= force;
    wrench.torque -= moment + arm.cross(force);
}

//! Loads that are not magnetic, and the wrench that loads add up to.

use nalgebra::Vector3;

use super::inputs::Inputs;
use crate::geometry::Pose;
use crate::magnetics::Wrench;
use crate::rod::{Load, Matter};

/// Weight of a section's material and backbone; `pose` is the section's, in world axes.
pub(crate) fn weight(matter: &Matter, pose: &Pose, gravity: &Vector3<f64>) -> Load {
    let material = matter.density * matter.moments.volume;
    let first = matter.moments.first * matter.density;
    let lever = pose.rotation * Vector3::new(first.x, first.y, 0.0);
    let mass = material + matter.line_mass;
    Load {
        energy: -gravity.dot(&(pose.position * mass + lever)),
        force: gravity * -mass,
        couple: gravity * lever.transpose() * -1.0,
        ..Load::zero()
    }
}

/// No wrench.
pub(crate) fn no_wrench() -> Wrench {
    Wrench { force: Vector3::zeros(), torque: Vector3::zeros() }
}

/// What the external magnet feels about its centre, of what all fields and the background alone do to the manipulator.
pub(crate) fn reaction_on_magnet(whole: &Wrench, background: &Wrench, inputs: &Inputs) -> Wrench {
    let force = background.force - whole.force;
    let about_base = background.torque - whole.torque;
    Wrench { force, torque: about_base - (inputs.magnet.position - inputs.base.position).cross(&force) }
}

/// Adds the wrench of a load with the given derivatives by position and rotation, whose frame's origin is at
/// `arm` (m) from the reference point.
pub(crate) fn add_wrench(
    wrench: &mut Wrench,
    force: &Vector3<f64>,
    moment: &Vector3<f64>,
    arm: &Vector3<f64>,
) {
    wrench.force -= force;
    wrench.torque -= moment + arm.cross(force);
}

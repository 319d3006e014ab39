//! Designs, interaction levels, magnet pair and input steps shared by the studies of accuracy, fidelity and stability.

use nalgebra::{Rotation3, Vector3};

use crate::equilibrium::Interaction;
use crate::manipulator::Inputs;

/// Numbers of segments of the paper's design.
pub(super) const SEGMENTS: [usize; 3] = [1, 3, 9];

/// Levels of interaction that have a potential.
pub(super) const LEVELS: [Interaction; 3] = [Interaction::None, Interaction::Rings, Interaction::Full];

/// The paper's magnet pair at its default position, as text of a scene.
pub(super) const PAIR: &str = "[magnet]\norientation_wxyz = [0, 1, 0, 0]";

/// Change of the inputs per step at 1 kHz: rotation of the field (deg) and displacement of the magnet (m).
const TURN_DEG: f64 = 0.1;
const PASSAGE: f64 = 1e-4;

/// The inputs after the given number of steps at 1 kHz.
pub(super) fn later(inputs: &Inputs, steps: u32) -> Inputs {
    let mut moved = inputs.clone();
    let turn = Rotation3::from_axis_angle(&Vector3::x_axis(), f64::from(steps) * TURN_DEG.to_radians());
    moved.uniform_field = turn * moved.uniform_field;
    moved.sources[0].pose.position.z += f64::from(steps) * PASSAGE;
    moved
}

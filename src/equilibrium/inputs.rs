//! What acts on the manipulator, world frame, SI units.

use nalgebra::Vector3;

use crate::geometry::Pose;

/// Pose and strength of the external magnet, background field, base pose and loads.
#[derive(Debug, Clone, PartialEq)]
pub struct Inputs {
    /// Pose of the external magnet assembly.
    pub magnet: Pose,
    /// Factor on the assembly's field; 0 switches it off.
    pub magnet_strength: f64,
    /// Uniform background field, T.
    pub uniform_field: Vector3<f64>,
    /// `dBx/dx, dBx/dy, dBx/dz, dBy/dy, dBy/dz` of a linear field about the world origin, T/m.
    pub field_gradient: [f64; 5],
    /// Clamped base pose.
    pub base: Pose,
    /// Force on the tip, N.
    pub tip_force: Vector3<f64>,
    /// Moment on the tip, N m.
    pub tip_moment: Vector3<f64>,
    /// Force at each ring's centre, base to tip, N; as many as the design has rings.
    pub ring_forces: Vec<Vector3<f64>>,
    /// Acceleration of gravity, m/s2.
    pub gravity: Vector3<f64>,
}

impl Inputs {
    /// Nothing acts: no field, no load, base at the origin; `rings` is the number of rings of the design.
    #[must_use]
    pub fn unloaded(rings: usize) -> Self {
        Self {
            magnet: Pose::identity(),
            magnet_strength: 0.0,
            uniform_field: Vector3::zeros(),
            field_gradient: [0.0; 5],
            base: Pose::identity(),
            tip_force: Vector3::zeros(),
            tip_moment: Vector3::zeros(),
            ring_forces: vec![Vector3::zeros(); rings],
            gravity: Vector3::zeros(),
        }
    }
}

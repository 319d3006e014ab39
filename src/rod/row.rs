//! Tables of the strain modes at one arc length.

use nalgebra::Vector3;

/// The six strain components: curvature about `d1`, `d2`, `d3`, then shear along `d1`, `d2` and extension.
pub const COMPONENTS: usize = 6;

/// Number of rotational components, which come first; the others are shear and extension.
pub(super) const ROTATIONS: usize = 3;

/// The mode values at one arc length, and the weights for integrating the position up to it.
#[derive(Debug, Clone)]
pub struct Row {
    /// Arc length from the element's start, m.
    pub arc_length: f64,
    /// `psi`: mode values by degree of freedom, 1/m.
    pub rate: Vec<f64>,
    /// Integrals of `psi` up to here by degree of freedom.
    pub integral: Vec<f64>,
    /// Weight of each station's tangent in the position at this arc length, m.
    pub position: Vec<f64>,
    /// Curvature without loads, 1/m.
    pub rest_rate: Vector3<f64>,
    /// Its integral up to here, rad: the rotation vector of the unloaded element.
    pub rest_angle: Vector3<f64>,
}

impl Row {
    /// No values: a place that is not tabulated yet.
    pub(super) fn empty() -> Self {
        Self {
            arc_length: 0.0,
            rate: Vec::new(),
            integral: Vec::new(),
            position: Vec::new(),
            rest_rate: Vector3::zeros(),
            rest_angle: Vector3::zeros(),
        }
    }
}

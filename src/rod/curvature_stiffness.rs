//! Stiffness of a section against curvature.

use nalgebra::Vector3;

use crate::design::Stiffness;

/// Weighted section stiffness against curvature, as a diagonal.
pub(super) fn curvature_stiffness(stiffness: &Stiffness, weight: f64) -> Vector3<f64> {
    Vector3::new(stiffness.bending, stiffness.bending, stiffness.torsion) * weight
}

//! Distance to the wall, with its derivatives.

use nalgebra::{Matrix3, Vector3};

/// Distance from a point to the wall, positive inside the lumen, with its derivatives by the point's position.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Clearance {
    /// The distance, m.
    pub value: f64,
    /// Gradient: away from the nearest part of the wall, of unit length where one branch counts.
    pub gradient: Vector3<f64>,
    /// Second derivative, 1/m.
    pub hessian: Matrix3<f64>,
}

impl Clearance {
    /// That of a ball around a fixed centre, at `offset` (m) from it. In the centre, where the wall is equally near all round,
    /// the derivatives are zero.
    pub(super) fn in_ball(radius: f64, offset: &Vector3<f64>) -> Self {
        let distance = offset.norm();
        let value = radius - distance;
        if distance == 0.0 {
            return Self { value, gradient: Vector3::zeros(), hessian: Matrix3::zeros() };
        }
        let outwards = offset / distance;
        Self {
            value,
            gradient: -outwards,
            hessian: (outwards * outwards.transpose() - Matrix3::identity()) / distance,
        }
    }
}

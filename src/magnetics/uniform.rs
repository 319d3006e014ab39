//! A uniform field, or one that varies linearly in space.

use nalgebra::{Matrix3, Vector3};

use super::jet::{FieldHessian, Jet};

/// `B(x) = B_0 + G x` with a symmetric, traceless `G`: free of curl and divergence.
///
/// ```
/// use mcm::magnetics::LinearField;
/// use nalgebra::Vector3;
/// let field = LinearField::new(Vector3::new(0.0, 0.02, 0.0), [0.5, 0.0, 0.0, -0.25, 0.0]);
/// assert_eq!(field.at(&Vector3::new(2.0, 0.0, 4.0)), Vector3::new(1.0, 0.02, -1.0));
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinearField {
    origin: Vector3<f64>,
    gradient: Matrix3<f64>,
}

impl LinearField {
    /// From the field at the origin (T) and `dBx/dx, dBx/dy, dBx/dz, dBy/dy, dBy/dz` (T/m).
    ///
    /// The values are not checked here: NaN is rejected where inputs are read.
    #[must_use]
    pub fn new(origin: Vector3<f64>, gradient: [f64; 5]) -> Self {
        let [xx, xy, xz, yy, yz] = gradient;
        Self { origin, gradient: Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, -xx - yy) }
    }

    /// The field at a point (m), T.
    #[must_use]
    pub fn at(&self, point: &Vector3<f64>) -> Vector3<f64> {
        self.origin + self.gradient * point
    }

    /// The gradient `dB_i/dx_j`, T/m, the same everywhere.
    #[must_use]
    pub fn gradient(&self) -> Matrix3<f64> {
        self.gradient
    }

    /// The field with its derivatives at a point (m).
    #[must_use]
    pub fn jet(&self, point: &Vector3<f64>) -> Jet {
        Jet { field: self.at(point), gradient: self.gradient, hessian: FieldHessian::default() }
    }
}

//! Temporary.
use super::Jet;
use nalgebra::{Matrix3, Vector3};
/// Linear field.
#[derive(Debug, Clone, Copy)]
pub struct LinearField {
    field: Vector3<f64>,
    gradient: Matrix3<f64>,
}
impl LinearField {
    /// New.
    #[must_use]
    pub fn new(field: Vector3<f64>, g: [f64; 5]) -> Self {
        Self { field, gradient: Matrix3::new(g[0], g[1], g[2], g[1], g[3], g[4], g[2], g[4], -g[0] - g[3]) }
    }
    /// Jet.
    #[must_use]
    pub fn jet(&self, p: &Vector3<f64>) -> Jet {
        let mut j = Jet::zero();
        j.field = self.field + self.gradient * p;
        j.gradient = self.gradient;
        j
    }
}

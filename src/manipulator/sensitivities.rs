//! The derivatives of outputs by numbers of the scene, as the outputs of two neighbouring devices for each number.

use nalgebra::DVector;

use super::Outputs;

/// Exact derivatives of all outputs by numbers of the scene at one equilibrium, in SI units of the output per unit of the scene
/// (`mm`, `deg`, `mpa`, ... as the key says).
///
/// They are the differences of the outputs of two devices, one with the number a little smaller and one with it larger, each in
/// equilibrium to first order. So there is a derivative of everything that is read from [`Outputs`], but not of what a solve adds
/// to them: stability margin, energy and how it ended.
#[derive(Debug, Clone, PartialEq)]
pub struct Sensitivities {
    keys: Vec<String>,
    sides: Vec<[Outputs; 2]>,
    differences: Vec<f64>,
}

impl Sensitivities {
    pub(super) fn new(keys: Vec<String>, sides: Vec<[Outputs; 2]>, differences: Vec<f64>) -> Self {
        Self { keys, sides, differences }
    }

    /// The keys of the numbers.
    #[must_use]
    pub fn keys(&self) -> &[String] {
        &self.keys
    }

    /// Derivatives of what `read` reads from the outputs, one for each key.
    #[must_use]
    pub fn of(&self, read: impl Fn(&Outputs) -> f64) -> DVector<f64> {
        let each = self.sides.iter().zip(&self.differences);
        DVector::from_iterator(
            self.keys.len(),
            each.map(|([before, after], difference)| (read(after) - read(before)) / difference),
        )
    }

    /// The outputs of the two neighbouring devices of key number `index`, and by how much its number differs between them.
    #[must_use]
    pub fn sides(&self, index: usize) -> Option<(&[Outputs; 2], f64)> {
        Some((self.sides.get(index)?, *self.differences.get(index)?))
    }
}

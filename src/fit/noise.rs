//! How much a measured number counts.

use nalgebra::DVector;

use super::data::Data;
use super::quantity::Quantity;
use crate::error::Error;

/// Smallest estimated deviation, relative to the size of the measured numbers: what a solve leaves.
const EXACT: f64 = 1e-10;

/// Standard deviations of all measured numbers.
#[derive(Debug, Clone)]
pub(super) struct Noise {
    pub(super) deviations: DVector<f64>,
    /// Whether they were given, and not estimated.
    pub(super) known: bool,
}

impl Noise {
    /// The given ones, and where none is, the size of each quantity, to begin with.
    ///
    /// # Errors
    /// [`Error::Unsupported`] where only some are given.
    pub(super) fn of(data: &Data) -> Result<Self, Error> {
        let given: Vec<f64> = data.measured().filter_map(|each| each.deviation).collect();
        let count = data.measured().count();
        if given.len() == count {
            return Ok(Self { deviations: DVector::from_vec(given), known: true });
        }
        if !given.is_empty() {
            return Err(Error::Unsupported(format!(
                "{} of {count} measured numbers have a standard deviation: give it for all, or for none",
                given.len()
            )));
        }
        let sizes = data.measured().map(|each| size(data, each.quantity));
        Ok(Self { deviations: DVector::from_iterator(count, sizes), known: false })
    }

    /// Estimates from residuals the deviation of each quantity; `leverages` tell how much of each number the parameters have taken for
    /// themselves. Given ones stay.
    pub(super) fn estimated(&mut self, data: &Data, residuals: &DVector<f64>, leverages: &DVector<f64>) {
        if self.known {
            return;
        }
        let quantities: Vec<Quantity> = data.measured().map(|each| each.quantity).collect();
        for (index, quantity) in quantities.iter().enumerate() {
            let (mut squares, mut freedom) = (0.0, 0.0);
            for (other, (residual, leverage)) in quantities.iter().zip(residuals.iter().zip(leverages)) {
                if other == quantity {
                    squares += residual * residual;
                    freedom += 1.0 - leverage;
                }
            }
            let deviation = (squares / freedom.max(f64::EPSILON)).sqrt();
            self.deviations[index] = deviation.max(EXACT * size(data, *quantity));
        }
    }
}

/// Largest measured value of a quantity; 1 where all are zero.
fn size(data: &Data, quantity: Quantity) -> f64 {
    let own = data.measured().filter(|each| each.quantity == quantity);
    let largest = own.fold(0.0_f64, |most, each| most.max(each.value.abs()));
    if largest > 0.0 { largest } else { 1.0 }
}

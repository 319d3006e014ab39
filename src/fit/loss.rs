//! How much a residual counts.

use super::constants::{HUBER_CORNER, NORMAL_MEDIAN};

/// How residuals add up to what is made smallest.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Loss {
    /// Squares: the most likely parameters for normal errors.
    #[default]
    Squares,
    /// Squares up to 1.345 standard deviations, lines beyond: outliers count little.
    Huber,
}

impl Loss {
    /// Twice the loss of a residual in standard deviations: its square where it is small.
    pub(super) fn of(self, residual: f64) -> f64 {
        let size = residual.abs();
        if self == Self::Squares || size <= HUBER_CORNER {
            residual * residual
        } else {
            HUBER_CORNER * (2.0 * size - HUBER_CORNER)
        }
    }

    /// Weight of a residual in the equivalent sum of squares.
    pub(super) fn weight(self, residual: f64) -> f64 {
        let size = residual.abs();
        if self == Self::Squares || size <= HUBER_CORNER { 1.0 } else { HUBER_CORNER / size }
    }

    /// Whether a residual counts in full.
    pub(super) fn is_inside(self, residual: f64) -> bool {
        self == Self::Squares || residual.abs() <= HUBER_CORNER
    }
}

/// Standard deviation of residuals by their median, which outliers hardly move, of `parameters` fitted ones.
pub(super) fn spread(residuals: &[f64], parameters: usize) -> f64 {
    let mut sizes: Vec<f64> = residuals.iter().map(|residual| residual.abs()).collect();
    sizes.sort_by(f64::total_cmp);
    // As many residuals as parameters can be made zero.
    let left = &sizes[parameters.min(sizes.len().saturating_sub(1))..];
    left.get(left.len() / 2).map_or(0.0, |median| median / NORMAL_MEDIAN)
}

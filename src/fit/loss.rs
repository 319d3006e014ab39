//! How much a residual counts.

/// Residual, in standard deviations, up to which the Huber loss is a square: 95 % as efficient as squares for normal errors
/// (P. J. Huber, Robust Statistics, 1981).
const CORNER: f64 = 1.345;

/// Median absolute value of a standard normal variable.
const MEDIAN: f64 = 0.674_489_750_196_081_7;

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
        if self == Self::Squares || size <= CORNER {
            residual * residual
        } else {
            CORNER * (2.0 * size - CORNER)
        }
    }

    /// Weight of a residual in the equivalent sum of squares.
    pub(super) fn weight(self, residual: f64) -> f64 {
        let size = residual.abs();
        if self == Self::Squares || size <= CORNER { 1.0 } else { CORNER / size }
    }

    /// Whether a residual counts in full.
    pub(super) fn is_inside(self, residual: f64) -> bool {
        self == Self::Squares || residual.abs() <= CORNER
    }
}

/// Standard deviation of residuals by their median, which outliers hardly move, of `parameters` fitted ones.
pub(super) fn spread(residuals: &[f64], parameters: usize) -> f64 {
    let mut sizes: Vec<f64> = residuals.iter().map(|residual| residual.abs()).collect();
    sizes.sort_by(f64::total_cmp);
    // As many residuals as parameters can be made zero.
    let left = &sizes[parameters.min(sizes.len().saturating_sub(1))..];
    left.get(left.len() / 2).map_or(0.0, |median| median / MEDIAN)
}

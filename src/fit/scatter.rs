//! The scatter of the residuals about a fit, and how sure its parameters are by that.

use statrs::distribution::{ChiSquared, ContinuousCDF, Normal, StudentsT};

use super::constants::UPPER;
use super::estimate::Estimate;
use super::loss::Loss;

/// How far the residuals scatter about the fit.
pub(super) struct Scatter {
    /// Whether the deviations of the measured values are stated.
    pub(super) stated: bool,
    /// Values more than parameters.
    pub(super) freedoms: usize,
    /// Sum of squares.
    pub(super) sum: f64,
    /// Their standard deviation, in stated ones or in units of the measured values; 0 where nothing is left over.
    pub(super) residuals: f64,
    /// That on which the covariance is based: 1 where all deviations are stated, unless outliers are expected.
    pub(super) scale: f64,
}

impl Scatter {
    pub(super) fn of(found: &Estimate, loss: Loss, stated: bool) -> Self {
        let freedoms = found.residuals.len() - found.parameters.len();
        let sum = found.residuals.norm_squared();
        let residuals = match (loss, freedoms) {
            (Loss::Squares, 0) => 0.0,
            (Loss::Squares, _) => (sum / freedoms as f64).sqrt(),
            (Loss::Huber, _) => robust_scatter(found, freedoms),
        };
        let scale = if stated && loss == Loss::Squares { 1.0 } else { residuals };
        Self { stated, freedoms, sum, residuals, scale }
    }

    /// Whether deviations follow from it; those of an exact fit without a value to spare are not zero but unknown.
    pub(super) fn is_known(&self) -> bool {
        self.scale > 0.0 || (self.freedoms > 0 && !self.stated)
    }

    /// Half the width of an interval of 95 %, in standard deviations.
    pub(super) fn quantile(&self) -> f64 {
        if self.stated {
            return Normal::standard().inverse_cdf(UPPER);
        }
        let student = StudentsT::new(0.0, 1.0, self.freedoms.max(1) as f64);
        student.map_or(f64::NAN, |student| student.inverse_cdf(UPPER))
    }

    /// Probability of a larger sum of squares by the stated deviations alone; `None` where that has no meaning.
    pub(super) fn probability(&self, loss: Loss) -> Option<f64> {
        let known = self.stated && loss == Loss::Squares && self.freedoms > 0;
        let distribution = ChiSquared::new(self.freedoms as f64).ok().filter(|_| known)?;
        Some(distribution.sf(self.sum))
    }
}

/// Scatter from which the covariance of the Huber loss follows as `scatter^2 (J^T D J)^-1`, `D` being 1 for residuals that count in full
/// (P. J. Huber, Robust Statistics, 1981, equation 7.6.11).
fn robust_scatter(found: &Estimate, freedoms: usize) -> f64 {
    let (count, scale) = (found.residuals.len() as f64, found.scale);
    let scaled = || found.residuals.iter().map(|residual| residual / scale);
    let squares: f64 = scaled().map(|residual| (Loss::Huber.weight(residual) * residual).powi(2)).sum();
    let inside = scaled().filter(|residual| Loss::Huber.is_inside(*residual)).count() as f64 / count;
    if freedoms == 0 || inside == 0.0 {
        return 0.0;
    }
    let parameters = found.parameters.len() as f64;
    let correction = 1.0 + parameters / count * (1.0 - inside) / inside;
    correction * scale * (squares / freedoms as f64 / inside).sqrt()
}

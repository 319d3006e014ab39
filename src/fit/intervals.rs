//! Intervals by the profile of the loss: of a parameter's value, the best that the others can do.
//!
//! With the sum of squares `S(x)` where the parameter is held at `x` and all others are best, the interval of 95 % ends where
//! `S(x) - S_min = q^2 s^2`: `q` is the quantile of the normal distribution where the deviations `s = 1` are stated, that of Student's t
//! where `s` is estimated (D. M. Bates and D. G. Watts, Nonlinear Regression Analysis, 1988, section 6.1).

use nalgebra::{Cholesky, DMatrix, DVector};
use rayon::prelude::*;

use super::constants::{CLOSE, PROFILE_CORRECTIONS, PROFILE_VALUES, SMALL_CORRECTION};
use super::problem::Problem;
use super::problem::Shapes;

/// The best parameters, and what is needed to go away from them.
#[derive(Debug)]
pub(super) struct Profile<'a> {
    pub(super) problem: &'a Problem<'a>,
    pub(super) parameters: &'a DVector<f64>,
    pub(super) shapes: &'a Shapes,
    pub(super) jacobian: &'a DMatrix<f64>,
    /// Covariance for residuals of variance 1.
    pub(super) covariance: &'a DMatrix<f64>,
    /// Smallest sum of squares.
    pub(super) smallest: f64,
    /// By how much the sum grows up to the end of the interval.
    pub(super) threshold: f64,
}

impl Profile<'_> {
    /// Both ends of the interval of a parameter; `None` where the parameter's range ends first, or rows lose their shape.
    pub(super) fn interval(&self, index: usize) -> [Option<f64>; 2] {
        let sides: Vec<Option<f64>> = [-1.0, 1.0].into_par_iter().map(|side| self.end(index, side)).collect();
        [sides[0], sides[1]]
    }

    fn end(&self, index: usize, side: f64) -> Option<f64> {
        let first = side * (self.threshold * self.covariance[(index, index)]).sqrt();
        let (mut below, mut above): ([f64; 2], Option<[f64; 2]>) = ([0.0, 0.0], None);
        let mut by = first;
        for _ in 0..PROFILE_VALUES {
            let Some(grown) = self.grown(index, by) else {
                // Beyond what is allowed: the end may lie before it.
                above = Some([by, f64::INFINITY]);
                by = 0.5 * (below[0] + by);
                continue;
            };
            // Close to the best value the root of the growth is linear.
            let height = (grown.max(0.0) / self.threshold).sqrt();
            if (height - 1.0).abs() < CLOSE {
                return Some(self.parameters[index] + by);
            }
            if height < 1.0 {
                below = [by, height];
            } else {
                above = Some([by, height]);
            }
            by = match above {
                Some([at, high]) if high.is_finite() => {
                    let part = (1.0 - below[1]) / (high - below[1]);
                    below[0] + part.clamp(0.05, 0.95) * (at - below[0])
                }
                Some([at, _]) => 0.5 * (below[0] + at),
                None => by * (1.02 / height.max(0.4)),
            };
        }
        None
    }

    /// Growth of the sum of squares where a parameter is moved and the others follow; `None` where that is refused.
    fn grown(&self, index: usize, by: f64) -> Option<f64> {
        let count = self.parameters.len();
        let others: Vec<usize> = (0..count).filter(|&other| other != index).collect();

        // The first guess of the others' answer is the linear one: along the covariance's column.
        let along = self.covariance.column(index) * (by / self.covariance[(index, index)]);
        let mut parameters = self.parameters + along;
        parameters[index] = self.parameters[index] + by;

        let mut shapes = self.problem.moved(self.shapes, &parameters).ok()?;
        let mut residuals = self.problem.residuals(&shapes);
        let mut sum = residuals.norm_squared();

        if others.is_empty() {
            return Some(sum - self.smallest);
        }

        // Gauss-Newton steps of the others, with the Jacobian at the fit's end throughout.
        let own = self.jacobian.select_columns(&others);
        let solver = Cholesky::new(own.tr_mul(&own))?;
        for _ in 0..PROFILE_CORRECTIONS {
            let gradient = own.tr_mul(&residuals);
            let step = solver.solve(&gradient);
            if gradient.dot(&step) < SMALL_CORRECTION * self.threshold {
                break;
            }

            let mut next = parameters.clone();
            others.iter().zip(&step).for_each(|(&other, by)| next[other] -= by);
            let Ok(moved) = self.problem.moved(&shapes, &next) else { break };

            let left = self.problem.residuals(&moved);
            if left.norm_squared() >= sum {
                break;
            }
            (sum, residuals, shapes, parameters) = (left.norm_squared(), left, moved, next);
        }
        Some(sum - self.smallest)
    }
}

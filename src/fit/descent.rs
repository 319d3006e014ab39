//! Gauss and Newton's method, damped (Levenberg 1944, doi 10.1090/qam/10666).

use nalgebra::{Cholesky, DMatrix, DVector};

use super::problem::{Answers, Missing, Problem};
use crate::error::Error;

/// Most steps of one descent.
const STEPS: usize = 60;

/// Step, relative to the size of the parameters, that ends it.
const STILL: f64 = 1e-8;

/// Damping of the first step, and by how much it shrinks and grows.
const DAMPING: f64 = 1e-6;
const SHRINK: f64 = 0.1;
const GROW: f64 = 10.0;
const LARGEST: f64 = 1e8;
const SMALLEST: f64 = 1e-14;

/// Growth of the sum of squares that is rounding, relative.
const ROUNDING: f64 = 1e-12;

/// Relative change of the parameters up to which derivatives are used again.
const ALIKE: f64 = 1e-2;

/// Parameters, the model's answers there, and derivatives there or close by, not weighted.
#[derive(Debug, Clone)]
pub(super) struct Point {
    pub(super) values: DVector<f64>,
    pub(super) answers: Answers,
    pub(super) rates: DMatrix<f64>,
}

/// A minimum of the sum of weighted squares.
#[derive(Debug, Clone)]
pub(super) struct Minimum {
    pub(super) point: Point,
    pub(super) squares: f64,
    pub(super) steps: usize,
}

/// A problem with the weight of each residual and the size of each parameter.
pub(super) struct Weighted<'a> {
    pub(super) problem: Problem<'a>,
    pub(super) weights: DVector<f64>,
    pub(super) sizes: DVector<f64>,
}

impl Problem<'_> {
    /// The answers and derivatives at these parameters.
    pub(super) fn at(&self, values: &DVector<f64>) -> Result<Point, Error> {
        let answers = self.answers(values).map_err(first_failure)?;
        let rates = self.rates(&answers)?;
        Ok(Point { values: values.clone(), answers, rates })
    }
}

impl Weighted<'_> {
    /// Weighted: measured less computed numbers.
    pub(super) fn residuals(&self, computed: &DVector<f64>) -> DVector<f64> {
        let values = self.problem.data.measured().map(|each| each.value);
        let missing = DVector::from_iterator(computed.len(), values) - computed;
        missing.component_mul(&self.weights)
    }

    /// Weighted derivatives by relative changes of the parameters.
    pub(super) fn scaled(&self, rates: &DMatrix<f64>) -> DMatrix<f64> {
        let mut out = rates.clone();
        for (mut row, weight) in out.row_iter_mut().zip(&self.weights) {
            row *= *weight;
        }
        for (mut column, size) in out.column_iter_mut().zip(&self.sizes) {
            column *= *size;
        }
        out
    }

    /// The minimum near `start`, where one of the parameters may be fixed.
    pub(super) fn minimum(&self, start: Point, fixed: Option<usize>) -> Result<Minimum, Error> {
        let mut here = start;
        let mut residuals = self.residuals(&here.answers.computed);
        let (mut damping, mut steps, mut apart) = (DAMPING, 0, 0.0);
        while steps < STEPS {
            steps += 1;
            let mut scaled = self.scaled(&here.rates);
            if let Some(fixed) = fixed {
                scaled.column_mut(fixed).fill(0.0);
            }
            let (mut normal, slope) = (scaled.tr_mul(&scaled), scaled.tr_mul(&residuals));
            let weight = damping * normal.diagonal().max() + f64::MIN_POSITIVE;
            for index in 0..normal.nrows() {
                normal[(index, index)] += weight;
            }
            let Some(factor) = Cholesky::new(normal) else { break };
            let step = factor.solve(&slope);
            let size = step.amax();
            let next = &here.values + step.component_mul(&self.sizes);
            let found =
                self.problem.answers(&next).ok().map(|found| (self.residuals(&found.computed), found));
            let better =
                |left: &DVector<f64>| left.norm_squared() <= residuals.norm_squared() * (1.0 + ROUNDING);
            match found.filter(|(left, _)| better(left)) {
                Some((left, answers)) => {
                    (here.values, here.answers, residuals) = (next, answers, left);
                    apart += size;
                    damping = (damping * SHRINK).max(SMALLEST);
                    if size < STILL {
                        break;
                    }
                }
                None if apart > 0.0 || size >= STILL => {
                    damping *= GROW;
                    if damping > LARGEST {
                        break;
                    }
                    // Derivatives of another place may mislead.
                    apart += if apart > 0.0 { ALIKE } else { 0.0 };
                }
                None => break,
            }
            if apart > ALIKE {
                (here.rates, apart) = (self.problem.rates(&here.answers)?, 0.0);
            }
        }
        Ok(Minimum { squares: residuals.norm_squared(), point: here, steps })
    }
}

/// The error where the start itself has no answer.
fn first_failure(missing: Missing) -> Error {
    match missing {
        Missing::Refused(error) => error,
        Missing::NoShape(row, outcome) => Error::Unsupported(format!(
            "the model has no shape at measured row {row} ({outcome}) to begin with"
        )),
    }
}

//! The loop that finds the parameters: damped Gauss-Newton steps.
//!
//! With residuals `r` and their derivatives `J`, weights `W` of the loss and `D = diag(J^T W J)`, a step is
//!
//! ```text
//! (J^T W J + damping D) step = -J^T W r
//! ```
//!
//! (D. W. Marquardt, J. SIAM 11 (1963) 431). It is taken where the loss falls; else the damping grows.

use nalgebra::{Cholesky, DMatrix, DVector};

use super::constants::{
    AT_LIMIT, DAMPING_DECREASE, DAMPING_INCREASE, FIRST_DAMPING, LARGEST_DAMPING, LEAST_GAIN, NO_DAMPING,
    SCALE_CHANGE, SOLVER_NOISE,
};
use super::loss::{Loss, spread};
use super::problem::{Problem, Refused, Shapes};
use crate::error::Error;

/// How the parameters are found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// What is made smallest.
    pub loss: Loss,
    /// Largest number of steps.
    pub steps: usize,
    /// Whether intervals are profiles of the loss; otherwise they are symmetric, from the covariance.
    pub profiles: bool,
}

impl Default for Settings {
    fn default() -> Self {
        Self { loss: Loss::Squares, steps: 100, profiles: true }
    }
}

/// The parameters found, and all that was computed there.
#[derive(Debug)]
pub(super) struct Estimate {
    pub(super) parameters: DVector<f64>,
    pub(super) shapes: Shapes,
    /// Why rows do not count.
    pub(super) reasons: Vec<Option<String>>,
    pub(super) residuals: DVector<f64>,
    pub(super) jacobian: DMatrix<f64>,
    /// Standard deviation of the residuals that a robust loss takes; 1 where deviations are stated.
    pub(super) scale: f64,
    pub(super) at_limit: Vec<bool>,
    pub(super) steps: usize,
    pub(super) converged: bool,
}

impl Estimate {
    /// From these parameters, every row from its unloaded shape.
    ///
    /// # Errors
    /// Those of the parameters; [`Error::Unsupported`] where too few rows have a shape.
    pub(super) fn of(
        problem: &Problem,
        start: &DVector<f64>,
        settings: &Settings,
        stated: bool,
    ) -> Result<Self, Error> {
        let (mut shapes, mut reasons) = (Vec::new(), Vec::new());
        for found in problem.first(start)? {
            reasons.push(found.as_ref().err().cloned());
            shapes.push(found.ok());
        }

        let mut out = Self {
            parameters: start.clone(),
            shapes,
            reasons,
            residuals: DVector::zeros(0),
            jacobian: DMatrix::zeros(0, start.len()),
            scale: 1.0,
            at_limit: vec![false; start.len()],
            steps: 0,
            converged: false,
        };

        out.descend(problem, settings, stated)?;
        out.regain(problem)?;
        if !out.converged {
            out.descend(problem, settings, stated)?;
        }

        Ok(out)
    }

    /// Rows that had no shape at the start and have one now count again.
    fn regain(&mut self, problem: &Problem) -> Result<(), Error> {
        if self.reasons.iter().all(Option::is_none) {
            return Ok(());
        }
        for (row, found) in problem.first(&self.parameters)?.into_iter().enumerate() {
            // One without derivatives would be lost again.
            let without = |reason: &String| !reason.starts_with("no derivatives");
            if let (true, Ok(found)) = (self.reasons[row].as_ref().is_some_and(without), found) {
                (self.shapes[row], self.reasons[row]) = (Some(found), None);
                self.converged = false;
            }
        }
        Ok(())
    }

    fn descend(&mut self, problem: &Problem, settings: &Settings, stated: bool) -> Result<(), Error> {
        self.linearise(problem)?;
        self.rescale(settings.loss, stated);
        let (mut damping, mut settled) = (FIRST_DAMPING, false);
        while self.steps < settings.steps {
            let (gradient, matrix) = self.normal_equations(settings.loss);
            self.at_limit = self.limits(problem, &gradient);
            let Some((step, gain)) = self.step(&gradient, &matrix, damping) else {
                damping = (damping * DAMPING_INCREASE).max(FIRST_DAMPING);
                if damping > LARGEST_DAMPING {
                    break;
                }
                continue;
            };
            let loss = self.loss(settings.loss, &self.residuals);
            if settled || gain <= LEAST_GAIN * loss + f64::MIN_POSITIVE || damping > LARGEST_DAMPING {
                settled = false;
                if self.rescale(settings.loss, stated) {
                    self.converged = damping <= LARGEST_DAMPING;
                    break;
                }
                continue;
            }
            self.steps += 1;
            let parameters = &self.parameters + &step;
            let moved = problem.moved(&self.shapes, &parameters).ok().and_then(|shapes| {
                let residuals = problem.residuals(&shapes);
                let smaller = self.loss(settings.loss, &residuals) <= loss;
                let jacobian =
                    if smaller { problem.jacobian(&shapes, &parameters).ok()? } else { return None };
                Some((shapes, residuals, jacobian))
            });
            match moved {
                Some((shapes, residuals, jacobian)) => {
                    // Where rounding moves the parameters, nothing more is gained.
                    let small = |(at, by): (&f64, &f64)| by.abs() <= 1e-12 * at.abs();
                    settled = parameters.iter().zip(&step).all(small);
                    (self.parameters, self.shapes) = (parameters, shapes);
                    (self.residuals, self.jacobian) = (residuals, jacobian);
                    damping = if damping < NO_DAMPING { 0.0 } else { damping * DAMPING_DECREASE };
                }
                // What is to be gained lies within the tolerance of the solves.
                None if gain <= SOLVER_NOISE * loss => settled = true,
                None => damping = (damping * DAMPING_INCREASE).max(FIRST_DAMPING),
            }
        }
        Ok(())
    }

    /// Residuals and derivatives here; rows without derivatives no longer count.
    fn linearise(&mut self, problem: &Problem) -> Result<(), Error> {
        loop {
            let count = problem.observations(&self.shapes).count();
            if count < self.parameters.len() {
                let first = self.reasons.iter().flatten().next();
                let reason = first.map_or(String::new(), |reason| format!("; the first without: {reason}"));
                return Err(Error::Unsupported(format!(
                    "{} parameters need as many measured values: only {count} belong to rows with a shape{reason}",
                    self.parameters.len()
                )));
            }
            match problem.jacobian(&self.shapes, &self.parameters) {
                Ok(jacobian) => {
                    (self.residuals, self.jacobian) = (problem.residuals(&self.shapes), jacobian);
                    return Ok(());
                }
                Err(Refused::Row(row, reason)) => {
                    (self.shapes[row], self.reasons[row]) = (None, Some(reason));
                }
                Err(Refused::Range(error)) => return Err(error),
            }
        }
    }

    /// Takes the scale of the residuals anew; true where it has hardly changed.
    fn rescale(&mut self, loss: Loss, stated: bool) -> bool {
        if stated || loss == Loss::Squares {
            return true;
        }
        let before = self.scale;
        let root = (self.residuals.norm_squared() / self.residuals.len() as f64).sqrt();
        // Of exact measurements nothing is left; an outlier among them is still one.
        let scale = spread(self.residuals.as_slice(), self.parameters.len()).max(1e-9 * root);
        self.scale = if scale > 0.0 { scale } else { 1.0 };
        (self.scale - before).abs() <= SCALE_CHANGE * before
    }

    fn loss(&self, loss: Loss, residuals: &DVector<f64>) -> f64 {
        residuals.iter().map(|residual| loss.of(residual / self.scale)).sum()
    }

    /// `J^T W r` and `J^T W J`, in units of the scale.
    fn normal_equations(&self, loss: Loss) -> (DVector<f64>, DMatrix<f64>) {
        let mut weighted = self.jacobian.clone();
        for (mut row, residual) in weighted.row_iter_mut().zip(&self.residuals) {
            row *= loss.weight(residual / self.scale) / (self.scale * self.scale);
        }
        (weighted.tr_mul(&self.residuals), weighted.tr_mul(&self.jacobian))
    }

    /// Parameters that would leave their range downhill.
    fn limits(&self, problem: &Problem, gradient: &DVector<f64>) -> Vec<bool> {
        let held = |index: usize| {
            let mut beyond = self.parameters.clone();
            beyond[index] -= AT_LIMIT * gradient[index].signum() * beyond[index].abs().max(1e-3);
            gradient[index] != 0.0 && !problem.allows(&beyond)
        };
        (0..self.parameters.len()).map(held).collect()
    }

    /// The damped step, and what it gains to first order; `None` where the equations are singular.
    fn step(
        &self,
        gradient: &DVector<f64>,
        matrix: &DMatrix<f64>,
        damping: f64,
    ) -> Option<(DVector<f64>, f64)> {
        let (mut gradient, mut matrix) = (gradient.clone(), matrix.clone());
        for index in 0..gradient.len() {
            let own = matrix[(index, index)];
            if self.at_limit[index] || own == 0.0 {
                matrix.row_mut(index).fill(0.0);
                matrix.column_mut(index).fill(0.0);
                (matrix[(index, index)], gradient[index]) = (1.0, 0.0);
            } else {
                matrix[(index, index)] = own * (1.0 + damping);
            }
        }
        let step = -Cholesky::new(matrix)?.solve(&gradient);
        let gain = -gradient.dot(&step);
        Some((step, gain))
    }
}

//! Levenberg-Marquardt method: a root by least squares, damped where the residual is far from linear.
//!
//! ```text
//! (J^T J + lambda D^2) s = -J^T r,     lambda = mu |r|,     D = column norms of J, the largest so far
//! ```
//!
//! solved by an orthogonal factorisation, because the normal equations would square the condition number, which is
//! large for shooting methods. `mu` follows the ratio of actual to predicted decrease. Sources: Moré, Lect. Notes Math.
//! 630, 1978, doi:10.1007/BFb0067700 (scaling, factorisation); Fan and Yuan, Computing 74, 2005 (`lambda` proportional
//! to the residual, so that the final convergence is quadratic).

use nalgebra::{DMatrix, DVector};

/// System of equations whose residual is brought to zero.
pub trait LeastSquares {
    /// Residual at `x`; `None` where it is not defined.
    fn residual(&mut self, x: &DVector<f64>) -> Option<DVector<f64>>;
    /// Derivative of the residual at `x`; `residual` is its value there.
    fn jacobian(&mut self, x: &DVector<f64>, residual: &DVector<f64>) -> Option<DMatrix<f64>>;
}

/// Result of a root search.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ending {
    /// Whether the residual fell below the tolerance.
    pub converged: bool,
    /// Iterations used.
    pub iterations: u32,
    /// Norm of the last residual.
    pub residual: f64,
}

/// Initial damping relative to the norm of the residual.
const FIRST: f64 = 1e-2;

/// Bounds of the relative damping: below the first it has no effect; above the second the search is abandoned.
const BOUNDS: [f64; 2] = [1e-8, 1e12];

/// Factor by which the damping changes.
const FACTOR: f64 = 4.0;

/// Thresholds of the ratio of actual to predicted decrease: to accept a step, to increase and to decrease the damping.
const RATIOS: [f64; 3] = [1e-4, 0.25, 0.75];

/// Moves `x` to a root of `system`, in at most `iterations` iterations.
pub fn solve(
    system: &mut impl LeastSquares,
    x: &mut DVector<f64>,
    tolerance: f64,
    iterations: u32,
) -> Ending {
    let mut end = Ending { converged: false, iterations: 0, residual: f64::INFINITY };
    let Some(mut residual) = system.residual(x) else { return end };
    let mut scale = DVector::<f64>::zeros(x.len());
    let mut damping = FIRST;
    let mut jacobian = None;

    while end.iterations < iterations {
        end.residual = residual.norm();
        end.converged = end.residual <= tolerance;
        if end.converged || !end.residual.is_finite() || damping > BOUNDS[1] {
            break;
        }

        // A rejected step leaves x where it was, and with it the Jacobian.
        if jacobian.is_none() {
            jacobian = system.jacobian(x, &residual);
        }
        let Some(matrix) = &jacobian else { break };
        end.iterations += 1;

        // Moré's scaling: with the largest column norms so far, steps do not depend on the unknowns' units.
        for (entry, column) in scale.iter_mut().zip(matrix.column_iter()) {
            *entry = entry.max(column.norm()).max(f64::MIN_POSITIVE);
        }
        let lambda = damping * end.residual;
        let Some(step) = step(matrix, &residual, &scale, lambda) else { break };

        let trial = &*x + &step;
        let linear = (&residual + matrix * &step).norm_squared();
        let before = residual.norm_squared();
        let next = system.residual(&trial).filter(|next| next.iter().all(|entry| entry.is_finite()));

        let ratio = next.as_ref().map_or(f64::NEG_INFINITY, |next| {
            (before - next.norm_squared()) / (before - linear).max(f64::MIN_POSITIVE)
        });

        if let Some(next) = next.filter(|_| ratio > RATIOS[0]) {
            (*x, residual, jacobian) = (trial, next, None);
        }
        damping = adapted(damping, ratio);
    }

    end.residual = residual.norm();
    end.converged = end.residual <= tolerance;
    end
}

/// The damping after a step with this ratio of actual to predicted decrease.
fn adapted(damping: f64, ratio: f64) -> f64 {
    if ratio < RATIOS[1] {
        damping * FACTOR
    } else if ratio > RATIOS[2] {
        BOUNDS[0].max(damping / FACTOR)
    } else {
        damping
    }
}

fn step(
    jacobian: &DMatrix<f64>,
    residual: &DVector<f64>,
    scale: &DVector<f64>,
    lambda: f64,
) -> Option<DVector<f64>> {
    let (rows, columns) = jacobian.shape();
    let mut matrix = DMatrix::zeros(rows + columns, columns);
    matrix.rows_mut(0, rows).copy_from(jacobian);
    for (j, scale) in scale.iter().enumerate() {
        matrix[(rows + j, j)] = lambda.sqrt() * scale;
    }
    let mut right = DVector::zeros(rows + columns);
    right.rows_mut(0, rows).copy_from(&-residual);
    let factors = matrix.qr();
    factors.q_tr_mul(&mut right);
    let step = factors.r().solve_upper_triangular(&right.rows(0, columns).into_owned())?;
    step.iter().all(|entry| entry.is_finite()).then_some(step)
}

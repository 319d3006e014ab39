//! The quadratic program of one step.

use clarabel::algebra::CscMatrix;
use clarabel::solver::{DefaultSettings, DefaultSolver, IPSolver, NonnegativeConeT, SolverStatus};
use nalgebra::{Cholesky, DMatrix, DVector};

use super::bounds::Bound;
use super::constants::{LENGTH_WEIGHT, MET};
use super::limits::Limit;

/// The step that takes away most of the errors, and the limits that it meets.
#[derive(Debug, Clone)]
pub(super) struct Found {
    pub(super) step: DVector<f64>,
    pub(super) met: Vec<Limit>,
}

/// Least squares `|rates step - errors|` with the least step, no entry of it beyond 1, within the bounds.
/// `None` where none is found.
pub(super) fn solve(rates: &DMatrix<f64>, errors: &DVector<f64>, bounds: &[Bound]) -> Option<Found> {
    let count = rates.ncols();
    let matrix = rates.tr_mul(rates);
    let weight = LENGTH_WEIGHT * matrix.diagonal().max();
    if weight.is_nan() || weight <= 0.0 {
        return Some(Found { step: DVector::zeros(count), met: Vec::new() });
    }
    minimum(&(matrix + DMatrix::identity(count, count) * weight), &rates.tr_mul(errors), bounds)
}

/// Corrects a step that has missed what it should have left by `missed`: least squares `|rates (out - step) - missed|` within the bounds,
/// where a correction of one longest step counts as much as all that was missed, so that it changes what little it can.
pub(super) fn correct(
    rates: &DMatrix<f64>,
    missed: &DVector<f64>,
    bounds: &[Bound],
    step: &DVector<f64>,
) -> Option<DVector<f64>> {
    let (count, weight) = (rates.ncols(), missed.norm_squared());
    let matrix = rates.tr_mul(rates) + DMatrix::identity(count, count) * weight;
    let slope = &matrix * step + rates.tr_mul(missed);
    minimum(&matrix, &slope, bounds).map(|found| found.step)
}

/// Minimum of `step . matrix step / 2 - slope . step` within the bounds, no entry beyond 1.
///
/// Where the free minimum is short enough and meets no bound, it is the answer; otherwise an interior-point method finds it. `None` where
/// that fails.
fn minimum(matrix: &DMatrix<f64>, slope: &DVector<f64>, bounds: &[Bound]) -> Option<Found> {
    let free = Cholesky::new(matrix.clone())?.solve(slope);
    let inside = |bound: &Bound| bound.slack + bound.gradient.dot(&free) >= 0.0;
    if free.amax() <= 1.0 && bounds.iter().all(inside) {
        return Some(Found { step: free, met: Vec::new() });
    }
    constrained(matrix, slope, bounds)
}

/// The minimum by an interior-point method.
fn constrained(matrix: &DMatrix<f64>, slope: &DVector<f64>, bounds: &[Bound]) -> Option<Found> {
    let count = slope.len();
    // To a size near 1, which the solver's tolerances are made for.
    let size = matrix.diagonal().max();
    let (mut rows, mut columns, mut values) = (Vec::new(), Vec::new(), Vec::new());
    for column in 0..count {
        for row in 0..=column {
            rows.push(row);
            columns.push(column);
            values.push(matrix[(row, column)] / size);
        }
    }
    let quadratic = CscMatrix::new_from_triplets(count, count, rows, columns, values);
    let linear: Vec<f64> = slope.iter().map(|entry| -entry / size).collect();
    let (mut rows, mut columns, mut values, mut sides) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    for entry in 0..count {
        for sign in [1.0, -1.0] {
            rows.push(sides.len());
            columns.push(entry);
            values.push(sign);
            sides.push(1.0);
        }
    }
    for bound in bounds {
        let largest = largest_change(bound);
        for (column, rate) in bound.gradient.iter().enumerate() {
            rows.push(sides.len());
            columns.push(column);
            values.push(-rate / largest);
        }
        sides.push((bound.slack / largest).max(0.0));
    }
    let inequalities = CscMatrix::new_from_triplets(sides.len(), count, rows, columns, values);
    let cones = [NonnegativeConeT(sides.len())];
    let settings = DefaultSettings { verbose: false, ..DefaultSettings::default() };
    let mut solver = DefaultSolver::new(&quadratic, &linear, &inequalities, &sides, &cones, settings).ok()?;
    solver.solve();
    if !matches!(solver.solution.status, SolverStatus::Solved | SolverStatus::AlmostSolved) {
        return None;
    }
    let step = DVector::from_column_slice(&solver.solution.x);
    let is_met = |bound: &&Bound| bound.slack + bound.gradient.dot(&step) <= MET * largest_change(bound);
    let met = bounds.iter().filter(is_met).map(|bound| bound.limit).collect();
    step.iter().all(|entry| entry.is_finite()).then_some(Found { step, met })
}

/// By how much a whole step of all freedoms can change what is bounded.
fn largest_change(bound: &Bound) -> f64 {
    bound.gradient.iter().map(|rate| rate.abs()).sum()
}

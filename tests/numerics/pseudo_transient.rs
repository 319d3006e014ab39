//! The damped motion with forces that have no potential: it rests where its linearisation says, and leaves what is unstable.

use mcm::numerics::pseudo_transient::settle;
use mcm::numerics::trust_region::{Minimum, Objective, Region};
use nalgebra::{DMatrix, DVector, Dyn, LU};

use crate::tolerance::RESTING;

/// Slopes and their matrix at a point.
type Flow = fn(&[f64]) -> (DVector<f64>, DMatrix<f64>);

struct Problem {
    flow: Flow,
    metric: Vec<f64>,
    gradient: Vec<f64>,
    matrix: DMatrix<f64>,
    factor: Option<LU<f64, Dyn, Dyn>>,
    dissipates: bool,
}

impl Objective for Problem {
    fn slope(&mut self, x: &[f64]) -> Option<f64> {
        self.gradient = (self.flow)(x).0.as_slice().to_vec();
        Some(0.0)
    }

    fn linearise(&mut self, x: &[f64]) -> Option<f64> {
        self.matrix = (self.flow)(x).1;
        self.slope(x)
    }

    fn gradient(&self) -> &[f64] {
        &self.gradient
    }

    fn factorise(&mut self, shift: f64) -> bool {
        let shifted = &self.matrix + DMatrix::from_diagonal(&DVector::from_row_slice(&self.metric)) * shift;
        self.dissipates = ((&shifted + shifted.transpose()) * 0.5).cholesky().is_some();
        self.factor = Some(shifted.lu());
        true
    }

    fn dissipates(&self) -> bool {
        self.dissipates
    }

    fn solve(&mut self, x: &mut [f64]) {
        let solution = self.factor.as_ref().expect("factorised").solve(&DVector::from_row_slice(x));
        x.copy_from_slice(solution.expect("regular").as_slice());
    }

    fn metric(&self) -> &[f64] {
        &self.metric
    }
}

fn run(flow: Flow, metric: &[f64], x: &mut [f64]) -> Minimum {
    let (metric, size) = (metric.to_vec(), x.len());
    let (gradient, matrix) = (vec![0.0; size], DMatrix::zeros(size, size));
    let mut problem = Problem { flow, metric, gradient, matrix, factor: None, dissipates: false };
    let region = Region { radius: 0.5, largest: 1.0, tolerance: 1e-11, iterations: 500 };
    settle(&mut problem, x, &region, || true)
}

/// A well at (1, 2), to which a swirl twice as strong turns: `g = (1 + 2 J)(x - x0) (1 + |x - x0|^2)`.
fn swirl(x: &[f64]) -> (DVector<f64>, DMatrix<f64>) {
    let turn = DMatrix::from_row_slice(2, 2, &[1.0, -2.0, 2.0, 1.0]);
    let off = DVector::from_vec(vec![x[0] - 1.0, x[1] - 2.0]);
    let stiffening = 1.0 + off.norm_squared();
    let matrix = &turn * (DMatrix::identity(2, 2) * stiffening + &off * off.transpose() * 2.0);
    (turn * off * stiffening, matrix)
}

/// Wells at `a = 1` and `a = -1` with a swirl between `a` and `b`, unstable at the origin: `g = (a^3 - a - b/2, b + a/2)`, whose
/// other rests have `a^2 = 1 - 1/4`.
fn wells(x: &[f64]) -> (DVector<f64>, DMatrix<f64>) {
    let (a, b) = (x[0], x[1]);
    let slopes = DVector::from_vec(vec![a * a * a - a - 0.5 * b, b + 0.5 * a]);
    (slopes, DMatrix::from_row_slice(2, 2, &[3.0 * a * a - 1.0, -0.5, 0.5, 1.0]))
}

#[test]
fn a_swirl_ends_where_it_rests() {
    for metric in [[1.0, 1.0], [0.3, 4.0]] {
        for start in [[0.0, 0.0], [1.1, 2.0], [-3.0, 5.0]] {
            let mut x = start;
            let end = run(swirl, &metric, &mut x);
            assert!(end.converged && end.iterations < 200, "{start:?}, {metric:?}: {end:?} at {x:?}");
            assert!((x[0] - 1.0).hypot(x[1] - 2.0) < RESTING, "{start:?}, {metric:?}: {x:?}");
        }
    }
}

#[test]
fn beside_an_unstable_rest_the_motion_leaves_it() {
    // -1/2 of `a`, driven by b = -a/2: a^3 = a - a/4.
    let rest = 0.75_f64.sqrt();
    for side in [1.0, -1.0] {
        for start in [1e-6, 1e-3, 0.3] {
            let mut x = [side * start, 0.0];
            let end = run(wells, &[1.0, 1.0], &mut x);
            assert!(end.converged, "{start}: {end:?} at {x:?}");
            let error = (x[0] - side * rest).hypot(x[1] + 0.5 * side * rest);
            assert!(error < RESTING, "{start}: ended at {x:?}, not at {rest} on its own side");
        }
    }
}

/// Exactly in balance there is no motion: that the point is unstable is for the caller to find.
#[test]
fn a_start_in_balance_stays_there_and_says_only_that() {
    let mut x = [0.0, 0.0];
    let end = run(wells, &[1.0, 1.0], &mut x);
    assert!(end.converged && end.iterations == 0 && x == [0.0, 0.0], "{end:?} at {x:?}");
}

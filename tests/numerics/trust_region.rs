//! The trust region on functions with known minima, saddles and walls.

use mcm::numerics::trust_region::{Minimum, Objective, Region, minimise};
use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

/// Value, gradient and Hessian at a point, or nothing behind a wall.
type Function = fn(&[f64]) -> Option<(f64, DVector<f64>, DMatrix<f64>)>;

struct Problem {
    function: Function,
    metric: Vec<f64>,
    gradient: Vec<f64>,
    hessian: DMatrix<f64>,
    factor: Option<Cholesky<f64, Dyn>>,
}

impl Objective for Problem {
    fn slope(&mut self, x: &[f64]) -> Option<f64> {
        let (value, gradient, _) = (self.function)(x)?;
        self.gradient = gradient.as_slice().to_vec();
        Some(value)
    }

    fn linearise(&mut self, x: &[f64]) -> Option<f64> {
        let (value, gradient, hessian) = (self.function)(x)?;
        self.gradient = gradient.as_slice().to_vec();
        self.hessian = hessian;
        Some(value)
    }

    fn gradient(&self) -> &[f64] {
        &self.gradient
    }

    fn factorise(&mut self, shift: f64) -> bool {
        let metric = DMatrix::from_diagonal(&DVector::from_row_slice(&self.metric));
        self.factor = shift.is_finite().then(|| Cholesky::new(&self.hessian + metric * shift)).flatten();
        self.factor.is_some()
    }

    fn solve(&mut self, x: &mut [f64]) {
        let factor = self.factor.as_ref().expect("factorised before");
        x.copy_from_slice(factor.solve(&DVector::from_row_slice(x)).as_slice());
    }

    fn metric(&self) -> &[f64] {
        &self.metric
    }
}

fn run(function: Function, metric: &[f64], x: &mut [f64]) -> Minimum {
    let size = x.len();
    let (metric, gradient, hessian) = (metric.to_vec(), vec![0.0; size], DMatrix::zeros(size, size));
    let mut problem = Problem { function, metric, gradient, hessian, factor: None };
    minimise(&mut problem, x, &Region { radius: 0.1, largest: 1.0, tolerance: 1e-9, iterations: 200 }, || {
        true
    })
}

/// `(x^2 - 1)^2 / 4 + y^2 / 2 + x y / 10`: a saddle at the origin between two minima.
#[expect(clippy::unnecessary_wraps, reason = "the signature of every landscape")]
fn two_wells(x: &[f64]) -> Option<(f64, DVector<f64>, DMatrix<f64>)> {
    let (a, b) = (x[0], x[1]);
    Some((
        0.25 * (a * a - 1.0).powi(2) + 0.5 * b * b + 0.1 * a * b,
        DVector::from_vec(vec![a * (a * a - 1.0) + 0.1 * b, b + 0.1 * a]),
        DMatrix::from_row_slice(2, 2, &[3.0 * a * a - 1.0, 0.1, 0.1, 1.0]),
    ))
}

/// Rosenbrock's valley.
#[expect(clippy::unnecessary_wraps, reason = "the signature of every landscape")]
fn valley(x: &[f64]) -> Option<(f64, DVector<f64>, DMatrix<f64>)> {
    let (a, b) = (x[0], x[1]);
    let off = b - a * a;
    Some((
        (1.0 - a).powi(2) + 100.0 * off * off,
        DVector::from_vec(vec![-2.0 * (1.0 - a) - 400.0 * a * off, 200.0 * off]),
        DMatrix::from_row_slice(2, 2, &[2.0 - 400.0 * (off - 2.0 * a * a), -400.0 * a, -400.0 * a, 200.0]),
    ))
}

/// `x^2/2 - ln(1 - x)` on `x < 1`, with a saddle's cosine beside it.
fn wall(x: &[f64]) -> Option<(f64, DVector<f64>, DMatrix<f64>)> {
    let room = 1.0 - x[0];
    (room > 0.0).then(|| {
        (
            0.5 * x[0] * x[0] - room.ln() + x[1].cos(),
            DVector::from_vec(vec![x[0] + 1.0 / room, -x[1].sin()]),
            DMatrix::from_row_slice(2, 2, &[1.0 + 1.0 / (room * room), 0.0, 0.0, -x[1].cos()]),
        )
    })
}

#[test]
fn a_saddle_is_left_for_one_of_the_minima() {
    // The minima: a^2 = 1 + 0.01, b = -a / 10.
    let at = 1.01_f64.sqrt();
    for metric in [[1.0, 1.0], [1e-3, 1e2]] {
        for start in [[0.0, 0.0], [0.0, 0.5], [1e-6, 0.0], [-0.01, 0.2], [5.0, -3.0]] {
            let mut x = start;
            let end = run(two_wells, &metric, &mut x);
            assert!(end.converged, "{start:?}, {metric:?}: {end:?} at {x:?}");
            let error = (x[0].abs() - at).abs() + (x[1] + 0.1 * x[0]).abs();
            assert!(error < 1e-6, "{start:?}, {metric:?}: ended at {x:?}");
            assert_eq!(end.tie, start == [0.0, 0.0], "{start:?}: a tie is reported where there is one");
        }
    }
}

#[test]
fn far_from_the_minimum_with_negative_curvature_every_step_goes_down() {
    // Past the inflection the Hessian is indefinite and no step is short enough at first.
    for start in [[0.1, 0.0], [-0.3, 1.0], [0.5, 1.0]] {
        let mut x = start;
        let end = run(two_wells, &[1.0, 1.0], &mut x);
        assert!(end.converged && end.iterations < 40, "{start:?}: {end:?}");
        assert!(x[0] * start[0] > 0.0, "{start:?}: small steps end in the nearer well, not at {x:?}");
    }
}

#[test]
fn a_curved_valley_is_followed() {
    let mut x = [-1.2, 1.0];
    let end = run(valley, &[1.0, 1.0], &mut x);
    assert!(end.converged, "{end:?}");
    assert!((x[0] - 1.0).abs() + (x[1] - 1.0).abs() < 1e-7, "{x:?}");
}

#[test]
fn where_the_function_ends_steps_are_shortened() {
    // x + 1/(1 - x) = 0: x = (1 - sqrt 5)/2.
    let mut x = [0.999, 0.3];
    let end = run(wall, &[1.0, 1.0], &mut x);
    assert!(end.converged, "{end:?} at {x:?}");
    let expected = [0.5 * (1.0 - 5.0_f64.sqrt()), core::f64::consts::PI];
    assert!((x[0] - expected[0]).abs() + (x[1] - expected[1]).abs() < 1e-7, "{x:?}");
    let mut outside = [1.5, 0.0];
    assert!(!run(wall, &[1.0, 1.0], &mut outside).converged, "a start behind the wall");
}

/// What was asked of an objective: its value and slopes at a point, or these and the Hessian.
struct Watched {
    problem: Problem,
    here: Vec<f64>,
    slope: DVector<f64>,
    tried: u32,
    refused: u32,
    /// Whether the next trial may be a bent one: the matrix has been factorised last to bend a step.
    bends: bool,
}

impl Objective for Watched {
    fn slope(&mut self, x: &[f64]) -> Option<f64> {
        // Whatever was tried before, a first trial is along the way down from where it starts; bent ones go on from it.
        let step = DVector::from_row_slice(x) - DVector::from_row_slice(&self.here);
        assert!(self.bends || self.slope.dot(&step) < 0.0, "uphill from {:?} to {x:?}", self.here);
        (self.tried, self.bends) = (self.tried + 1, true);
        self.problem.slope(x)
    }

    fn linearise(&mut self, x: &[f64]) -> Option<f64> {
        let value = self.problem.linearise(x)?;
        self.refused += self.tried.saturating_sub(1);
        (self.here, self.tried) = (x.to_vec(), 0);
        self.slope = DVector::from_row_slice(self.problem.gradient());
        Some(value)
    }

    fn gradient(&self) -> &[f64] {
        self.problem.gradient()
    }

    fn factorise(&mut self, shift: f64) -> bool {
        self.bends &= shift != 0.0; // every iteration begins without a shift
        self.problem.factorise(shift)
    }

    fn solve(&mut self, x: &mut [f64]) {
        self.problem.solve(x);
    }

    fn metric(&self) -> &[f64] {
        self.problem.metric()
    }
}

/// `ln(1 + x^2)` in both directions, whose Newton steps from far away lead to the other side and further.
#[expect(clippy::unnecessary_wraps, reason = "the signature of every landscape")]
fn funnel(x: &[f64]) -> Option<(f64, DVector<f64>, DMatrix<f64>)> {
    let slope = |a: f64| 2.0 * a / (1.0 + a * a);
    let curve = |a: f64| 2.0 * (1.0 - a * a) / (1.0 + a * a).powi(2);
    Some((
        x.iter().map(|a| (a * a).ln_1p()).sum(),
        DVector::from_iterator(2, x.iter().map(|a| slope(*a))),
        DMatrix::from_diagonal(&DVector::from_iterator(2, x.iter().map(|a| curve(*a)))),
    ))
}

#[test]
fn a_refused_trial_leaves_no_trace_in_the_next_step() {
    for start in [[0.9, 0.95], [3.0, -2.0], [0.1, 7.0]] {
        let (metric, gradient) = (vec![1.0; 2], vec![0.0; 2]);
        let problem =
            Problem { function: funnel, metric, gradient, hessian: DMatrix::zeros(2, 2), factor: None };
        let slope = DVector::zeros(2);
        let mut watched =
            Watched { problem, here: start.to_vec(), slope, tried: 0, refused: 0, bends: false };
        let mut x = start;
        let region = Region { radius: 20.0, largest: 20.0, tolerance: 1e-9, iterations: 200 };
        let end = minimise(&mut watched, &mut x, &region, || true);
        assert!(end.converged && x[0].hypot(x[1]) < 1e-8, "{start:?}: {end:?} at {x:?}");
        assert!(watched.refused > 0, "{start:?}: no trial was refused");
    }
}

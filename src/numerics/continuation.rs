//! Pseudo-arclength continuation of the stationary points of a potential: through folds, stable or not.
//!
//! The branch `g(x, p) = 0` is followed along its arc length in the joint space of `x` and `p`, in which a fold is a
//! regular point: each point is predicted along the tangent and corrected by Newton's method normal to it. The method
//! is H. B. Keller's (Applications of Bifurcation Theory, Academic Press 1977); see also Allgower and Georg,
//! Introduction to Numerical Continuation Methods, SIAM 2003, doi:10.1137/1.9780898719154, chapters 2, 6 and 9.

use nalgebra::{DMatrix, DVector};

use crate::error::{Error, check};

/// Largest number of Newton corrections per point.
const CORRECTIONS: u32 = 8;

/// Largest ratio of successive corrections; beyond it the corrector is stopped and the step shortened.
const CONTRACTION: f64 = 0.5;

/// Norm of a correction at which the corrector has converged: the remaining error is its square.
const CONVERGED: f64 = 1e-8;

/// Rotation of the tangent (rad) per step below which steps grow, and above which they shrink.
const TURN: f64 = 0.1;

/// Rotation of the tangent (rad) above which a step is repeated with a shorter length.
const LARGEST_TURN: f64 = 0.3;

/// Factors by which the step length changes.
const SHRINK: f64 = 0.5;
const GROW: f64 = 1.6;

/// The first and the shortest step, relative to the longest.
const FIRST: f64 = 0.1;
const SHORTEST: f64 = 1e-6;

/// Tolerance of the test function, which vanishes at a singular point, or of its bracket relative to the step.
const VANISHED: f64 = 1e-10;

/// Absolute value of the test function above which the corrector has jumped to another branch.
const JUMPED: f64 = 1e-6;

/// Largest number of secant steps to a singular point.
const SECANTS: u32 = 60;

/// A potential with one parameter, in variables scaled to order one.
pub trait Family {
    /// Derivatives at `x`; `None` where the potential is not defined.
    ///
    /// # Errors
    /// Those of the parametrised model; they end the continuation.
    fn at(&mut self, x: &DVector<f64>, parameter: f64) -> Result<Option<Local>, Error>;
}

/// Derivatives of a potential at a point.
#[derive(Debug, Clone, PartialEq)]
pub struct Local {
    /// Gradient `g` with respect to `x`.
    pub gradient: DVector<f64>,
    /// Hessian with respect to `x`.
    pub hessian: DMatrix<f64>,
    /// Derivative of the gradient with respect to the parameter.
    pub drift: DVector<f64>,
}

/// Start, range and step limits of a continuation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Walk {
    /// The parameter at the first point.
    pub from: f64,
    /// Whether the first step goes to larger parameters.
    pub upwards: bool,
    /// Smallest and largest parameter: the continuation ends where it leaves them.
    pub range: [f64; 2],
    /// Longest step in the joint space of `x` and parameter.
    pub longest_step: f64,
    /// Largest number of points.
    pub points: usize,
}

/// Type of a point of the branch.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PointKind {
    /// A regular point.
    Regular,
    /// A fold: the parameter turns back, and beyond it this stationary point does not exist.
    Fold,
    /// A branching point: this number of directions lose or gain stability while the parameter continues; other
    /// branches cross or begin there.
    Branching(usize),
}

/// A stationary point.
#[derive(Debug, Clone, PartialEq)]
pub struct Point {
    /// Location.
    pub x: DVector<f64>,
    /// Parameter.
    pub parameter: f64,
    /// Unit tangent of the branch: components of `x`, then of the parameter.
    pub tangent: DVector<f64>,
    /// Eigenvalues of the Hessian, ascending.
    pub eigenvalues: Vec<f64>,
    /// Type of the point.
    pub kind: PointKind,
}

/// Reason why a continuation ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum End {
    /// The branch has reached an end of the range; its last point lies there.
    Range,
    /// No further point is found even with the shortest step: the potential is undefined there, or the branch has a
    /// corner.
    Stuck,
    /// The largest number of points is reached.
    Points,
}

impl Point {
    /// Number of negative eigenvalues; 0 at a minimum.
    #[must_use]
    pub fn negative(&self) -> usize {
        self.eigenvalues.iter().take_while(|value| **value < 0.0).count()
    }

    /// The smallest eigenvalue.
    #[must_use]
    pub fn smallest(&self) -> f64 {
        self.eigenvalues.first().copied().unwrap_or(f64::NAN)
    }

    /// Derivative of the parameter along the branch, from -1 to 1; 0 at a fold.
    #[must_use]
    pub fn slope(&self) -> f64 {
        self.tangent[self.x.len()]
    }

    fn place(&self) -> DVector<f64> {
        self.x.push(self.parameter)
    }
}

/// Follows the branch through the stationary point near `x`; returns its points, including folds and branching points,
/// and why it ends.
///
/// The potential is also evaluated up to one step beyond the range. No points are returned if no stationary point is
/// close to `x`.
///
/// # Errors
/// [`Error::Range`] for a walk that starts outside its range or whose longest step is not positive; those of the
/// family.
pub fn follow(family: &mut impl Family, x: &DVector<f64>, walk: &Walk) -> Result<(Vec<Point>, End), Error> {
    let [low, high] = walk.range;
    check("first parameter of the walk", walk.from, |v| low <= v && v <= high, "within its range")?;
    check("longest step of the walk", walk.longest_step, |v| v > 0.0, "> 0")?;

    // The first point is corrected at its own parameter: the plane normal to that axis.
    let mut along = DVector::zeros(x.len() + 1);
    along[x.len()] = if walk.upwards { 1.0 } else { -1.0 };
    let Some((first, _)) = correct(family, x.push(walk.from), &along)? else {
        return Ok((Vec::new(), End::Stuck));
    };

    let mut points = vec![first.clone()];
    let (mut here, mut step) = (first, FIRST * walk.longest_step);
    while points.len() < walk.points {
        if step < SHORTEST * walk.longest_step {
            return Ok((points, End::Stuck));
        }
        let Some((next, length)) = advance(family, &here, step)? else {
            step *= SHRINK;
            continue;
        };

        let Some(singular) = between(family, &here, &next, step)? else {
            step *= SHRINK;
            continue;
        };
        points.extend(singular.into_iter().filter(|point| (low..=high).contains(&point.parameter)));

        if next.parameter <= low || next.parameter >= high {
            points.extend(at_limit(family, &here, &next, next.parameter.clamp(low, high))?);
            return Ok((points, End::Range));
        }

        points.push(next.clone());
        (here, step) = (next, length.min(walk.longest_step));
    }
    Ok((points, End::Points))
}

/// The point one step ahead, and the length of the next step; `None` if the step is too long.
fn advance(family: &mut impl Family, here: &Point, step: f64) -> Result<Option<(Point, f64)>, Error> {
    let guess = here.place() + &here.tangent * step;
    let Some((next, corrections)) = correct(family, guess, &here.tangent)? else { return Ok(None) };
    let turn = here.tangent.dot(&next.tangent).clamp(-1.0, 1.0).acos();
    if turn > LARGEST_TURN {
        return Ok(None);
    }
    let factor = if corrections > CORRECTIONS / 2 { SHRINK } else { (TURN / turn).clamp(SHRINK, GROW) };
    Ok(Some((next, factor * step)))
}

/// Newton's method in the plane normal to `normal` through `guess`; also returns the number of corrections.
fn correct(
    family: &mut impl Family,
    guess: DVector<f64>,
    normal: &DVector<f64>,
) -> Result<Option<(Point, u32)>, Error> {
    let size = guess.len() - 1;
    let (mut place, mut previous) = (guess, f64::INFINITY);

    for corrections in 1..=CORRECTIONS {
        let x = place.rows(0, size).into_owned();
        let Some(local) = family.at(&x, place[size])? else { return Ok(None) };
        let Some(step) = bordered(&local, normal).lu().solve(&(-local.gradient).push(0.0)) else {
            return Ok(None);
        };

        // Newton's method converges quadratically near the branch; corrections that shrink slowly come from
        // elsewhere.
        let length = step.norm();
        if length.is_nan() || length > CONTRACTION * previous && length > CONVERGED {
            return Ok(None);
        }
        place += step;
        previous = length;

        if length <= CONVERGED {
            return Ok(finish(family, &place, normal)?.map(|point| (point, corrections)));
        }
    }
    Ok(None)
}

/// Completes a converged point with its tangent and eigenvalues.
fn finish(
    family: &mut impl Family,
    place: &DVector<f64>,
    normal: &DVector<f64>,
) -> Result<Option<Point>, Error> {
    let size = place.len() - 1;
    let x = place.rows(0, size).into_owned();
    let Some(local) = family.at(&x, place[size])? else { return Ok(None) };
    let ahead = DVector::zeros(size).push(1.0);
    let Some(tangent) = bordered(&local, normal).lu().solve(&ahead) else { return Ok(None) };
    let mut eigenvalues = local.hessian.symmetric_eigenvalues().as_slice().to_vec();
    eigenvalues.sort_by(f64::total_cmp);
    Ok(Some(Point {
        x,
        parameter: place[size],
        tangent: tangent.normalize(),
        eigenvalues,
        kind: PointKind::Regular,
    }))
}

/// Bordered matrix of Newton's method on the branch and in the plane normal to `normal`: regular at folds, too.
fn bordered(local: &Local, normal: &DVector<f64>) -> DMatrix<f64> {
    let size = local.gradient.len();
    let mut out = local.hessian.clone().resize(size + 1, size + 1, 0.0);
    out.view_mut((0, size), (size, 1)).copy_from(&local.drift);
    out.row_mut(size).copy_from(&normal.transpose());
    out
}

/// The singular point within a step, if it has one; `None` if a shorter step is needed.
///
/// A shorter step is needed if there are several singular points, or if the expected one is not found because the step
/// has led to another branch.
fn between(
    family: &mut impl Family,
    here: &Point,
    next: &Point,
    step: f64,
) -> Result<Option<Vec<Point>>, Error> {
    let (before, after) = (here.negative(), next.negative());
    let changed = before.abs_diff(after);
    let folds = here.slope() * next.slope() < 0.0;
    let found = match (folds, changed) {
        (false, 0) => return Ok(Some(Vec::new())),
        (true, 1) => locate(family, here, next, step, PointKind::Fold, Point::slope)?,
        (true, _) => None,
        (false, _) => {
            let crossing = before.min(after);
            let kind = PointKind::Branching(changed);
            locate(family, here, next, step, kind, |point| point.eigenvalues[crossing])?
        }
    };
    Ok(found.map(|point| vec![point]))
}

/// Locates the zero of `measure` within a step by bracketing secants (Illinois rule: M. Dowell and P. Jarratt, BIT 11,
/// 1971, doi:10.1007/BF01934364).
fn locate(
    family: &mut impl Family,
    here: &Point,
    next: &Point,
    step: f64,
    kind: PointKind,
    measure: impl Fn(&Point) -> f64,
) -> Result<Option<Point>, Error> {
    let (mut low, mut at_low) = (0.0, measure(here));
    let (mut high, mut at_high) = (step, measure(next));
    let mut found = None;

    for _ in 0..SECANTS {
        let middle = (low * at_high - high * at_low) / (at_high - at_low);
        let guess = here.place() + &here.tangent * middle;
        let Some((point, _)) = correct(family, guess, &here.tangent)? else { break };
        let value = measure(&point);

        // Between two branches the test function changes its sign by a jump: no zero, hence no singular
        // point.
        found = (value.abs() <= JUMPED).then_some(Point { kind, ..point });
        if value.abs() <= VANISHED || (high - low).abs() <= VANISHED * step {
            break;
        }

        // Illinois: an end that stays twice counts half, or the secants would approach from one side for
        // ever.
        if value * at_high < 0.0 {
            (low, at_low) = (high, at_high);
        } else {
            at_low *= 0.5;
        }
        (high, at_high) = (middle, value);
    }
    Ok(found)
}

/// The point of the branch at this parameter, within a step.
fn at_limit(
    family: &mut impl Family,
    here: &Point,
    next: &Point,
    parameter: f64,
) -> Result<Option<Point>, Error> {
    let part = (parameter - here.parameter) / (next.parameter - here.parameter);
    let guess = here.place().lerp(&next.place(), part);
    let mut along = DVector::zeros(guess.len());
    along[guess.len() - 1] = here.slope().signum();
    Ok(correct(family, guess, &along)?.map(|(point, _)| point))
}

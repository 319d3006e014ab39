//! Continuation of the stationary points of a potential by pseudo-arclength: through folds, stable or not.
//!
//! The branch `g(x, p) = 0` is followed by its arc length in the space of `x` and `p` together, in which a fold is no
//! special place: each point is predicted along the tangent and corrected by Newton's method across it. The method is
//! H. B. Keller's (Applications of Bifurcation Theory, Academic Press 1977); see also Allgower and Georg, Introduction
//! to Numerical Continuation Methods, SIAM 2003, chapters 2, 6 and 9.

use nalgebra::{DMatrix, DVector};

use crate::error::{Error, check};

/// Newton corrections of one point at most.
const CORRECTIONS: u32 = 8;

/// A correction that shrinks by less than this from one to the next is given up, and the step shortened.
const CONTRACTION: f64 = 0.5;

/// So short a correction is the last one: what is left is its square.
const SETTLED: f64 = 1e-8;

/// Steps grow while the tangent turns by less than this (rad), and shrink beyond.
const TURN: f64 = 0.1;

/// A step along which the tangent turns by more (rad) is taken again, shorter.
const LARGEST_TURN: f64 = 0.3;

/// Factors between the lengths of two steps.
const SHRINK: f64 = 0.5;
const GROW: f64 = 1.6;

/// The first step and the shortest, relative to the longest.
const FIRST: f64 = 0.1;
const SHORTEST: f64 = 1e-6;

/// A singular point is located until what vanishes there is this small, or its interval this part of the step.
const VANISHED: f64 = 1e-10;

/// What does not vanish to this has jumped: the step has led to another branch.
const JUMPED: f64 = 1e-6;

/// Secants at most on the way to a singular point.
const SECANTS: u32 = 60;

/// A potential that depends on one parameter, in variables that are scaled to order one.
pub trait Family {
    /// Derivatives at `x`; `None` where the potential is not defined.
    ///
    /// # Errors
    /// Those of whatever the parameter stands for: they end the continuation.
    fn at(&mut self, x: &DVector<f64>, parameter: f64) -> Result<Option<Local>, Error>;
}

/// Derivatives of a potential at a point.
#[derive(Debug, Clone, PartialEq)]
pub struct Local {
    /// Gradient `g` by `x`.
    pub gradient: DVector<f64>,
    /// Hessian by `x`.
    pub hessian: DMatrix<f64>,
    /// Derivative of the gradient by the parameter.
    pub drift: DVector<f64>,
}

/// Where to go.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Walk {
    /// The parameter at the first point.
    pub from: f64,
    /// The first step goes to larger parameters.
    pub upwards: bool,
    /// Smallest and largest parameter: the walk ends where it leaves them.
    pub range: [f64; 2],
    /// Longest step in the space of `x` and parameter.
    pub longest_step: f64,
    /// Points at most.
    pub points: usize,
}

/// What is special about a point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PointKind {
    /// Nothing.
    Regular,
    /// The parameter turns back: beyond it there is no such stationary point.
    Fold,
    /// So many directions lose or gain their stability while the parameter goes on: other branches cross or begin.
    Branching(usize),
}

/// A stationary point.
#[derive(Debug, Clone, PartialEq)]
pub struct Point {
    /// Where it is.
    pub x: DVector<f64>,
    /// At which parameter.
    pub parameter: f64,
    /// Unit tangent of the branch: by `x`, then by the parameter.
    pub tangent: DVector<f64>,
    /// Eigenvalues of the Hessian, ascending.
    pub eigenvalues: Vec<f64>,
    /// What is special about it.
    pub kind: PointKind,
}

/// Why a walk ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum End {
    /// It reached the end of the range: its last point is there.
    Range,
    /// No shorter step finds a next point: the potential ends, or the branch has a corner.
    Stuck,
    /// It has as many points as were asked for.
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

    /// The change of the parameter along the branch, from -1 to 1; 0 at a fold.
    #[must_use]
    pub fn slope(&self) -> f64 {
        self.tangent[self.x.len()]
    }

    fn place(&self) -> DVector<f64> {
        self.x.push(self.parameter)
    }
}

/// Follows the branch through the stationary point next to `x`: its points, folds and branching points among them.
///
/// The potential is asked for a step's length beyond the range, too. No points are found where none is close to `x`.
///
/// # Errors
/// [`Error::Range`] for a walk that starts outside its range or has no steps; those of the family.
pub fn follow(family: &mut impl Family, x: &DVector<f64>, walk: &Walk) -> Result<(Vec<Point>, End), Error> {
    let [low, high] = walk.range;
    check("first parameter of the walk", walk.from, |v| low <= v && v <= high, "within its range")?;
    check("longest step of the walk", walk.longest_step, |v| v > 0.0, "> 0")?;
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

/// The point a step ahead, and the length of the next step; `None` if the step is too long.
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

/// Newton's method in the plane across `normal` through `guess`; the corrections that it took.
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
        let length = step.norm();
        if length.is_nan() || length > CONTRACTION * previous && length > SETTLED {
            return Ok(None);
        }
        place += step;
        previous = length;
        if length <= SETTLED {
            return Ok(finish(family, &place, normal)?.map(|point| (point, corrections)));
        }
    }
    Ok(None)
}

/// Tangent and eigenvalues at a solved place.
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

/// The matrix of Newton's method on the branch and in the plane across `normal`: regular at folds, too.
fn bordered(local: &Local, normal: &DVector<f64>) -> DMatrix<f64> {
    let size = local.gradient.len();
    let mut out = local.hessian.clone().resize(size + 1, size + 1, 0.0);
    out.view_mut((0, size), (size, 1)).copy_from(&local.drift);
    out.row_mut(size).copy_from(&normal.transpose());
    out
}

/// The singular point within a step, if it has one; `None` if there are several, or none where there should be one
/// because the step has led to another branch: a shorter one tells.
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

/// Finds where `measure` vanishes within a step: by secants that keep the zero between them (the Illinois rule: M. Dowell
/// and P. Jarratt, BIT 11, 1971).
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
        found = (value.abs() <= JUMPED).then_some(Point { kind, ..point });
        if value.abs() <= VANISHED || (high - low).abs() <= VANISHED * step {
            break;
        }
        if value * at_high < 0.0 {
            (low, at_low) = (high, at_high);
        } else {
            at_low *= 0.5;
        }
        (high, at_high) = (middle, value);
    }
    Ok(found)
}

/// The point of a step at this parameter.
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

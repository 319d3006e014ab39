//! Following a branch along a path of inputs, and locating the folds where it is left.

use serde::{Deserialize, Serialize};

use super::followed::Followed;
use super::prediction::{REMEMBERED, predicted};
use super::{Inputs, Manipulator, Outcome, Outputs, Snapshot, Status};
use crate::equilibrium::Deadline;
use crate::error::{Error, check};

/// Width of the interval in which a fold is located, relative to the span of the path.
const FOLD_WIDTH: f64 = 1e-5;

/// Part of the longest step by which rounding may make an even step longer.
const ROUNDING: f64 = 1e-9;

/// Part of the time budget that is kept for the rest of the way when short steps end, and when the search for a fold does.
const KEPT: (f64, f64) = (0.5, 0.25);

/// A fold, where the followed branch was left.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Fold {
    /// Path parameter at the fold: the middle of an interval.
    pub value: f64,
    /// Width of that interval.
    pub width: f64,
    /// Whether it is at most 1e-5 of the path's span; else the time budget ended the search.
    pub located: bool,
    /// Whether the fold was met with increasing path parameter.
    pub upwards: bool,
    /// The last shape on the branch, with its stability margin measured.
    pub before: Outputs,
    /// Path parameter and outputs of the next shape found; `None` if the branch ends and no stable shape was found.
    pub after: Option<(f64, Outputs)>,
    /// Outcome of the solve just beyond the fold.
    pub outcome: Outcome,
}

/// A manipulator followed along a path of inputs with one scalar parameter.
///
/// ```
/// use mcm::manipulator::{Branch, Inputs, Scene};
/// // The rings' and the helix' attraction pulls one segment shut at 35.83 mT; all steps share the time budget.
/// let text = "[design]\nsegments = 1\n[model]\ninteraction = \"full\"\ntime_budget_s = 60.0";
/// let scene = Scene::parse(text, "doc")?;
/// let field = |b: f64| Ok(Inputs { uniform_field: [0.0, b, 0.0].into(), ..Inputs::unloaded(2) });
/// let mut branch = Branch::new(scene.manipulator(2)?, field, 0.04, 0.004)?;
/// branch.to(0.0)?;
/// branch.to(0.04)?;
/// assert_eq!(branch.folds().len(), 1);
/// assert!((branch.folds()[0].value - 35.83e-3).abs() < 1e-5);
/// # Ok::<(), mcm::error::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Branch<F, M = Manipulator> {
    manipulator: M,
    inputs: F,
    span: f64,
    longest_step: f64,
    /// Processor time that each call may take, s.
    time_budget: f64,
    /// Path parameter at which the manipulator's present shape is in equilibrium.
    here: Option<f64>,
    /// Whether the path went upwards where the branch was lost, if it was.
    lost: Option<bool>,
    /// What the last call found instead of a shape.
    failed: Option<M>,
    /// What the time budget made the last call leave out.
    left_out: Option<String>,
    folds: Vec<Fold>,
    /// Path parameter and stability margin at the last solved targets of [`Branch::to`] on this branch.
    margins: Vec<(f64, f64)>,
}

/// Serializable state of a branch that is being followed, from which another one goes on with bit-identical results.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PathSnapshot {
    manipulator: Snapshot,
    here: Option<f64>,
    lost: Option<bool>,
    folds: Vec<Fold>,
    margins: Vec<(f64, f64)>,
}

impl<F: Fn(f64) -> Result<Inputs, Error>, M: Followed> Branch<F, M> {
    /// Creates the unsolved branch of `manipulator`; `inputs` gives the inputs at each path parameter.
    ///
    /// `span` is the range of the path parameter. No step between two solves is longer than `longest_step`: within a step the
    /// inputs change linearly, and a rotated field changes along the chord.
    ///
    /// # Errors
    /// [`Error::Range`] for a span or a step that is not positive.
    pub fn new(manipulator: M, inputs: F, span: f64, longest_step: f64) -> Result<Self, Error> {
        check("span of the path", span, |v| v > 0.0, "> 0")?;
        check("longest step on the path", longest_step, |v| v > 0.0, "> 0")?;
        Ok(Self {
            time_budget: manipulator.time_budget(),
            manipulator,
            inputs,
            span,
            longest_step,
            here: None,
            lost: None,
            failed: None,
            left_out: None,
            folds: Vec::new(),
            margins: Vec::new(),
        })
    }

    /// Follows the branch to `target` and locates the folds on the way; the first call starts from the unloaded shape.
    ///
    /// All steps and the search for folds share the time budget of one solve: when half of it is used up, the rest of the way is one
    /// step, and when a quarter is left, the search ends. Where no shape is found, the outputs remain those of the last one, with
    /// [`Status::NotSolved`]. The next call in the same direction starts anew from the unloaded shape; one in the opposite
    /// direction goes on from the last shape.
    ///
    /// # Errors
    /// Those of the inputs and of [`Manipulator::solve`].
    pub fn to(&mut self, target: f64) -> Result<&Outputs, Error> {
        let clock = Deadline::new(self.time_budget);
        (self.failed, self.left_out) = (None, None);
        match self.here {
            Some(here) if self.lost != Some(target > here) => self.follow(here, target, &clock)?,
            _ => self.start_anew(target, &clock)?,
        }
        if self.failed.is_none() {
            self.remember(target);
        }
        Ok(self.outputs())
    }

    /// The outputs at the last target.
    #[must_use]
    pub fn outputs(&self) -> &Outputs {
        self.failed.as_ref().unwrap_or(&self.manipulator).outputs()
    }

    /// What was left out on the way to the last target, because the time budget was used up; `None` where all was done.
    #[must_use]
    pub fn left_out(&self) -> Option<&str> {
        self.left_out.as_deref()
    }

    /// The folds met so far, in order.
    #[must_use]
    pub fn folds(&self) -> &[Fold] {
        &self.folds
    }

    /// Predicted path parameter of the next fold, extrapolated from the last two to four targets.
    ///
    /// The stability margin goes to zero as a power of the distance: 1/2 before a fold, 1 where a symmetric shape loses its
    /// stability without one, in between where it is nearly symmetric; four targets also tell its curvature. `None` where the
    /// margin grows or is above 0.35.
    #[must_use]
    pub fn predicted_fold(&self) -> Option<f64> {
        predicted(&self.margins)
    }

    /// The state; `None` for a manipulator solved by another method than the potential method.
    #[must_use]
    pub fn snapshot(&self) -> Option<PathSnapshot> {
        let Self { manipulator, here, lost, folds, margins, .. } = self;
        let (manipulator, folds, margins) = (manipulator.snapshot()?, folds.clone(), margins.clone());
        Some(PathSnapshot { manipulator, here: *here, lost: *lost, folds, margins })
    }

    /// Goes on from the state of another branch of the same manipulator, inputs and steps.
    ///
    /// # Errors
    /// As [`Manipulator::restore`](super::Manipulator::restore).
    pub fn restore(&mut self, snapshot: &PathSnapshot) -> Result<(), Error> {
        let PathSnapshot { manipulator, here, lost, folds, margins } = snapshot;
        self.manipulator.restore(manipulator)?;
        (self.here, self.lost) = (*here, *lost);
        (self.folds, self.margins) = (folds.clone(), margins.clone());
        Ok(())
    }

    /// Follows the branch in steps from `here`.
    fn follow(&mut self, mut here: f64, target: f64, clock: &Deadline) -> Result<(), Error> {
        let longest = self.longest_step * (1.0 + ROUNDING);
        self.lost = None;
        while self.failed.is_none() && here.total_cmp(&target).is_ne() {
            let step = (target - here).clamp(-longest, longest);
            let mut next = if (target - here).abs() <= longest { target } else { here + step };
            if next.total_cmp(&target).is_ne() && self.is_late(clock, KEPT.0) {
                self.leave_out(&format!("the way from {here} to {target} is one step, which may miss snaps"));
                next = target;
            }
            let trial = self.trial(next, clock.left())?;
            if on_branch(&trial) {
                (self.manipulator, here) = (trial, next);
            } else if is_out_of_budget(&trial) {
                self.lose(trial, next > here); // whether there is a fold is not known
            } else {
                here = self.pass_fold(here, next, trial, clock)?;
            }
        }
        self.here = Some(here);
        Ok(())
    }

    /// Solves at `target` from the unloaded shape.
    fn start_anew(&mut self, target: f64, clock: &Deadline) -> Result<(), Error> {
        let mut fresh = self.manipulator.clone();
        fresh.start_anew();
        fresh.set_time_budget(clock.left());
        fresh.solve(&(self.inputs)(target)?)?;
        if fresh.outputs().status == Status::NotSolved {
            self.failed = Some(fresh);
            return Ok(());
        }

        let lost = self.lost.take();
        if let Some(fold) =
            self.folds.last_mut().filter(|fold| Some(fold.upwards) == lost && fold.after.is_none())
        {
            fold.after = Some((target, fresh.outputs().clone()));
        }
        (self.manipulator, self.here) = (fresh, Some(target));
        self.margins.clear();
        Ok(())
    }

    fn lose(&mut self, failed: M, upwards: bool) {
        (self.failed, self.lost) = (Some(failed), Some(upwards));
        self.margins.clear();
    }

    /// The manipulator after a solve from its present shape within `seconds`.
    fn trial(&self, value: f64, seconds: f64) -> Result<M, Error> {
        let mut trial = self.manipulator.clone();
        trial.set_time_budget(seconds);
        trial.solve(&(self.inputs)(value)?)?;
        Ok(trial)
    }

    /// Locates the fold by bisection between `here`, on the branch, and `next`, where the solve `beyond` left it.
    ///
    /// Moves to the shape beyond and returns its path parameter, or that of the last shape on the branch if none was found.
    fn pass_fold(&mut self, here: f64, next: f64, beyond: M, clock: &Deadline) -> Result<f64, Error> {
        let (mut on, mut off) = (here, next);
        let (mut after, mut nearest) = (found(off, &beyond), beyond);
        while (off - on).abs() > FOLD_WIDTH * self.span && !self.is_late(clock, KEPT.1) {
            let middle = 0.5 * (on + off);
            let trial = self.trial(middle, clock.left() - self.kept(KEPT.1))?;
            if on_branch(&trial) {
                (self.manipulator, on) = (trial, middle);
            } else if self.is_late(clock, KEPT.1) {
                break;
            } else {
                // A snap may fail to settle very close to the fold although it succeeds from farther on; that result is kept.
                after = found(middle, &trial).or(after);
                (nearest, off) = (trial, middle);
            }
        }
        if !self.is_late(clock, KEPT.1) {
            nearest = self.trial(off, clock.left())?;
            if on_branch(&nearest) {
                self.manipulator = nearest;
                return Ok(off); // reached with a smaller step: not a fold
            }
            after = found(off, &nearest).or(after);
        }
        let before = self.manipulator.measure_margin().clone();
        let (value, width, outcome) = (0.5 * (on + off), (off - on).abs(), nearest.outputs().outcome);
        let located = width <= FOLD_WIDTH * self.span;
        if !located {
            self.leave_out(&format!(
                "the branch is lost between {on} and {off}, where exactly was not searched"
            ));
        }
        self.margins.clear();

        let upwards = next > here;
        let shape = after.as_ref().map(|(value, manipulator)| (*value, manipulator.outputs().clone()));
        self.folds.push(Fold { value, width, located, upwards, before, after: shape, outcome });
        let Some((reached, manipulator)) = after else {
            self.lose(nearest, upwards);
            return Ok(on);
        };
        self.manipulator = manipulator;
        Ok(reached)
    }

    /// The part of the time budget that is to be kept, s.
    fn kept(&self, part: f64) -> f64 {
        if self.time_budget.is_finite() { part * self.time_budget } else { 0.0 }
    }

    /// Whether no more than that part of the time budget is left.
    fn is_late(&self, clock: &Deadline, part: f64) -> bool {
        clock.left() <= self.kept(part)
    }

    fn leave_out(&mut self, what: &str) {
        let said = self.left_out.take().map_or_else(String::new, |said| format!("{said}; "));
        self.left_out = Some(format!("{said}{what} (model.time_budget_s)"));
    }

    fn remember(&mut self, value: f64) {
        let margin = self.manipulator.measure_margin().stability_margin;
        if self.margins.len() == REMEMBERED {
            self.margins.remove(0);
        }
        self.margins.push((value, margin));
    }
}

fn is_out_of_budget(trial: &impl Followed) -> bool {
    matches!(trial.outputs().outcome, Outcome::OutOfBudget(_))
}

fn on_branch(trial: &impl Followed) -> bool {
    matches!(trial.outputs().status, Status::Solved | Status::NearFold)
}

fn found<M: Followed>(value: f64, trial: &M) -> Option<(f64, M)> {
    (trial.outputs().status != Status::NotSolved).then(|| (value, trial.clone()))
}

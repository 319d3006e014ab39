//! Following a branch along a path of inputs, and locating the folds where it is left.

use serde::{Deserialize, Serialize};

use super::prediction::predicted;
use super::solve::Solve;
use super::{Inputs, Outcome, Outputs, Snapshot, Status};
use crate::error::{Error, check};

/// Width of the interval in which a fold is located, relative to the span of the path.
const FOLD_WIDTH: f64 = 1e-5;

/// Number of solved shapes used to predict a fold.
const REMEMBERED: usize = 3;

/// A fold, where the followed branch was left.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Fold {
    /// Path parameter at the fold: the middle of an interval of 1e-5 of the path's span.
    pub value: f64,
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
/// // The rings' and the helix' attraction pulls one segment shut at 35.86 mT.
/// let scene = Scene::parse("[design]\nsegments = 1\n[model]\ninteraction = \"full\"", "doc")?;
/// let field = |b: f64| Ok(Inputs { uniform_field: [0.0, b, 0.0].into(), ..Inputs::unloaded(2) });
/// let mut branch = Branch::new(scene.manipulator(2)?, field, 0.04, 0.001)?;
/// branch.to(0.0)?;
/// branch.to(0.04)?;
/// assert_eq!(branch.folds().len(), 1);
/// assert!((branch.folds()[0].value - 35.86e-3).abs() < 1e-4);
/// # Ok::<(), mcm::error::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Branch<F> {
    manipulator: Box<dyn Solve>,
    inputs: F,
    span: f64,
    longest_step: f64,
    /// Path parameter at which the manipulator's present shape is in equilibrium.
    here: Option<f64>,
    /// Whether the branch ended on the last path.
    lost: bool,
    folds: Vec<Fold>,
    /// Path parameter and stability margin at the last solved targets of [`Branch::to`] on this branch.
    margins: Vec<(f64, f64)>,
}

/// Serializable state of a branch that is being followed, from which another one goes on with bit-identical results.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PathSnapshot {
    manipulator: Snapshot,
    here: Option<f64>,
    lost: bool,
    folds: Vec<Fold>,
    margins: Vec<(f64, f64)>,
}

impl<F: Fn(f64) -> Result<Inputs, Error>> Branch<F> {
    /// Creates the unsolved branch of `manipulator`; `inputs` gives the inputs at each path parameter.
    ///
    /// `span` is the range of the path parameter. No step between two solves is longer than `longest_step`: within a step the
    /// inputs change linearly, and a rotated field changes along the chord.
    ///
    /// # Errors
    /// [`Error::Range`] for a span or a step that is not positive.
    pub fn new(
        manipulator: impl Into<Box<dyn Solve>>,
        inputs: F,
        span: f64,
        longest_step: f64,
    ) -> Result<Self, Error> {
        check("span of the path", span, |v| v > 0.0, "> 0")?;
        check("longest step on the path", longest_step, |v| v > 0.0, "> 0")?;
        let (folds, margins) = (Vec::new(), Vec::new());
        let manipulator = manipulator.into();
        Ok(Self { manipulator, inputs, span, longest_step, here: None, lost: false, folds, margins })
    }

    /// Follows the branch to `target` and locates the folds on the way; the first call starts from the unloaded shape.
    ///
    /// Where the branch ends, the outputs remain those of its last shape, with [`Status::NotSolved`]. Each later call in the
    /// same direction tries once to find a shape; a call in the opposite direction continues from the last shape.
    ///
    /// # Errors
    /// Those of the inputs and of [`Solve::solve`].
    pub fn to(&mut self, target: f64) -> Result<&Outputs, Error> {
        let Some(mut here) = self.here else {
            if self.manipulator.solve(&(self.inputs)(target)?)?.status != Status::NotSolved {
                self.here = Some(target);
                self.remember(target);
            }
            return Ok(self.manipulator.outputs());
        };
        let upwards = target > here;
        if self.lost && self.folds.last().is_some_and(|fold| fold.upwards == upwards) {
            self.search(target)?;
            return Ok(self.manipulator.outputs());
        }
        self.lost = false;
        let longest = self.longest_step;
        while !self.lost && here.total_cmp(&target).is_ne() {
            let step = (target - here).clamp(-longest, longest);
            let next = if (target - here).abs() <= longest { target } else { here + step };
            let trial = self.trial(next)?;
            if on_branch(trial.as_ref()) {
                (self.manipulator, here) = (trial, next);
            } else {
                here = self.pass_fold(here, next, trial.as_ref())?;
            }
        }
        self.here = Some(here);
        if !self.lost {
            self.remember(target);
        }
        Ok(self.manipulator.outputs())
    }

    /// The outputs at the last target.
    #[must_use]
    pub fn outputs(&self) -> &Outputs {
        self.manipulator.outputs()
    }

    /// The folds met so far, in order.
    #[must_use]
    pub fn folds(&self) -> &[Fold] {
        &self.folds
    }

    /// Predicted path parameter of the next fold, extrapolated from the last three targets (two if there are no more).
    ///
    /// The stability margin goes to zero as a power of the distance: 1/2 before a fold, 1 where a symmetric shape loses its
    /// stability without one, in between where it is nearly symmetric. `None` where the margin grows or is above 0.5.
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

    fn trial(&self, value: f64) -> Result<Box<dyn Solve>, Error> {
        let mut trial = self.manipulator.clone();
        trial.solve(&(self.inputs)(value)?)?;
        Ok(trial)
    }

    /// Locates the fold by bisection between `here`, on the branch, and `next`, where the solve `beyond` left it.
    ///
    /// Moves to the shape beyond and returns its path parameter, or that of the last shape on the branch if none was found.
    fn pass_fold(&mut self, here: f64, next: f64, beyond: &dyn Solve) -> Result<f64, Error> {
        let (mut on, mut off) = (here, next);
        let mut after = found(off, beyond);
        while (off - on).abs() > FOLD_WIDTH * self.span {
            let middle = 0.5 * (on + off);
            let trial = self.trial(middle)?;
            if on_branch(trial.as_ref()) {
                (self.manipulator, on) = (trial, middle);
            } else {
                // A snap may fail to settle very close to the fold although it succeeds from farther on; that result is kept.
                after = found(middle, trial.as_ref()).or(after);
                off = middle;
            }
        }
        let before = self.manipulator.measure_margin().clone();
        let nearest = self.trial(off)?;
        if on_branch(nearest.as_ref()) {
            self.manipulator = nearest;
            return Ok(off); // reached with a smaller step: not a fold
        }
        self.margins.clear();
        let (after, outcome) = (found(off, nearest.as_ref()).or(after), nearest.outputs().outcome);
        self.lost = after.is_none();
        let (reached, manipulator) = after.clone().unwrap_or((on, nearest));
        self.manipulator = manipulator;
        let after = after.map(|(value, manipulator)| (value, manipulator.outputs().clone()));
        self.folds.push(Fold { value: 0.5 * (on + off), upwards: next > here, before, after, outcome });
        Ok(reached)
    }

    /// Tries to find a stable shape at `target`, beyond the end of the branch.
    fn search(&mut self, target: f64) -> Result<(), Error> {
        let trial = self.trial(target)?;
        if trial.outputs().status != Status::NotSolved {
            self.lost = false;
            self.here = Some(target);
            if let Some(fold) = self.folds.last_mut() {
                fold.after = Some((target, trial.outputs().clone()));
            }
        }
        self.manipulator = trial;
        if !self.lost {
            self.remember(target);
        }
        Ok(())
    }

    fn remember(&mut self, value: f64) {
        let margin = self.manipulator.measure_margin().stability_margin;
        if self.margins.len() == REMEMBERED {
            self.margins.remove(0);
        }
        self.margins.push((value, margin));
    }
}

fn on_branch(trial: &dyn Solve) -> bool {
    matches!(trial.outputs().status, Status::Solved | Status::NearFold)
}

fn found(value: f64, trial: &dyn Solve) -> Option<(f64, Box<dyn Solve>)> {
    (trial.outputs().status != Status::NotSolved).then(|| (value, trial.duplicate()))
}

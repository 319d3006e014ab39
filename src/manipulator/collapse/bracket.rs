//! Continuation of the unloaded device along one number of the design, from where it stands to where it is lost.

use super::{Scene, UPRIGHT, largest_turn};
use crate::equilibrium::{Deadline, Equilibrium, Interaction, Settings, Solution};
use crate::error::Error;
use crate::manipulator::models_of_auto;

/// Iterations of one warm solve: where the device stands, it takes 3 to 10, and 21 after the longest step of the 90 designs tried. Where it
/// is lost, the descent to another shape is of no interest.
const ITERATIONS: u32 = 24;

/// Part of the way to the predicted fold of one step.
const TOWARDS_FOLD: f64 = 0.9;

/// Steps from the predicted fold at which the continuation ends.
const AT_FOLD: f64 = 2.0;

/// Relative rounding of the width of a bracket.
const ROUNDING: f64 = 1e-6;

/// Continuation from a value with which the device stands towards one with which it does not.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bracket<'a> {
    pub(super) deadline: &'a Deadline,
    /// Processor time (s) that is left over.
    pub(super) keep: f64,
    /// Width at which the continuation ends, in the unit of the number.
    pub(super) step: f64,
}

impl Bracket<'_> {
    /// The value nearest to `lost` with which the device is found to stand, in the unit of the number, and whether its branch was found to
    /// end beyond; `None` where it does not even stand with `standing`.
    ///
    /// `at` gives the unloaded scene with a value. Each solve starts from the last shape of the standing side, at the fold that is predicted
    /// or in the middle. The model is a coarse one, so that the result is to be confirmed.
    ///
    /// # Errors
    /// Those of `at`; as [`Equilibrium::new`] and [`Equilibrium::solve`].
    pub(super) fn narrow(
        &self,
        [standing, mut lost]: [f64; 2],
        at: impl Fn(f64) -> Result<Scene, Error>,
    ) -> Result<Option<(f64, bool)>, Error> {
        let Some(mut last) = self.solve(standing, &at(standing)?, None)? else { return Ok(None) };
        let (mut fold, mut ends) = (None, false);
        let is_near =
            |value: f64, end: f64, steps: f64| (value - end).abs() <= steps * self.step * (1.0 + ROUNDING);

        while !is_near(last.value, lost, 1.0) && self.deadline.left() > self.keep {
            // A solve beyond the fold takes longer than all before it.
            if fold.is_some_and(|fold| is_near(last.value, fold, AT_FOLD)) {
                ends = true;
                break;
            }
            let next = self.next(last.value, lost, fold.take());
            if let Some(found) = self.solve(next, &at(next)?, Some(&last))? {
                fold = found.fold_after(&last);
                last = found;
            } else {
                (lost, ends) = (next, true);
            }
        }
        Ok(Some((last.value, ends)))
    }

    /// The next value between two: a little before the predicted fold, where there is one between them.
    fn next(&self, standing: f64, lost: f64, fold: Option<f64>) -> f64 {
        let way = lost - standing;
        let part = fold.map_or(0.5, |fold| TOWARDS_FOLD * (fold - standing) / way);
        let least = self.step / way.abs();
        let part = if part < 1.0 { part.max(least) } else { 0.5 };
        standing + part * way
    }

    /// The device at rest with a value, from the shape of `last` or the straight one; `None` where it is not found to stand.
    fn solve(&self, value: f64, scene: &Scene, last: Option<&Standing>) -> Result<Option<Standing>, Error> {
        let settings = coarse(&scene.settings);
        let mut model = Equilibrium::new(&scene.design()?, &scene.sources, settings, 2)?;
        if let Some(Standing { model: last, .. }) = last {
            model.adopt(last, last.unknowns(), &scene.inputs);
        }

        let report = model.solve_before(self.deadline, &scene.inputs)?;
        let bodies = model.rings().chain([model.tip()]);
        let upright = largest_turn(&scene.inputs.base, bodies) <= UPRIGHT;
        let stands = report.solved() && report.stable != Some(false) && upright;
        Ok(stands.then_some(Standing { value, margin: report.margin, model }))
    }
}

/// A device that stands with a value, and its stability margin.
#[derive(Debug)]
struct Standing {
    value: f64,
    margin: f64,
    model: Equilibrium,
}

impl Standing {
    /// The value at which the branch ends, where the margin falls from `before` to here: at a fold it is a square root of the distance.
    fn fold_after(&self, before: &Self) -> Option<f64> {
        let [near, far] = [self, before].map(|at| at.margin * at.margin);
        (near < far).then(|| self.value + near * (self.value - before.value) / (far - near))
    }
}

/// Settings of the cheapest model that has all attraction of the level.
fn coarse(settings: &Settings) -> Settings {
    let model = if settings.interaction == Interaction::Auto {
        let models = models_of_auto(settings, true);
        let all = |model: &&Settings| model.interaction == Interaction::Full;
        models.iter().find(all).copied().unwrap_or(Settings { interaction: Interaction::Full, ..*settings })
    } else {
        *settings
    };
    Settings { iterations: model.iterations.min(ITERATIONS), ..model }
}

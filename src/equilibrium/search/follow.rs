//! Following a branch of equilibria along stages of inputs, past its folds.

use super::corrector::{Corrector, Finding, Verdict};
use super::descent::Descended;
use super::evaluator::{Aim, ROUNDING};
use super::friction_corrector::Means;
use super::outcome::Outcome;
use super::path::{FirstStep, Stage, Step, StepLength};
use super::stability::Stability;
use crate::equilibrium::model::Inputs;
use crate::numerics::trust_region::Objective;

/// Length (radian norm) of the first step from the unloaded shape, as its factorisation predicts it, up to which that step
/// is tried: Newton's method finds no shape much farther away.
const STRAIGHT: f64 = 2.0;

/// Inverse of the fraction of iterations that is reserved for a final descent.
const RESERVE: u32 = 3;

/// A search for the equilibrium at given inputs.
pub(super) struct Search<'a> {
    pub(super) corrector: Corrector<'a>,
    pub(super) stability: Stability<'a>,
    /// Fraction of the change of the inputs that is done.
    pub(super) progress: f64,
    /// Number of snaps to another branch so far.
    pub(super) snaps: u32,
    /// The last equilibrium on the way to the target.
    pub(super) reached: Option<(Inputs, Vec<f64>)>,
}

/// Where the way along a stage has come to.
struct Way {
    /// The part of the stage that is done, and the inputs there.
    done: f64,
    here: Inputs,
    /// Whether the last shape is neutral: the next ones are then found by descents.
    neutral: bool,
    /// Number of snaps when the last descent began: a descent over several steps counts as one snap.
    before_descent: Option<u32>,
}

impl Search<'_> {
    /// Follows the branch from the equilibrium `unknowns` along stages, each of which begins where the one before ends.
    pub(super) fn follow(&mut self, stages: &[Stage], unknowns: &mut [f64]) -> Finding {
        let mut end = Err(Outcome::BranchEnds);
        for stage in stages {
            end = self.follow_stage(stage, unknowns);
            if end.is_err_and(|outcome| !outcome.is_solved()) {
                break;
            }
        }
        end
    }

    /// Follows the branch along one stage: predict and correct; where no shape is found, halve the step; where the branch ends,
    /// descend to the next one.
    fn follow_stage(&mut self, stage: &Stage, unknowns: &mut [f64]) -> Finding {
        let mut length = self.first_length(stage, unknowns);
        let mut way = Way { done: 0.0, here: stage.from.clone(), neutral: false, before_descent: None };

        while self.steps_are_left() {
            self.progress = stage.progress_at(way.done);
            let next = length.end(way.done);
            let (inputs, aim) = (stage.at(next), if next < 1.0 { Aim::Pass } else { Aim::Rest });
            let step = Step::between([&way.here, &inputs], aim);

            let mut found = Err(Outcome::Neutral);
            if !way.neutral {
                let nearby =
                    self.corrector.evaluator.contact.is_some().then(|| stage.nearby([way.done, next]));
                found = self.correct_along(&step, nearby.as_ref(), unknowns);
                if found.is_err() && length.halve() {
                    continue;
                }
            }
            if found.is_ok() {
                length.grow();
                way.before_descent = None;
            } else {
                found = self.descend_along(&step, &mut way.before_descent, unknowns);
                length.grow_past_descent();
            }

            way.neutral = found == Err(Outcome::Neutral) && aim == Aim::Pass;
            if aim == Aim::Rest || found.is_err() && !way.neutral {
                return found.map_err(|end| self.rests(end));
            }
            (way.done, way.here) = (next, inputs);
            if !way.neutral {
                self.note(&way.here, unknowns);
            }
        }
        // Too many small steps along the branch: descend to the target at once.
        let step = Step::between([&way.here, &stage.to], Aim::Rest);
        let found = self.descend_along(&step, &mut None, unknowns);
        found.map_err(|end| self.rests(end))
    }

    /// Corrects the shape at the end of a step: where there is contact, from where the tangent leads, by `nearby` inputs, then from
    /// where the step begins.
    fn correct_along(&mut self, step: &Step<'_>, nearby: Option<&Inputs>, unknowns: &mut [f64]) -> Finding {
        self.corrector.under_friction(step, unknowns, Means::Correction, |corrector, unknowns| {
            nearby
                .and_then(|nearby| corrector.try_to_correct_along(step, nearby, unknowns))
                .or_else(|| corrector.try_to_correct(step, unknowns))
                .ok_or(Outcome::BranchEnds)
        })
    }

    /// Descends to a stable shape at the end of a step, and counts a snap where the branch has been left; `before` is the number of
    /// snaps when a descent over several steps began, which counts as one.
    fn descend_along(&mut self, step: &Step<'_>, before: &mut Option<u32>, unknowns: &mut [f64]) -> Finding {
        let before = *before.get_or_insert(self.snaps);
        let snaps = &mut self.snaps;
        self.corrector.under_friction(step, unknowns, Means::Descent, |corrector, unknowns| {
            let Descended { outcome, snapped } = corrector.descend_along(step, unknowns);
            *snaps = (*snaps + u32::from(snapped)).min(before + 1);
            if outcome == Outcome::Solved { Ok(Verdict::Fresh) } else { Err(outcome) }
        })
    }

    /// Whether another step may be taken, and a descent from its end.
    fn steps_are_left(&self) -> bool {
        let evaluator = &self.corrector.evaluator;
        evaluator.left() > evaluator.model.settings.iterations / RESERVE && evaluator.may_go_on()
    }

    /// Keeps an equilibrium on the way, at which a solve may rest whose budget ends.
    fn note(&mut self, inputs: &Inputs, unknowns: &[f64]) {
        self.reached = Some((inputs.clone(), unknowns.to_vec()));
        if let Some(contact) = &mut self.corrector.evaluator.contact {
            contact.friction.note();
        }
    }

    /// The length of the step that is tried first from the equilibrium `unknowns` at the start of a stage. Where it is to be predicted,
    /// it is halved until the step that the last factorisation predicts is short enough to be worth a Hessian.
    fn first_length(&mut self, stage: &Stage, unknowns: &[f64]) -> StepLength {
        let evaluator = &mut self.corrector.evaluator;
        let smallest = evaluator.model.settings.smallest_part;
        let mut part = match stage.first {
            FirstStep::Part(part) => return StepLength::new(part, smallest),
            FirstStep::Predicted => 1.0,
        };

        let factorised = evaluator.work.factorisation.is_some();
        if factorised && evaluator.potential(&stage.to).slope(unknowns).is_some() {
            let length = self.corrector.step(&stage.to, 0);
            while part * length > STRAIGHT && part > smallest {
                part *= 0.5;
            }
        }
        StepLength::new(part, smallest)
    }

    /// Accepts a neutral shape at the target only if it is in equilibrium.
    fn rests(&self, end: Outcome) -> Outcome {
        let unbalanced = self.corrector.evaluator.balance.residual > ROUNDING;
        if end == Outcome::Neutral && unbalanced { Outcome::BranchEnds } else { end }
    }
}

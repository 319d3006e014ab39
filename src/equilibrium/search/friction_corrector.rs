//! Friction round another way to find a shape: normal forces follow the shape in passes, then stick points follow what slides.

use super::corrector::{Corrector, Finding, Verdict};
use super::evaluator::{Aim, Evaluator};
use super::outcome::Outcome;
use super::path::Step;
use crate::equilibrium::contact::{KeptShape, Stage};
use crate::equilibrium::model::Inputs;
use crate::numerics::trust_region::Objective;

/// Most passes.
const PASSES: usize = 40;

/// How a shape under friction may be found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Means {
    /// By correction, on the branch.
    Correction,
    /// By descent too, as a shape may that was found by one.
    Descent,
}

impl Corrector<'_> {
    /// Finds the next shape by `find` and lets friction follow it, until neither changes.
    ///
    /// Where they do not settle, the step has failed as [`Outcome::Wedged`], and `unknowns` are where it began.
    pub(super) fn under_friction(
        &mut self,
        step: &Step<'_>,
        unknowns: &mut [f64],
        means: Means,
        find: impl FnOnce(&mut Self, &mut [f64]) -> Finding,
    ) -> Finding {
        let held = self.evaluator.contact.as_deref().is_some_and(|contact| contact.friction.holds());
        let start = held.then(|| unknowns.to_vec());
        let found = find(self, unknowns)?;
        let Some(start) = start else { return Ok(found) };
        self.settle_friction((step, means), &start, unknowns, found)
    }

    /// Lets normal forces and their directions follow a shape just found from the shape `start`, until friction changes no more, and
    /// maps the stick points to it.
    fn settle_friction(
        &mut self,
        (step, means): (&Step<'_>, Means),
        start: &[f64],
        unknowns: &mut [f64],
        mut found: Verdict,
    ) -> Finding {
        let evaluator = &mut self.evaluator;
        let Some(friction) = evaluator.contact.as_deref().map(|contact| &contact.friction) else {
            return Ok(found);
        };
        if friction.is_idle() {
            return Ok(found);
        }
        let memory = friction.memory.clone();
        evaluator.work.place(evaluator.model.chain, step.before, start);
        let from = KeptShape::of(evaluator.work);

        for _ in 0..PASSES {
            match self.lag_friction(step.inputs, unknowns, &from) {
                Some(true) => return Ok(found),
                Some(false) => {}
                None => break,
            }
            match self.find_again((step, means), unknowns) {
                Some(verdict) => found = verdict,
                None => break,
            }
        }

        if let Some(contact) = &mut self.evaluator.contact {
            contact.friction.memory = memory;
        }
        unknowns.copy_from_slice(start);
        Err(Outcome::Wedged)
    }

    /// Takes the normal forces of a shape for those under friction; returns whether they were those already, up to what counts as
    /// settled, and `None` where nothing is left to go on or bodies touch.
    fn lag_friction(&mut self, inputs: &Inputs, unknowns: &[f64], from: &KeptShape) -> Option<bool> {
        let evaluator = &mut self.evaluator;
        if !evaluator.may_go_on() {
            return None;
        }
        evaluator.potential(inputs).slope(unknowns)?;

        let Evaluator { work, model, contact, .. } = evaluator;
        let contact = contact.as_deref_mut()?;
        let next = contact.lagged(model.chain, work, from);
        let settled = contact.change(model.chain, work, &next) <= 1.0;
        contact.friction.memory.contacts = next;
        if settled {
            contact.return_map(model.chain, work);
        }
        Some(settled)
    }

    /// Finds the shape anew under the friction that has changed.
    fn find_again(&mut self, (step, means): (&Step<'_>, Means), unknowns: &mut [f64]) -> Option<Verdict> {
        let aim = if means == Means::Correction { step.aim } else { Aim::Rest };
        let mut trial = unknowns.to_vec();
        let reach = self.evaluator.model.settings.follow_step;
        let found = self.correct(step.inputs, &mut trial, reach, aim);
        if found.is_some() {
            unknowns.copy_from_slice(&trial);
        }
        if found.is_some() || means == Means::Correction {
            return found;
        }

        let resting = self.evaluator.resting(Aim::Rest);
        let end = self.descend(step.inputs, unknowns, resting);
        (end == Outcome::Solved).then_some(Verdict::Fresh)
    }

    /// Ends a solve at an equilibrium: the first one is held as it is.
    pub(super) fn end_friction(&mut self, inputs: &Inputs, unknowns: &[f64]) {
        let contact = self.evaluator.contact.as_deref();
        let Some(friction) = contact.map(|contact| &contact.friction).filter(|own| own.acts()) else {
            return;
        };
        let first = friction.memory.stage == Stage::Free;
        if first {
            self.evaluator.potential(inputs).slope(unknowns);
        }

        let Evaluator { work, model, contact, .. } = &mut self.evaluator;
        let Some(contact) = contact.as_deref_mut() else { return };
        if first {
            let here = KeptShape::of(work);
            contact.friction.memory.contacts = contact.lagged(model.chain, work, &here);
        }
        contact.friction.memory.stage = if first { Stage::Rested } else { Stage::Moved };
        if contact.friction.has_held() {
            // It belongs to an earlier state of the friction, which is not kept.
            work.factorisation = None;
        }
    }
}

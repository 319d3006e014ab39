//! Whether a corrected shape is on the branch of the last one.

use super::corrector::{Corrector, Verdict};
use super::path::{Step, TANGENT};
use crate::equilibrium::model::{Inputs, Potential};
use crate::numerics::trust_region::{Objective, norm};

/// Largest distance, relative to a step, by which the step back may miss its start. A branch that turns more within a
/// step is followed in shorter steps.
const MISSED: f64 = 0.5;

impl Corrector<'_> {
    /// Corrects a copy of `unknowns` and accepts it as [`Self::accept`] does.
    pub(super) fn try_to_correct(&mut self, step: &Step<'_>, unknowns: &mut [f64]) -> Option<Verdict> {
        let mut trial = std::mem::take(&mut self.buffers.trial);
        trial.copy_from_slice(unknowns);
        let reach = self.evaluator.model.settings.follow_step;
        let found = self.accept(step, unknowns, &mut trial, reach);
        self.buffers.trial = trial;
        found
    }

    /// Corrects `trial` by a first step of at most `reach`, and moves `unknowns` there if it is an equilibrium that the branch leads
    /// to.
    pub(super) fn accept(
        &mut self,
        step: &Step<'_>,
        unknowns: &mut [f64],
        trial: &mut [f64],
        reach: f64,
    ) -> Option<Verdict> {
        let verdict = self.correct(step.inputs, trial, reach, step.aim)?;
        let accepted = self.evaluator.is_still_free(step.inputs)
            && (verdict == Verdict::Kept || step.adopted || self.goes_on(step, [unknowns, trial]));
        if accepted {
            unknowns.copy_from_slice(trial);
        }
        accepted.then_some(verdict)
    }

    /// Corrects the shape to which the branch leads along its tangent: where there is contact, a step from the last shape
    /// itself would press the chain into the wall. `nearby` are inputs a small part of the step away.
    pub(super) fn try_to_correct_along(
        &mut self,
        step: &Step<'_>,
        nearby: &Inputs,
        unknowns: &mut [f64],
    ) -> Option<Verdict> {
        let mut trial = std::mem::take(&mut self.buffers.trial);
        let mut found = None;
        if self.lead_along([step.before, nearby], unknowns, &mut trial) {
            let predicted = trial.clone();
            found = self.correct_predicted(step, &predicted, unknowns, &mut trial);
        }
        if found.is_some() {
            unknowns.copy_from_slice(&trial);
        }
        self.buffers.trial = trial;
        found
    }

    /// Corrects a shape `predicted` from `last`, as `trial`.
    fn correct_predicted(
        &mut self,
        step: &Step<'_>,
        predicted: &[f64],
        last: &[f64],
        trial: &mut [f64],
    ) -> Option<Verdict> {
        let reach = self.evaluator.model.settings.follow_step;
        let verdict = self.correct(step.inputs, trial, reach, step.aim)?;
        if !self.evaluator.is_still_free(step.inputs) {
            return None;
        }
        // Found where the tangent leads; the way back would meet other contacts than the way there.
        let missed = self.evaluator.distance(trial, predicted);
        let expected = missed <= MISSED * self.evaluator.distance(predicted, last);
        let accepted = verdict == Verdict::Kept || expected || self.goes_on(step, [last, trial]);
        accepted.then_some(verdict)
    }

    /// Writes the shape at the end of the tangent to `trial`, by the last factorisation; `false` where there is none.
    fn lead_along(&mut self, [before, nearby]: [&Inputs; 2], unknowns: &[f64], trial: &mut [f64]) -> bool {
        let mut potential = self.evaluator.potential(before);
        if potential.linearise(unknowns).is_none() || !potential.factorise(0.0) {
            return false;
        }
        trial.copy_from_slice(&self.evaluator.work.gradient);
        let mut potential = self.evaluator.potential(nearby);
        if potential.slope(unknowns).is_none() {
            return false;
        }

        trial.iter_mut().zip(potential.gradient()).for_each(|(x, after)| *x = (*x - after) / TANGENT);
        potential.solve(trial);
        let length = norm(self.evaluator.model.metric, trial) / self.evaluator.unit();
        trial.iter_mut().zip(unknowns).for_each(|(x, here)| *x += here);
        length <= self.evaluator.model.settings.follow_step
    }

    /// Whether the branch leads from the first shape, at the first inputs, to the second one, just found at the second
    /// inputs.
    ///
    /// One Newton step at the first inputs must lead nearly back: with the Hessian of the second shape or, as loads may
    /// stiffen or soften it, with the one under the first inputs. From beyond a fold it does not: there the change of the
    /// inputs moves the shape by far less than the distance of the two.
    fn goes_on(&mut self, step: &Step<'_>, [last, now]: [&[f64]; 2]) -> bool {
        let evaluator = &mut self.evaluator;
        let distance = evaluator.distance(now, last);
        // At such a short distance the last factorisation would have been valid for both.
        if distance <= self.drift * evaluator.unit() {
            return true;
        }
        let (metric, between) = (evaluator.model.metric, &mut self.buffers.between);
        let mut leads_back = |potential: &mut Potential<'_>| {
            between.iter_mut().zip(now.iter().zip(last)).for_each(|(b, (n, l))| *b = n - l);
            potential.add_newton_step(between);
            norm(metric, between) <= MISSED * distance
        };

        let balance = evaluator.balance;
        let mut potential = evaluator.potential(step.before);
        let mut returned = potential.slope(now).is_some() && leads_back(&mut potential);
        if !returned {
            let kept = evaluator.work.factorisation.take();
            let mut potential = evaluator.potential(step.before);
            let regular = potential.linearise(now).is_some() && potential.factorise(0.0);
            returned = regular && leads_back(&mut potential);
            evaluator.work.factorisation = kept;
        }
        // The workspace must hold the solved shape at its own inputs, from which results are read.
        let again = evaluator.potential(step.inputs).slope(now).is_some();
        evaluator.balance = balance;
        returned && again
    }
}

//! Following a stable branch while the inputs change: predict the next shape and correct it; else go on in shorter steps; else
//! descend to the next branch; then judge.

use super::correction::{End, GLANCE, KEPT, NEARLY, ROUNDING, Report, Walk};
use super::descent::PASSING;
use super::follow::Branch;
use super::inputs::Inputs;
use super::outcome::Outcome;
use super::potential::THOROUGH;
use crate::numerics::trust_region::norm;

/// Largest first step from the straight shape to the one that the internal forces alone leave: there is no
/// branch to lose yet.
const SETTLING: f64 = 4.0;

/// Part of a predicted step by which it may have to be corrected.
const MISTAKEN: f64 = 0.1;

/// Part of the iterations, as one over this number, that is kept for a descent at the end of the way.
const RESERVE: u32 = 3;

/// How much longer a step is after one that had to be descended.
const FURTHER: f64 = 4.0;

/// Part of a step by which the way back may miss its start: a branch that turns more within a step is followed in shorter ones.
const MISSED: f64 = 0.5;

impl Walk<'_> {
    /// Moves `branch` to the equilibrium at `target`; on failure the branch stays where it was.
    pub(super) fn follow(&mut self, branch: &mut Branch, target: &Inputs) -> Report {
        self.reached = None;
        self.reach = KEPT * if branch.stable.is_some() { branch.margin } else { 1.0 };
        self.scratch.last.copy_from_slice(&branch.unknowns);
        let taken_up = branch.stable.is_none();
        let predicted = self.predicted(branch, target);
        let end = predicted
            .or_else(|| self.settle(branch, target))
            .unwrap_or_else(|| self.run(branch.inputs.as_ref(), target, &mut branch.unknowns));
        match end {
            End::Kept => {
                (self.report.margin, self.report.stable) = (branch.margin, branch.stable);
                let free = self.report.stable == Some(false);
                self.report.outcome = if free { Outcome::Neutral } else { Outcome::Solved };
            }
            End::Held => {
                // Without a softest direction of a shape before, a glance may miss one that is softer.
                let search = if branch.stable.is_some() { GLANCE } else { THOROUGH };
                self.judge(target, &branch.unknowns, &mut branch.softest, search);
            }
            End::Neutral => {
                // Factorisation and loads are those of a shape on the way, or on the way back.
                self.potential(target).chord_slope(&branch.unknowns);
                self.work.factorisation = None;
                (self.report.stable, self.report.outcome) = (Some(false), Outcome::Neutral);
            }
            End::Lost => {
                // The last shape that was tried may say why.
                let contact = self.scene.contact(target, self.work).map(Outcome::Contact);
                let otherwise = if self.may_go_on() { Outcome::BranchEnds } else { Outcome::OutOfBudget };
                return self.give_up(branch, contact.unwrap_or(otherwise));
            }
        }
        self.work.place(self.scene.chain, &target.base, &branch.unknowns);
        if let Some(contact) = self.scene.contact(target, self.work) {
            return self.give_up(branch, Outcome::Contact(contact));
        }
        self.report.progress = 1.0;
        (branch.margin, branch.stable) = (self.report.margin, self.report.stable);
        // Neither from beyond a snap nor from another model's shape does a line lead on.
        branch.advance(target, &self.scratch.last, self.report.snaps > 0 || taken_up);
        self.report
    }

    /// Leaves `branch` where it was or, where only the budget ended the way, at the last shape on it: asked again, it goes on.
    fn give_up(&mut self, branch: &mut Branch, outcome: Outcome) -> Report {
        self.work.factorisation = None;
        match self.reached.take().filter(|_| outcome == Outcome::OutOfBudget) {
            Some((inputs, unknowns)) => branch.rest_at(inputs, unknowns),
            None => branch.unknowns.copy_from_slice(&self.scratch.last),
        }
        (self.report.outcome, self.report.stable, self.report.margin) = (outcome, None, 0.0);
        self.report
    }

    /// Corrects the shape that the last steps lead to expect, if they do and it is nearly right.
    fn predicted(&mut self, branch: &mut Branch, target: &Inputs) -> Option<End> {
        let mut trial = std::mem::take(&mut self.scratch.trial);
        let expected = branch.predict(target, &self.scene, &mut trial);
        let mut end =
            expected.and_then(|length| self.correct(target, &mut trial, (MISTAKEN * length).max(NEARLY)));
        if let (Some(End::Held), Some(before)) = (end, &branch.inputs)
            && !self.goes_on([before, target], [&branch.unknowns, &trial])
        {
            end = None;
        }
        if end.is_some() {
            branch.unknowns.copy_from_slice(&trial);
        }
        self.scratch.trial = trial;
        end
    }

    /// Corrects a shape taken up from another model, which is not yet an equilibrium of this one: that is no step of the
    /// inputs. The end, if they are those of the target.
    fn settle(&mut self, branch: &mut Branch, target: &Inputs) -> Option<End> {
        let here = branch.inputs.as_ref().filter(|_| branch.stable.is_none())?;
        let end = self.try_to_correct(None, here, &mut branch.unknowns);
        end.filter(|_| here == target)
    }

    /// Follows the branch from the inputs of `unknowns` (`None`: straight, nothing is solved yet) to `target`.
    fn run(&mut self, from: Option<&Inputs>, target: &Inputs, unknowns: &mut [f64]) -> End {
        if let Some(start) = from {
            return self.advance([start, target], [0.0, 1.0], unknowns);
        }
        // The unloaded shape: its internal forces alone, found from straight.
        let unloaded = target.without_loads();
        if self.correct(&unloaded, unknowns, SETTLING).is_none()
            && self.descend(&unloaded, unknowns, self.resting()) != End::Held
        {
            return End::Lost;
        }
        let held = target.without_moment();
        if held == *target {
            return self.advance([&unloaded, target], [0.0, 1.0], unknowns);
        }
        // A load without a potential does not choose the branch: it is added to the shape that all others leave.
        match self.advance([&unloaded, &held], [0.0, 0.5], unknowns) {
            End::Lost => End::Lost,
            End::Kept | End::Held | End::Neutral => self.advance([&held, target], [0.5, 1.0], unknowns),
        }
    }

    /// Follows the branch along the inputs between two; `stage` is where that lies in the whole solve.
    fn advance(&mut self, [start, target]: [&Inputs; 2], stage: [f64; 2], unknowns: &mut [f64]) -> End {
        let at = |part: f64| if part >= 1.0 { target.clone() } else { start.between(target, part) };
        let (smallest, resting) = (self.scene.settings.smallest_part, self.resting());
        let (mut done, mut part, mut floor) = (0.0, 1.0, smallest);
        let mut here = start.clone();
        let (mut neutral, mut shortened) = (false, false);
        // Snaps when the last descent began: what comes down in several steps has snapped once.
        let mut before_descent = None;
        while self.left() > self.scene.settings.iterations / RESERVE && self.may_go_on() {
            self.report.progress = stage[0] + done * (stage[1] - stage[0]);
            let next = f64::min(1.0, done + part);
            let inputs = at(next);
            let corrected = if neutral { None } else { self.try_to_correct(Some(&here), &inputs, unknowns) };
            if corrected.is_none() && !neutral && part > floor {
                (part, shortened) = (0.5 * part, true);
                continue;
            }
            let tolerance = if next < 1.0 { PASSING } else { resting };
            let end = if let Some(end) = corrected {
                before_descent = None;
                end
            } else {
                let before = *before_descent.get_or_insert(self.report.snaps);
                let end = self.descend_from([&here, &inputs], unknowns, tolerance);
                self.report.snaps = self.report.snaps.min(before + 1);
                end
            };
            // Where the branch has to be descended again and again, it is steep or nearly neutral: shorter steps are no help.
            floor = if corrected.is_some() { smallest } else { FURTHER * floor };
            neutral = end == End::Neutral && next < 1.0;
            match end {
                End::Kept | End::Held => {}
                End::Neutral if neutral => {}
                End::Neutral if self.report.residual <= ROUNDING => return End::Neutral,
                End::Neutral | End::Lost => return End::Lost,
            }
            // A length that was just too long is not tried again at once.
            part = floor.max(if shortened { part } else { 2.0 * part });
            (done, here, shortened) = (next, inputs, false);
            if done >= 1.0 {
                return end;
            }
            if end != End::Neutral {
                self.reached = Some((here.clone(), unknowns.to_vec()));
            }
        }
        // Too many small steps along the branch: downhill all the way.
        match self.descend_from([&here, target], unknowns, resting) {
            End::Neutral if self.report.residual > ROUNDING => End::Lost,
            end => end,
        }
    }

    /// Residual at which a descent to the target ends.
    fn resting(&self) -> f64 {
        self.scene.settings.tolerance.max(ROUNDING)
    }

    /// Iterations that this solve may still take.
    pub(super) fn left(&self) -> u32 {
        self.scene.settings.iterations.saturating_sub(self.report.iterations)
    }

    /// Whether iterations and time are left.
    pub(super) fn may_go_on(&self) -> bool {
        self.left() > 0 && !self.deadline.has_passed()
    }

    /// Corrects a copy of `unknowns` and takes it over if that ends at an equilibrium; on the same branch, if they are
    /// the equilibrium at the inputs `before`.
    fn try_to_correct(
        &mut self,
        before: Option<&Inputs>,
        inputs: &Inputs,
        unknowns: &mut [f64],
    ) -> Option<End> {
        let mut trial = std::mem::take(&mut self.scratch.trial);
        trial.copy_from_slice(unknowns);
        let mut end = self.correct(inputs, &mut trial, self.scene.settings.follow_step);
        if let (Some(End::Held), Some(before)) = (end, before)
            && !self.goes_on([before, inputs], [unknowns, &trial])
        {
            end = None;
        }
        if end.is_some() {
            unknowns.copy_from_slice(&trial);
        }
        self.scratch.trial = trial;
        end
    }

    /// Whether the branch leads from the first shape, at the first inputs, to the second one, just found at the others.
    ///
    /// One Newton step of the first inputs with the Hessian of the second shape must lead nearly back. From beyond a fold it
    /// does not: there the step of the inputs moves the shape by far less than the two are apart.
    fn goes_on(&mut self, [before, inputs]: [&Inputs; 2], [last, now]: [&[f64]; 2]) -> bool {
        let metric = &self.scene.chain.metric;
        let mut between = std::mem::take(&mut self.scratch.between);
        between.iter_mut().zip(now.iter().zip(last)).for_each(|(b, (n, l))| *b = n - l);
        let distance = norm(metric, &between);
        // So near, the last factorisation would have held for both.
        if distance <= self.reach * self.scene.chain.radian_norm() {
            self.scratch.between = between;
            return true;
        }
        let (residual, energy) = (self.report.residual, self.report.energy);
        let mut potential = self.potential(before);
        let returned = potential.chord_slope(now).is_some() && {
            potential.add_newton_step(&mut between);
            norm(metric, &between) <= MISSED * distance
        };
        self.scratch.between = between;
        // What is read from the solved shape must be that of its own inputs.
        let again = self.potential(inputs).chord_slope(now).is_some();
        (self.report.residual, self.report.energy) = (residual, energy);
        returned && again
    }
}

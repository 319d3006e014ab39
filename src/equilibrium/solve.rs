//! One solve: predict the next shape and correct it; else go on in shorter steps of the inputs; else descend to the next branch;
//! then judge.

use super::descend::PASSING;
use super::history::History;
use super::inputs::Inputs;
use super::outcome::Outcome;
use super::report::Report;
use super::search::{ROUNDING, Search};

/// How far loads and shape may drift from the last factorisation, relative to the margin, while it tells about stability.
const KEPT: f64 = 0.1;

/// Largest first step from the straight shape to the one that the internal forces alone leave: there is no
/// branch to lose yet.
const SETTLING: f64 = 4.0;

/// Part of the iterations, as one over this number, that is kept for a descent at the end of the way.
const RESERVE: u32 = 3;

/// How much longer a step is after one that had to be descended.
const FURTHER: f64 = 4.0;

impl Search<'_> {
    /// Moves `branch` to the equilibrium at `target`; on failure the branch stays where it was.
    pub(super) fn solve(&mut self, branch: &mut History, target: &Inputs) -> Report {
        self.reached = None;
        self.reach = KEPT * if branch.stable.is_some() { branch.margin } else { 1.0 };
        self.scratch.last.copy_from_slice(&branch.unknowns);
        let taken_up = branch.stable.is_none();
        let found = if self.predict(branch, target) || self.settle(branch, target) {
            Outcome::Solved
        } else {
            self.follow(branch.inputs.as_ref(), target, &mut branch.unknowns)
        };
        let outcome = self.judge(found, branch, target);
        if !outcome.is_solved() {
            return self.give_up(branch, outcome);
        }
        (self.report.outcome, self.report.progress) = (outcome, 1.0);
        (branch.margin, branch.stable) = (self.report.margin, self.report.stable);
        // Neither from beyond a snap nor from another model's shape does a line lead on.
        branch.advance(target, &self.scratch.last, self.report.snaps > 0 || taken_up);
        self.report
    }

    /// Leaves `branch` where it was or, where only the budget ended the way, at the last shape on it: asked again, it goes on.
    fn give_up(&mut self, branch: &mut History, outcome: Outcome) -> Report {
        self.work.factorisation = None;
        match self.reached.take().filter(|_| outcome == Outcome::OutOfBudget) {
            Some((inputs, unknowns)) => branch.rest_at(inputs, unknowns),
            None => branch.unknowns.copy_from_slice(&self.scratch.last),
        }
        (self.report.outcome, self.report.stable, self.report.margin) = (outcome, None, 0.0);
        self.report
    }

    /// Corrects a shape taken up from another model, which is not yet an equilibrium of this one: that is no step of the
    /// inputs. Whether it is at those of the target then.
    fn settle(&mut self, branch: &mut History, target: &Inputs) -> bool {
        let Some(here) = branch.inputs.as_ref().filter(|_| branch.stable.is_none()) else { return false };
        self.try_to_correct(None, here, &mut branch.unknowns) && here == target
    }

    /// Follows the branch from the inputs of `unknowns` (`None`: straight, nothing is solved yet) to `target`.
    fn follow(&mut self, from: Option<&Inputs>, target: &Inputs, unknowns: &mut [f64]) -> Outcome {
        if let Some(start) = from {
            return self.advance([start, target], [0.0, 1.0], unknowns);
        }
        // The unloaded shape: its internal forces alone, found from straight.
        let unloaded = target.without_loads();
        if !self.correct(&unloaded, unknowns, SETTLING)
            && self.descend(&unloaded, unknowns, self.resting()) != Outcome::Solved
        {
            return Outcome::BranchEnds;
        }
        let held = target.without_moment();
        if held == *target {
            return self.advance([&unloaded, target], [0.0, 1.0], unknowns);
        }
        // A load without a potential does not choose the branch: it is added to the shape that all others leave.
        match self.advance([&unloaded, &held], [0.0, 0.5], unknowns) {
            Outcome::Solved | Outcome::Neutral => self.advance([&held, target], [0.5, 1.0], unknowns),
            lost => lost,
        }
    }

    /// Follows the branch along the inputs between two; `stage` is where that lies in the whole solve.
    fn advance(&mut self, [start, target]: [&Inputs; 2], stage: [f64; 2], unknowns: &mut [f64]) -> Outcome {
        let at = |part: f64| if part >= 1.0 { target.clone() } else { start.between(target, part) };
        let (smallest, resting) = (self.model.settings.smallest_part, self.resting());
        let (mut done, mut part, mut floor) = (0.0, 1.0, smallest);
        let mut here = start.clone();
        let (mut neutral, mut shortened) = (false, false);
        // Snaps when the last descent began: what comes down in several steps has snapped once.
        let mut before_descent = None;
        while self.left() > self.model.settings.iterations / RESERVE && self.may_go_on() {
            self.report.progress = stage[0] + done * (stage[1] - stage[0]);
            let next = f64::min(1.0, done + part);
            let inputs = at(next);
            let corrected = !neutral && self.try_to_correct(Some(&here), &inputs, unknowns);
            if !corrected && !neutral && part > floor {
                (part, shortened) = (0.5 * part, true);
                continue;
            }
            let end = if corrected {
                before_descent = None;
                Outcome::Solved
            } else {
                let before = *before_descent.get_or_insert(self.report.snaps);
                let tolerance = if next < 1.0 { PASSING } else { resting };
                let end = self.descend_from([&here, &inputs], unknowns, tolerance);
                self.report.snaps = self.report.snaps.min(before + 1);
                end
            };
            // Where the branch has to be descended again and again, it is steep or nearly neutral: shorter steps are no help.
            floor = if corrected { smallest } else { FURTHER * floor };
            neutral = end == Outcome::Neutral && next < 1.0;
            if end != Outcome::Solved && !neutral {
                return self.rests(end);
            }
            // A length that was just too long is not tried again at once.
            part = floor.max(if shortened { part } else { 2.0 * part });
            (done, here, shortened) = (next, inputs, false);
            if done >= 1.0 {
                return end;
            }
            if !neutral {
                self.reached = Some((here.clone(), unknowns.to_vec()));
            }
        }
        // Too many small steps along the branch: downhill all the way.
        let end = self.descend_from([&here, target], unknowns, resting);
        self.rests(end)
    }

    /// A neutral shape at the target is only one in balance.
    fn rests(&self, end: Outcome) -> Outcome {
        if end == Outcome::Neutral && self.report.residual > ROUNDING { Outcome::BranchEnds } else { end }
    }
}

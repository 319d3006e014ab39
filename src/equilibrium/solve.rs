//! One solve: predict the next shape and correct it. Where that fails, follow the branch in shorter steps of the inputs;
//! where the branch ends, descend to the next one. Then assess the stability.

use super::history::History;
use super::inputs::Inputs;
use super::outcome::Outcome;
use super::report::Report;
use super::search::{PASSING, ROUNDING, Search};
use crate::numerics::trust_region::Objective;
use crate::rod::Element;

/// Largest drift of loads and shape from the last factorisation for which its stability margin is kept, relative to that
/// margin.
const KEPT: f64 = 0.1;

/// Largest first Newton step, in the radian norm, from the straight shape to the one under internal forces alone. It may
/// be large because there is no branch to lose yet.
const SETTLING: f64 = 4.0;

/// Length (radian norm) of the first step from the unloaded shape, as its factorisation predicts it, up to which that step
/// is tried: Newton's method finds no shape much farther away.
const STRAIGHT: f64 = 2.0;

/// Share of the progress of a first solve until a shaft is pushed in.
const BEGUN: f64 = 0.2;

/// Length (m) by which a shaft is pushed in at first.
const PUSHED: f64 = 2e-3;

/// Share of the way from the soft to the actual wall that is tried first.
const STIFFER: f64 = 0.125;

/// Modulus (Pa) of the wall while the loads of a first solve are applied, if it is stiffer: that of a soft silicone.
const LINING: f64 = 1e6;

/// Ratio of the softened wall's modulus to bending stiffness over the fourth power of the length.
const ALIKE: f64 = 1e3;

/// Part of a step over which the tangent of a branch is found by a difference.
const TANGENT: f64 = 1e-3;

/// Inverse of the fraction of iterations that is reserved for a final descent.
const RESERVE: u32 = 3;

/// Growth factor of the step length after a step that needed a descent.
const FURTHER: f64 = 4.0;

impl Search<'_> {
    /// Moves `branch` to the equilibrium at `target`; on failure the branch stays unchanged.
    pub(super) fn solve(&mut self, branch: &mut History, target: &Inputs) -> Report {
        self.reached = None;
        self.reach = KEPT * if branch.stable.is_some() { branch.margin } else { 1.0 };
        self.scratch.last.copy_from_slice(&branch.unknowns);
        self.take_up_turn(branch, target);
        self.begin_friction();
        let taken_up = branch.stable.is_none();
        let found = if self.predict(branch, target) || self.settle(branch, target) {
            Outcome::Solved
        } else {
            self.follow(branch.inputs.as_ref(), target, &mut branch.unknowns)
        };
        let outcome = self.assess(found, branch, target);
        if !outcome.is_solved() {
            return self.give_up(branch, outcome);
        }
        (self.report.outcome, self.report.progress) = (outcome, 1.0);
        (branch.margin, branch.stable) = (self.margin, self.report.stable);
        branch.turn = self.work.free_turn;
        self.end_friction(target, &branch.unknowns);
        // Past a snap, or from the shape of another model, the last steps do not extrapolate to the next one.
        branch.advance(target, &self.scratch.last, self.report.snaps > 0 || taken_up);
        self.report
    }

    /// Restores `branch`. If only the budget ran out, it is left at the last equilibrium on the way instead, so that the
    /// next solve continues there.
    fn give_up(&mut self, branch: &mut History, outcome: Outcome) -> Report {
        self.work.factorisation = None;
        self.work.free_turn = None;
        let reached = self.reached.take().filter(|_| matches!(outcome, Outcome::OutOfBudget(_)));
        self.recall_friction(reached.is_some());
        match reached {
            Some((inputs, unknowns)) => branch.rest_at(inputs, unknowns),
            None => branch.unknowns.copy_from_slice(&self.scratch.last),
        }
        (self.report.outcome, self.report.stable, self.report.margin) = (outcome, None, 0.0);
        self.report
    }

    /// Corrects a shape adopted from another model, which is not yet an equilibrium of this one; this is not a step of
    /// the inputs. Returns whether the shape then is at the target's inputs.
    fn settle(&mut self, branch: &mut History, target: &Inputs) -> bool {
        let Some(here) = branch.inputs.as_ref().filter(|_| branch.stable.is_none()) else { return false };
        let start = self.scratch.last.clone();
        self.try_to_correct(None, here, &mut branch.unknowns)
            && self.settle_friction([here, here], &start, &mut branch.unknowns, false)
            && here == target
    }

    /// Follows the branch from the inputs of `unknowns` (`None`: straight, nothing is solved yet) to `target`.
    fn follow(&mut self, from: Option<&Inputs>, target: &Inputs, unknowns: &mut [f64]) -> Outcome {
        if let Some(start) = from {
            return self.advance([start, target], [0.0, 1.0], 1.0, unknowns);
        }
        if self.model.chain.shaft == 0 || target.insertion == 0.0 {
            return self.begin(target, [0.0, 1.0], unknowns);
        }
        // A shaft is pushed in under the loads of the target.
        let outside = Inputs { insertion: 0.0, ..target.clone() };
        let begun = self.begin(&outside, [0.0, BEGUN], unknowns);
        if !begun.is_solved() {
            return begun;
        }
        let first = (PUSHED / target.insertion).min(1.0);
        self.advance([&outside, target], [BEGUN, 1.0], first, unknowns)
    }

    /// Finds the first shape, at `target`, from the straight one. The stage is that of [`Self::advance`].
    fn begin(&mut self, target: &Inputs, [from, to]: [f64; 2], unknowns: &mut [f64]) -> Outcome {
        let stages = [0.0, 0.2, 0.4, 0.8, 1.0].map(|part| from + part * (to - from));
        // A wall far stiffer than those of vessels lets none of its contacts change smoothly: it becomes so last.
        let lining = self.softening(LINING);
        let (unloaded, lined) = (
            Inputs { softening: lining, ..target.without_loads() },
            Inputs { softening: lining, ..target.clone() },
        );
        let widening = self.potential(&unloaded).missing_width(unknowns);
        let softening = if widening > 0.0 { self.softening(self.alike(target)) } else { lining };
        let free = Inputs { widening, softening, ..unloaded.clone() };
        // The unloaded shape, under internal forces alone, is found from the straight one.
        self.passing = free != *target;
        let found = self.correct(&free, unknowns, SETTLING);
        self.passing = false;
        if !found && self.descend(&free, unknowns, self.resting()) != Outcome::Solved {
            return Outcome::BranchEnds;
        }
        let mut stage = 0;
        let mut done = Outcome::Solved;
        if widening > 0.0 {
            // A vessel that the straight shape does not fit into narrows around it, with a soft wall that then stiffens.
            let narrow = Inputs { softening, ..unloaded.clone() };
            done = self.advance([&free, &narrow], [stages[0], stages[1]], 0.5, unknowns);
            if done.is_solved() {
                done = self.advance([&narrow, &unloaded], [stages[1], stages[2]], STIFFER, unknowns);
            }
            stage = 2;
        }
        let hardens = lined != *target;
        if done.is_solved() {
            let end = stages[if hardens { 3 } else { 4 }];
            done = self.load_up([&unloaded, &lined], [stages[stage], end], unknowns);
        }
        if done.is_solved() && hardens {
            done = self.advance([&lined, target], [stages[3], stages[4]], STIFFER, unknowns);
        }
        done
    }

    /// Applies the loads of `target` to the shape under internal forces alone.
    fn load_up(
        &mut self,
        [unloaded, target]: [&Inputs; 2],
        [from, to]: [f64; 2],
        unknowns: &mut [f64],
    ) -> Outcome {
        let held = target.without_moment();
        let first = self.first_part(&held, unknowns);
        if held == *target {
            return self.advance([unloaded, target], [from, to], first, unknowns);
        }
        // A non-conservative load does not select the branch: it is applied last, to the shape under all other loads.
        let middle = 0.5 * (from + to);
        match self.advance([unloaded, &held], [from, middle], first, unknowns) {
            Outcome::Solved | Outcome::Neutral => self.advance([&held, target], [middle, to], 1.0, unknowns),
            lost => lost,
        }
    }

    /// Softening that leaves the wall with this modulus (Pa), unless it is as soft by itself.
    fn softening(&self, modulus: f64) -> f64 {
        self.model.around.map_or(0.0, |around| (around.vessel.wall.modulus() / modulus).ln().max(0.0))
    }

    /// Modulus (Pa) of a wall that is about as soft as the chain.
    fn alike(&self, inputs: &Inputs) -> f64 {
        let chain = self.model.chain;
        let bending = |element: &Element| element.metric[0] * element.length;
        let length = chain.inserted(chain.growth(inputs.insertion)) + chain.length();
        ALIKE * chain.elements.iter().map(bending).fold(0.0, f64::max) / length.powi(4)
    }

    /// Follows the branch along the straight path between two inputs; `stage` is the range of progress that this path
    /// covers in the whole solve.
    fn advance(
        &mut self,
        [start, target]: [&Inputs; 2],
        stage: [f64; 2],
        first: f64,
        unknowns: &mut [f64],
    ) -> Outcome {
        let at = |part: f64| if part >= 1.0 { target.clone() } else { start.between(target, part) };
        let (smallest, resting) = (self.model.settings.smallest_part, self.resting());
        let (mut done, mut part, mut floor) = (0.0, first, smallest);
        let mut here = start.clone();
        let (mut neutral, mut shortened) = (false, false);
        // Number of snaps when the last descent began: a descent over several steps counts as one snap.
        let mut before_descent = None;
        while self.left() > self.model.settings.iterations / RESERVE && self.may_go_on() {
            self.report.progress = stage[0] + done * (stage[1] - stage[0]);
            let next = f64::min(1.0, done + part);
            let inputs = at(next);
            self.passing = next < 1.0;
            let start = if self.work.friction.holds() { unknowns.to_vec() } else { Vec::new() };
            let mut corrected = !neutral
                && (self.model.around.is_some() && {
                    let nearby = at(done + TANGENT * (next - done));
                    self.try_to_correct_along((&nearby, TANGENT), [&here, &inputs], unknowns)
                } || self.try_to_correct(Some(&here), &inputs, unknowns));
            corrected = corrected && self.settle_friction([&here, &inputs], &start, unknowns, false);
            self.passing = false;
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
            // Repeated descents mean that the branch is steep or nearly neutral: shorter steps do not help.
            floor = if corrected { smallest } else { FURTHER * floor };
            neutral = end == Outcome::Neutral && next < 1.0;
            if end != Outcome::Solved && !neutral {
                return self.rests(end);
            }
            if !corrected && !neutral && !self.settle_friction([&here, &inputs], &start, unknowns, true) {
                return Outcome::Wedged;
            }
            // A step length that has just failed is not tried again at once.
            part = floor.max(if shortened { part } else { 2.0 * part });
            (done, here, shortened) = (next, inputs, false);
            if done >= 1.0 {
                return end;
            }
            if !neutral {
                self.reached = Some((here.clone(), unknowns.to_vec()));
                self.note_friction();
            }
        }
        // Too many small steps along the branch: descend to the target at once.
        let start = unknowns.to_vec();
        let end = self.descend_from([&here, target], unknowns, resting);
        if end == Outcome::Solved && !self.settle_friction([&here, target], &start, unknowns, true) {
            return Outcome::Wedged;
        }
        self.rests(end)
    }

    /// The share of the way between two inputs that is tried first from the equilibrium `unknowns` at `start`: halved until
    /// the step that the last factorisation predicts is short enough to be worth a Hessian.
    fn first_part(&mut self, target: &Inputs, unknowns: &[f64]) -> f64 {
        let mut part = 1.0;
        if self.work.factorisation.is_none() || self.potential(target).slope(unknowns).is_none() {
            return part;
        }
        let length = self.step(target, 0);
        while part * length > STRAIGHT && part > self.model.settings.smallest_part {
            part *= 0.5;
        }
        part
    }

    /// Accepts a neutral shape at the target only if it is in equilibrium.
    fn rests(&self, end: Outcome) -> Outcome {
        if end == Outcome::Neutral && self.report.residual > ROUNDING { Outcome::BranchEnds } else { end }
    }
}

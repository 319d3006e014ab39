//! One solve: predict the next shape and correct it. Where that fails, follow the branch in shorter steps of the inputs; where
//! the branch ends, descend to the next one. Then assess the stability.

use super::corrector::{Finding, Verdict};
use super::evaluator::{Aim, Evaluator};
use super::follow::Search;
use super::friction_corrector::Means;
use super::history::History;
use super::outcome::Outcome;
use super::path::{FirstStep, Stage, Step};
use super::report::Report;
use super::stages::{FirstSolve, FirstWall, outside};
use crate::equilibrium::model::Inputs;
use crate::numerics::trust_region::Objective;
use crate::rod::Element;

/// Largest drift of loads and shape from the last factorisation for which its stability margin is kept, relative to that
/// margin.
pub(super) const KEPT: f64 = 0.1;

/// Largest correction of a predicted step, relative to its length.
const MISTAKEN: f64 = 0.1;

/// Largest first Newton step, in the radian norm, from the straight shape to the one under internal forces alone. It may
/// be large because there is no branch to lose yet.
const SETTLING: f64 = 4.0;

/// Modulus (Pa) of the wall while the loads of a first solve are applied, if it is stiffer: that of a soft silicone.
const LINING: f64 = 1e6;

/// Ratio of the softened wall's modulus to bending stiffness over the fourth power of the length.
const ALIKE: f64 = 1e3;

impl Search<'_> {
    /// Moves `branch` to the equilibrium at `target`; on failure the branch stays unchanged.
    pub(super) fn solve(&mut self, branch: &mut History, target: &Inputs, last: &mut [f64]) -> Report {
        last.copy_from_slice(&branch.unknowns);
        let adopted = branch.stable.is_none();
        self.corrector.evaluator.take_up_turn(branch.turn, target);
        if let Some(contact) = &mut self.corrector.evaluator.contact {
            contact.friction.begin();
        }

        let found = self
            .predict(branch, target)
            .or_else(|_| self.settle(branch, target))
            .or_else(|_| self.go_to(branch, target));
        let (outcome, stable) = self.assess(found, branch, target);
        if !outcome.is_solved() {
            return self.give_up(branch, outcome, last);
        }

        self.progress = 1.0;
        (branch.margin, branch.stable) = (self.stability.margin, stable);
        branch.turn = self.corrector.evaluator.work.free_turn;
        self.corrector.end_friction(target, &branch.unknowns);
        // Past a snap, or from the shape of another model, the last steps do not extrapolate to the next one.
        branch.advance(target, last, self.snaps > 0 || adopted);
        self.report(outcome, stable)
    }

    /// Predicts the shape at the target from the last ones of the branch, and corrects it.
    fn predict(&mut self, branch: &mut History, target: &Inputs) -> Finding {
        let mut trial = std::mem::take(&mut self.corrector.buffers.trial);
        let expected = branch.predicted(target, &self.corrector.evaluator.model, &mut trial);
        let found = match (expected, &branch.inputs) {
            (Some(length), Some(before)) => {
                let step = Step::between([before, target], Aim::Rest);
                let reach = (MISTAKEN * length).max(self.corrector.evaluator.nearly());
                self.corrector.under_friction(
                    &step,
                    &mut branch.unknowns,
                    Means::Correction,
                    |corrector, unknowns| {
                        let found = corrector.accept(&step, unknowns, &mut trial, reach);
                        found.ok_or(Outcome::BranchEnds)
                    },
                )
            }
            _ => Err(Outcome::BranchEnds),
        };
        self.corrector.buffers.trial = trial;
        found
    }

    /// Corrects a shape adopted from another model, which is not yet an equilibrium of this one; this is not a step of
    /// the inputs. Succeeds where the shape then is at the target's inputs.
    fn settle(&mut self, branch: &mut History, target: &Inputs) -> Finding {
        let adopted = branch.stable.is_none();
        let Some(here) = branch.inputs.as_ref().filter(|_| adopted) else { return Err(Outcome::BranchEnds) };
        let step = Step { adopted: true, ..Step::between([here, here], Aim::Rest) };
        let found = self.corrector.under_friction(
            &step,
            &mut branch.unknowns,
            Means::Correction,
            |corrector, unknowns| corrector.try_to_correct(&step, unknowns).ok_or(Outcome::BranchEnds),
        );
        found.and_then(|verdict| if here == target { Ok(verdict) } else { Err(Outcome::BranchEnds) })
    }

    /// Goes from the last shape of a branch, or the straight one, to `target` in as many steps as that takes.
    fn go_to(&mut self, branch: &mut History, target: &Inputs) -> Finding {
        let Some(from) = &branch.inputs else { return self.solve_first(target, &mut branch.unknowns) };
        let stage = Stage {
            from: from.clone(),
            to: target.clone(),
            progress: [0.0, 1.0],
            first: FirstStep::Part(1.0),
        };
        self.follow(&[stage], &mut branch.unknowns)
    }

    /// Finds the first shape, at `target`, from the straight one.
    fn solve_first(&mut self, target: &Inputs, unknowns: &mut [f64]) -> Finding {
        let pushed_in = self.corrector.evaluator.model.chain.shaft > 0 && target.insertion != 0.0;
        let begun = if pushed_in { outside(target) } else { target.clone() };
        let wall = self.first_wall(&begun, unknowns);
        let FirstSolve { free, stages } =
            if pushed_in { FirstSolve::pushed_in(target, &wall) } else { FirstSolve::at(target, &wall) };

        // The unloaded shape, under internal forces alone, is found from the straight one.
        let aim = if free == begun { Aim::Rest } else { Aim::Pass };
        if self.corrector.correct(&free, unknowns, SETTLING, aim).is_none() {
            let resting = self.corrector.evaluator.resting(Aim::Rest);
            if self.corrector.descend(&free, unknowns, resting) != Outcome::Solved {
                return Err(Outcome::BranchEnds);
            }
        }
        self.follow(&stages, unknowns)
    }

    /// The wall with which a first solve at `target` begins from the straight shape.
    fn first_wall(&mut self, target: &Inputs, straight: &[f64]) -> FirstWall {
        let Evaluator { model, contact, work, .. } = &mut self.corrector.evaluator;
        let Some(contact) = contact.as_deref_mut() else { return FirstWall::default() };

        // A wall that is about as soft as the chain.
        let chain = model.chain;
        let bending = |element: &Element| element.metric[0] * element.length;
        let length = chain.inserted(chain.growth(target.insertion)) + chain.length();
        let alike = ALIKE * chain.elements.iter().map(bending).fold(0.0, f64::max) / length.powi(4);

        // Softening that leaves the wall with this modulus (Pa), unless it is as soft by itself.
        let modulus = contact.vessel().wall.modulus();
        let softening = |softened: f64| (modulus / softened).ln().max(0.0);
        FirstWall {
            widening: contact.missing_width(chain, &target.without_loads(), straight, work),
            narrowing: softening(alike),
            lining: softening(LINING),
        }
    }

    /// Assesses the shape found at `target`: its outcome and whether it is stable, or why there is none.
    fn assess(&mut self, found: Finding, branch: &History, target: &Inputs) -> (Outcome, Option<bool>) {
        let evaluator = &mut self.corrector.evaluator;
        let stable = match found {
            Ok(Verdict::Kept) => self.stability.is_stable(evaluator),
            Ok(Verdict::Fresh) => {
                let first = branch.stable.is_none();
                self.stability.assess(evaluator, target, &branch.unknowns, first)
            }
            Err(Outcome::Neutral) => {
                // Factorisation and loads belong to a shape on the way, or on the way back.
                evaluator.potential(target).slope(&branch.unknowns);
                evaluator.work.factorisation = None;
                Some(false)
            }
            Err(otherwise) => {
                // A contact at the last trial shape may be the reason.
                let contact = evaluator.model.contact(target, evaluator.work).map(Outcome::Contact);
                let otherwise = evaluator.spent().map_or(otherwise, Outcome::OutOfBudget);
                return (contact.unwrap_or(otherwise), None);
            }
        };

        let outcome = if stable == Some(false) { Outcome::Neutral } else { Outcome::Solved };
        evaluator.work.place(evaluator.model.chain, target, &branch.unknowns);
        let contact = evaluator.model.contact(target, evaluator.work);
        (contact.map_or(outcome, Outcome::Contact), stable)
    }

    /// Restores `branch`. If only the budget ran out, it is left at the last equilibrium on the way instead, so that the
    /// next solve continues there.
    fn give_up(&mut self, branch: &mut History, outcome: Outcome, last: &[f64]) -> Report {
        let work = &mut *self.corrector.evaluator.work;
        (work.factorisation, work.free_turn) = (None, None);
        let reached = self.reached.take().filter(|_| matches!(outcome, Outcome::OutOfBudget(_)));
        if let Some(contact) = &mut self.corrector.evaluator.contact {
            contact.friction.go_back(reached.is_some());
        }
        match reached {
            Some((inputs, unknowns)) => branch.rest_at(inputs, unknowns),
            None => branch.unknowns.copy_from_slice(last),
        }
        self.report(outcome, None)
    }

    fn report(&self, outcome: Outcome, stable: Option<bool>) -> Report {
        let Evaluator { iterations, balance, .. } = self.corrector.evaluator;
        Report {
            outcome,
            progress: self.progress,
            iterations,
            residual: balance.residual,
            margin: if stable == Some(true) { self.stability.margin } else { 0.0 },
            stable,
            snaps: self.snaps,
            energy: balance.energy,
        }
    }
}

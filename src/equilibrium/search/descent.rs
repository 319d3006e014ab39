//! Descent beyond the end of a branch to the next stable shape, and whether that was a snap.

use super::corrector::Corrector;
use super::evaluator::{Aim, NEARLY, PASSING, ROUNDING};
use super::outcome::Outcome;
use super::path::Step;
use crate::equilibrium::model::Inputs;
use crate::numerics::pseudo_transient::settle;
use crate::numerics::trust_region::{Minimum, Objective, minimise, spread};

/// Distance, relative to that of the descent, within which the way back must reach the start if the branch has not been
/// left.
const RETURNED: f64 = 0.5;

/// Length of a descent (radian norm) from which on it is asked whether it jumped within a narrow hysteresis.
const FAR: f64 = 0.5;

/// How often a change of inputs is halved to tell a jump from a steep branch, and the part of the descent's length that is left of a
/// jump then: of a branch as steep as a square root a sixteenth is left.
const HALVINGS: u32 = 8;
const JUMP: f64 = 0.25;

/// Distance, relative to that of the descent, within which overdamped motion ends if the descent has drifted along a
/// neutral branch.
const DRIFTED: f64 = 0.9;

/// Smallest stability margin for which the way back is resolved: the ratio of the residual at which it ends to the
/// distance.
const SOFT: f64 = 1e-6;

/// Largest difference of two energies that count as equal, in the squared radian norm: what the residuals leave
/// undetermined.
const SAME_ENERGY: f64 = 1e-7;

/// Length of the perturbation (radian norm) of an unstable equilibrium.
const PUSH: f64 = 1e-3;

/// Where a descent has ended.
#[derive(Debug, Clone, Copy)]
pub(super) struct Descended {
    pub(super) outcome: Outcome,
    /// Whether it has led to another branch.
    pub(super) snapped: bool,
}

impl Corrector<'_> {
    /// Descends along a step to the next stable shape, as [`Self::descend`], and tells whether the branch has been left.
    pub(super) fn descend_along(&mut self, step: &Step<'_>, unknowns: &mut [f64]) -> Descended {
        let last = unknowns.to_vec();
        let outcome = self.descend(step.inputs, unknowns, self.evaluator.resting(step.aim));
        let snapped = outcome.is_solved()
            && (self.has_left(step, &last, unknowns)
                || outcome == Outcome::Solved && self.jumps(step, [&last, unknowns]));
        Descended { outcome, snapped }
    }

    /// Descends to the next stable shape, until Newton's method takes over at the residual `tolerance` (radian norm).
    pub(super) fn descend(&mut self, inputs: &Inputs, unknowns: &mut [f64], tolerance: f64) -> Outcome {
        let unit = self.evaluator.unit();
        let mut reached = unknowns.to_vec();
        self.evaluator.work.free_turn = None;
        if self.evaluator.is_symmetric(inputs) {
            // Along a free turn a descent would go on until rounding ends it.
            let minimum = self.go_downhill(inputs, &mut reached, tolerance.max(PASSING));
            if minimum.residual <= NEARLY * unit && self.rest_on_turn(inputs, &mut reached) {
                unknowns.copy_from_slice(&reached);
                return Outcome::Solved;
            }
        }

        let minimum = self.go_down_to_stable(inputs, &mut reached, tolerance);
        let conservative = self.evaluator.potential(inputs).terms.have_potential();
        let residual = minimum.residual / unit;
        self.evaluator.balance.residual = residual;
        if !minimum.converged {
            let neutral = conservative && residual <= NEARLY;
            return if neutral { Outcome::Neutral } else { Outcome::BranchEnds };
        }

        let mut corrected = reached.clone();
        let reach = self.evaluator.model.settings.follow_step;
        let confirmed = self.correct(inputs, &mut corrected, reach, Aim::Rest).is_some();
        if confirmed {
            reached = corrected;
        } else if conservative {
            self.evaluator.balance.residual = residual;
        } else {
            return Outcome::BranchEnds; // an unstable equilibrium
        }
        unknowns.copy_from_slice(&reached);
        if confirmed { Outcome::Solved } else { Outcome::Neutral }
    }

    /// Goes downhill; where forces have no potential, past unstable equilibria, which the descent of a potential leaves by itself.
    fn go_down_to_stable(&mut self, inputs: &Inputs, unknowns: &mut [f64], tolerance: f64) -> Minimum {
        let minimum = self.go_downhill(inputs, unknowns, tolerance);
        let conservative = self.evaluator.potential(inputs).terms.have_potential();
        if conservative || !minimum.converged || self.is_confirmed(inputs, unknowns) {
            return minimum;
        }
        spread(self.evaluator.model.metric, unknowns, PUSH * self.evaluator.unit());
        self.go_downhill(inputs, unknowns, tolerance)
    }

    /// Corrects a shape near an equilibrium that is free to turn, with the turn held; returns whether it is one.
    fn rest_on_turn(&mut self, inputs: &Inputs, shape: &mut Vec<f64>) -> bool {
        if !self.evaluator.hold_turn(inputs, shape) {
            return false;
        }
        let mut corrected = shape.clone();
        let reach = self.evaluator.model.settings.follow_step;
        let found = self.correct(inputs, &mut corrected, reach, Aim::Rest).is_some()
            && self.evaluator.is_still_free(inputs);
        if found {
            *shape = corrected;
        } else {
            self.evaluator.work.free_turn = None;
        }
        found
    }

    fn is_confirmed(&mut self, inputs: &Inputs, unknowns: &[f64]) -> bool {
        self.correct(inputs, &mut unknowns.to_vec(), NEARLY, Aim::Rest).is_some()
    }

    fn go_downhill(&mut self, inputs: &Inputs, unknowns: &mut [f64], tolerance: f64) -> Minimum {
        let evaluator = &mut self.evaluator;
        evaluator.choose_rules(inputs, unknowns);
        let (region, deadline) = (evaluator.region(tolerance), evaluator.deadline);
        let mut potential = evaluator.potential(inputs);
        let proceed = || !deadline.has_passed();
        let minimum = if potential.terms.have_potential() {
            minimise(&mut potential, unknowns, &region, proceed)
        } else {
            settle(&mut potential, unknowns, &region, proceed)
        };
        evaluator.iterations += minimum.iterations;
        minimum
    }
}

/// Whether the branch was left.
impl Corrector<'_> {
    /// Whether a descent from the shape `last` has led to another branch: a branch that continues, however steeply, leads back when
    /// the inputs are reversed.
    fn has_left(&mut self, step: &Step<'_>, last: &[f64], reached: &[f64]) -> bool {
        let (distance, unit) = (self.evaluator.distance(reached, last), self.evaluator.unit());
        if distance <= NEARLY * unit {
            return false;
        }
        self.aside(|search| {
            let mut back = reached.to_vec();
            // Where the branch is soft, the residual is already small halfway back.
            let tolerance = (SOFT * distance / unit).clamp(ROUNDING, PASSING);
            search.go_downhill(step.before, &mut back, tolerance);
            search.evaluator.distance(&back, last) > RETURNED * distance
                && !search.has_drifted(step.inputs, last, reached, DRIFTED * distance)
        })
    }

    /// Descends to other shapes than the one that has been found, whose results are kept.
    fn aside<T>(&mut self, act: impl FnOnce(&mut Self) -> T) -> T {
        // The way back may end at a straight shape: nothing is held on it.
        let turn = self.evaluator.work.free_turn.take();
        let balance = self.evaluator.balance;
        let out = act(self);
        // The factorisation belongs to another shape.
        (self.evaluator.work.factorisation, self.evaluator.work.free_turn) = (None, turn);
        self.evaluator.balance = balance;
        out
    }

    /// Whether a descent between two shapes that lead to one another is a jump all the same, within a hysteresis narrower than the
    /// change of the inputs: halving that change again and again shortens a steep branch, but not a jump.
    ///
    /// The way back is halved, which is the same from whichever side of a symmetric branching it comes. Asked of stable shapes,
    /// which no free direction leaves undetermined, and not in a vessel, whose contacts let go one by one.
    fn jumps(&mut self, step: &Step<'_>, [last, reached]: [&[f64]; 2]) -> bool {
        let distance = self.evaluator.distance(reached, last);
        if self.evaluator.contact.is_some() || distance <= FAR * self.evaluator.unit() {
            return false;
        }

        self.aside(|search| {
            let (mut near, mut far) = (last.to_vec(), reached.to_vec());
            let (mut from, mut to) = (0.0, 1.0);
            for _ in 0..HALVINGS {
                let middle = 0.5 * (from + to);
                let (here, mut shape) = (step.before.between(step.inputs, middle), far.clone());
                let minimum = search.go_downhill(&here, &mut shape, ROUNDING);
                if !minimum.converged || !search.is_confirmed(&here, &shape) {
                    return false;
                }
                if search.evaluator.distance(&shape, &near) <= search.evaluator.distance(&shape, &far) {
                    (near, from) = (shape, middle);
                } else {
                    (far, to) = (shape, middle);
                }
            }
            search.evaluator.distance(&far, &near) > JUMP * distance
                && !search.has_drifted(step.inputs, last, reached, DRIFTED * distance)
        })
    }

    /// Whether overdamped motion from `last` ends within `reach` of it at a shape as low as `reached`. Then the branch
    /// continues there, and the descent has drifted along a neutral direction.
    fn has_drifted(&mut self, inputs: &Inputs, last: &[f64], reached: &[f64], reach: f64) -> bool {
        let evaluator = &mut self.evaluator;
        if !evaluator.potential(inputs).terms.have_potential() {
            return false;
        }
        let mut settled = last.to_vec();
        let (region, deadline) = (evaluator.region(PASSING), evaluator.deadline);
        settle(&mut evaluator.potential(inputs), &mut settled, &region, || !deadline.has_passed());
        if evaluator.distance(&settled, last) > reach {
            return false;
        }

        let unit = evaluator.unit();
        let mut potential = evaluator.potential(inputs);
        let energies = potential.slope(&settled).zip(potential.slope(reached));
        energies.is_some_and(|(settled, reached)| settled - reached <= SAME_ENERGY * unit * unit)
    }
}

//! Descent beyond the end of a branch to the next stable shape, and whether that was a snap.

use super::inputs::Inputs;
use super::outcome::Outcome;
use super::search::{NEARLY, PASSING, ROUNDING, Search};
use crate::numerics::pseudo_transient::settle;
use crate::numerics::trust_region::{Minimum, Objective, Region, distance, minimise, spread};

/// First radius of the trust region past a fold, in the radian norm: small, so that the path of descent is followed.
const FIRST_RADIUS: f64 = 0.1;

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

impl Search<'_> {
    /// Descends from a shape at `before` to the next stable one at `inputs`, as [`Search::descend`]; counts a snap where
    /// the branch has been left.
    pub(super) fn descend_from(
        &mut self,
        [before, inputs]: [&Inputs; 2],
        unknowns: &mut [f64],
        tolerance: f64,
    ) -> Outcome {
        let last = unknowns.to_vec();
        let end = self.descend(inputs, unknowns, tolerance);
        let left = matches!(end, Outcome::Solved | Outcome::Neutral)
            && (self.has_left(before, inputs, &last, unknowns)
                || end == Outcome::Solved && self.jumps([before, inputs], [&last, unknowns]));
        self.report.snaps += u32::from(left);
        end
    }

    /// Descends to the next stable shape, until Newton's method takes over at the residual `tolerance` (radian norm).
    pub(super) fn descend(&mut self, inputs: &Inputs, unknowns: &mut [f64], tolerance: f64) -> Outcome {
        let unit = self.model.chain.radian_norm();
        let mut reached = unknowns.to_vec();
        self.work.free_turn = None;
        let conservative = self.potential(inputs).terms.have_potential();
        if self.is_symmetric(inputs) {
            // Along a free turn a descent would go on until rounding ends it.
            let minimum = self.go_downhill(inputs, &mut reached, tolerance.max(PASSING));
            if minimum.residual <= NEARLY * unit && self.rest_on_turn(inputs, &mut reached) {
                unknowns.copy_from_slice(&reached);
                return Outcome::Solved;
            }
        }
        let mut minimum = self.go_downhill(inputs, &mut reached, tolerance);
        if !conservative && minimum.converged && !self.is_confirmed(inputs, &reached) {
            // An unstable equilibrium, which the descent of a potential leaves by itself.
            spread(self.model.metric, &mut reached, PUSH * unit);
            minimum = self.go_downhill(inputs, &mut reached, tolerance);
        }
        let residual = minimum.residual / unit;
        self.report.residual = residual;
        if !minimum.converged {
            return if conservative && residual <= NEARLY { Outcome::Neutral } else { Outcome::BranchEnds };
        }
        let mut corrected = reached.clone();
        let end = if self.correct(inputs, &mut corrected, self.model.settings.follow_step) {
            reached = corrected;
            Outcome::Solved
        } else if conservative {
            self.report.residual = residual;
            Outcome::Neutral
        } else {
            return Outcome::BranchEnds; // an unstable equilibrium
        };
        unknowns.copy_from_slice(&reached);
        self.kept = false;
        end
    }

    /// Corrects a shape near an equilibrium that is free to turn, with the turn held; returns whether it is one.
    fn rest_on_turn(&mut self, inputs: &Inputs, shape: &mut Vec<f64>) -> bool {
        if !self.hold_turn(inputs, shape) {
            return false;
        }
        let mut corrected = shape.clone();
        let found = self.correct(inputs, &mut corrected, self.model.settings.follow_step)
            && self.is_still_free(inputs);
        if found {
            *shape = corrected;
            self.kept = false;
        } else {
            self.work.free_turn = None;
        }
        found
    }

    fn is_confirmed(&mut self, inputs: &Inputs, unknowns: &[f64]) -> bool {
        let mut corrected = unknowns.to_vec();
        self.correct(inputs, &mut corrected, NEARLY)
    }

    fn go_downhill(&mut self, inputs: &Inputs, unknowns: &mut [f64], tolerance: f64) -> Minimum {
        self.choose_rules(inputs, unknowns);
        let (region, deadline) = (self.region(tolerance), self.deadline);
        let mut potential = self.potential(inputs);
        let proceed = || !deadline.has_passed();
        let minimum = if potential.terms.have_potential() {
            minimise(&mut potential, unknowns, &region, proceed)
        } else {
            settle(&mut potential, unknowns, &region, proceed)
        };
        self.report.iterations += minimum.iterations;
        minimum
    }

    /// Whether a descent from the shape `last`, at `before`, has led to another branch: a branch that continues, however
    /// steeply, leads back when the inputs are reversed.
    fn has_left(&mut self, before: &Inputs, inputs: &Inputs, last: &[f64], reached: &[f64]) -> bool {
        let distance = self.apart(reached, last);
        if distance <= NEARLY * self.model.chain.radian_norm() {
            return false;
        }
        self.aside(|search| {
            let mut back = reached.to_vec();
            // Where the branch is soft, the residual is already small halfway back.
            let tolerance = (SOFT * distance / search.model.chain.radian_norm()).clamp(ROUNDING, PASSING);
            search.go_downhill(before, &mut back, tolerance);
            search.apart(&back, last) > RETURNED * distance
                && !search.has_drifted(inputs, last, reached, DRIFTED * distance)
        })
    }

    /// Descends to other shapes than the one that has been found, whose results are kept.
    fn aside<T>(&mut self, act: impl FnOnce(&mut Self) -> T) -> T {
        // The way back may end at a straight shape: nothing is held on it.
        let turn = self.work.free_turn.take();
        let (residual, energy) = (self.report.residual, self.report.energy);
        let out = act(self);
        // The factorisation belongs to another shape.
        (self.work.factorisation, self.work.free_turn) = (None, turn);
        (self.report.residual, self.report.energy) = (residual, energy);
        out
    }

    /// Whether a descent between two shapes that lead to one another is a jump all the same, within a hysteresis narrower than the
    /// change of the inputs: halving that change again and again shortens a steep branch, but not a jump.
    ///
    /// The way back is halved, which is the same from whichever side of a symmetric branching it comes. Asked of stable shapes,
    /// which no free direction leaves undetermined, and not in a vessel, whose contacts let go one by one.
    fn jumps(&mut self, [before, inputs]: [&Inputs; 2], [last, reached]: [&[f64]; 2]) -> bool {
        let distance = self.apart(reached, last);
        if self.model.around.is_some() || distance <= FAR * self.model.chain.radian_norm() {
            return false;
        }

        self.aside(|search| {
            let (mut near, mut far) = (last.to_vec(), reached.to_vec());
            let (mut from, mut to) = (0.0, 1.0);
            for _ in 0..HALVINGS {
                let middle = 0.5 * (from + to);
                let (here, mut shape) = (before.between(inputs, middle), far.clone());
                let minimum = search.go_downhill(&here, &mut shape, ROUNDING);
                if !minimum.converged || !search.is_confirmed(&here, &shape) {
                    return false;
                }
                if search.apart(&shape, &near) <= search.apart(&shape, &far) {
                    (near, from) = (shape, middle);
                } else {
                    (far, to) = (shape, middle);
                }
            }
            search.apart(&far, &near) > JUMP * distance
                && !search.has_drifted(inputs, last, reached, DRIFTED * distance)
        })
    }

    /// Whether overdamped motion from `last` ends within `reach` of it at a shape as low as `reached`. Then the branch
    /// continues there, and the descent has drifted along a neutral direction.
    fn has_drifted(&mut self, inputs: &Inputs, last: &[f64], reached: &[f64], reach: f64) -> bool {
        if !self.potential(inputs).terms.have_potential() {
            return false;
        }
        let mut settled = last.to_vec();
        let region = self.region(PASSING);
        let deadline = self.deadline;
        settle(&mut self.potential(inputs), &mut settled, &region, || !deadline.has_passed());
        if self.apart(&settled, last) > reach {
            return false;
        }
        let unit = self.model.chain.radian_norm();
        let mut potential = self.potential(inputs);
        let energies = potential.slope(&settled).zip(potential.slope(reached));
        energies.is_some_and(|(settled, reached)| settled - reached <= SAME_ENERGY * unit * unit)
    }

    /// Distance of two shapes in the elastic energy norm.
    pub(super) fn apart(&self, a: &[f64], b: &[f64]) -> f64 {
        distance(self.model.metric, a, b)
    }

    fn region(&self, tolerance: f64) -> Region {
        let unit = self.model.chain.radian_norm();
        Region {
            radius: FIRST_RADIUS * unit,
            largest: unit,
            tolerance: tolerance * unit,
            iterations: self.left(),
        }
    }
}

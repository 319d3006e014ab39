//! Beyond the end of a branch: downhill to the next stable shape, and whether that was a snap.

use super::correction::{End, FREE, NEARLY, Walk, measure};
use super::inputs::Inputs;
use crate::numerics::pseudo_transient::settle;
use crate::numerics::trust_region::{Minimum, Objective, Region, minimise, norm, spread};

/// First radius of the trust region past a fold, in the chain's unit: small, so that the descent is followed.
const FIRST_RADIUS: f64 = 0.1;

/// Part of the distance of a descent within which its way back leads to the start where the branch has not been left.
const RETURNED: f64 = 0.5;

/// Energy that a snap over some distance sets free at least, of the elastic energy of that distance. From a fold to a minimum of
/// margin `m` it is `m/12` in a quartic potential; along a neutral branch, where a shape may drift, it is rounding.
const RELEASED: f64 = 1e-3;

/// Residual (in the chain's unit) at which a descent on the way ends: a nearly neutral valley is not followed to its bottom
/// before the inputs have come to rest.
pub(super) const PASSING: f64 = 1e-5;

/// A push (in the chain's unit) off an unstable shape that is in balance.
const PUSH: f64 = 1e-3;

impl Walk<'_> {
    /// Downhill from a shape at `before` to the next stable one at `inputs`, as [`Walk::descend`]; counts a snap where the branch
    /// has been left.
    pub(super) fn descend_from(
        &mut self,
        [before, inputs]: [&Inputs; 2],
        unknowns: &mut [f64],
        tolerance: f64,
    ) -> End {
        let last = unknowns.to_vec();
        let end = self.descend(inputs, unknowns, tolerance);
        if matches!(end, End::Held | End::Neutral) && self.has_left(before, inputs, &last, unknowns) {
            self.report.snaps += 1;
        }
        end
    }

    /// Downhill to the next stable shape, until Newton's method takes over at the residual `tolerance` (in the chain's unit).
    pub(super) fn descend(&mut self, inputs: &Inputs, unknowns: &mut [f64], tolerance: f64) -> End {
        let unit = self.scene.chain.unit();
        let mut reached = unknowns.to_vec();
        let mut minimum = self.go_downhill(inputs, &mut reached, tolerance);
        let conservative = self.potential(inputs).conservative();
        if !conservative && minimum.converged && !self.is_confirmed(inputs, &reached) {
            // In balance without being stable: a potential's descent leaves such a shape by itself.
            spread(&self.scene.chain.metric, &mut reached, PUSH * unit);
            minimum = self.go_downhill(inputs, &mut reached, tolerance);
        }
        let residual = minimum.residual / unit;
        self.report.residual = residual;
        if !minimum.converged {
            return if residual <= NEARLY { End::Neutral } else { End::Lost };
        }
        let mut corrected = reached.clone();
        let end = if self.correct(inputs, &mut corrected, self.scene.settings.follow_step).is_some() {
            reached = corrected;
            End::Held
        } else if !conservative && self.diverges(inputs, &reached) {
            End::Lost
        } else {
            self.report.residual = residual;
            End::Neutral
        };
        unknowns.copy_from_slice(&reached);
        end
    }

    /// Whether the damped motion leaves this shape in balance: without a potential it may circle around it for ever.
    fn diverges(&mut self, inputs: &Inputs, unknowns: &[f64]) -> bool {
        let mut potential = self.potential(inputs);
        let regular = potential.linearise(unknowns).is_some() && potential.factorise(0.0);
        regular && measure(&mut potential) < -FREE
    }

    fn is_confirmed(&mut self, inputs: &Inputs, unknowns: &[f64]) -> bool {
        let mut corrected = unknowns.to_vec();
        self.correct(inputs, &mut corrected, NEARLY).is_some()
    }

    fn go_downhill(&mut self, inputs: &Inputs, unknowns: &mut [f64], tolerance: f64) -> Minimum {
        self.choose_rules(inputs, unknowns);
        let (unit, deadline) = (self.scene.chain.unit(), self.deadline);
        let region = Region {
            radius: FIRST_RADIUS * unit,
            largest: unit,
            tolerance: tolerance * unit,
            iterations: self.left(),
        };
        let mut potential = self.potential(inputs);
        let proceed = || !deadline.has_passed();
        let minimum = if potential.conservative() {
            minimise(&mut potential, unknowns, &region, proceed)
        } else {
            settle(&mut potential, unknowns, &region, proceed)
        };
        self.report.iterations += minimum.iterations;
        minimum
    }

    /// Whether a descent from the shape `last`, at `before`, has led to another branch: a branch that goes on, however
    /// steeply, leads back when the inputs do, and what has come down stays down.
    fn has_left(&mut self, before: &Inputs, inputs: &Inputs, last: &[f64], reached: &[f64]) -> bool {
        let metric = &self.scene.chain.metric;
        let apart = |a: &[f64], b: &[f64]| {
            let between: Vec<f64> = a.iter().zip(b).map(|(a, b)| a - b).collect();
            norm(metric, &between)
        };
        let distance = apart(reached, last);
        if distance <= NEARLY * self.scene.chain.unit() {
            return false;
        }
        let (residual, energy) = (self.report.residual, self.report.energy);
        let mut back = reached.to_vec();
        self.go_downhill(before, &mut back, PASSING);
        let mut potential = self.potential(before);
        let (start, end) = (potential.slope(last), potential.slope(&back));
        let released = !potential.conservative()
            || start.zip(end).is_none_or(|(start, end)| start - end > RELEASED * distance * distance);
        let left = released && apart(&back, last) > RETURNED * distance;
        // What is read from the solved shape must be that of its own inputs; its factorisation is gone.
        self.choose_rules(inputs, reached);
        let again = self.potential(inputs).chord_slope(reached).is_some();
        self.work.factored = false;
        (self.report.residual, self.report.energy) = (residual, energy);
        left || !again
    }
}

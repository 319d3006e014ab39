//! Transfer of a shape from one model of a design to another, and the tip deviation of the two.

use serde::{Deserialize, Serialize};

use super::solution::Solution;
use super::solver::Equilibrium;
use crate::equilibrium::model::{Chain, Inputs};
use crate::geometry::{Pose, rotation_log};
use crate::numerics::trust_region::{Objective, norm};

/// Longest Newton step, in the radian norm, whose end still counts as an estimate of the equilibrium.
pub(crate) const NEAR: f64 = 1.0;

/// Softness above which the response to a difference is not linear, and the largest ratio of two steps from which the rest is extrapolated.
pub(crate) const SOFT: f64 = 2.0;
pub(crate) const DIVERGING: f64 = 0.8;

/// Tip deviation: distance and angle between two tips.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct TipDeviation {
    /// Distance of the tips, m.
    pub distance: f64,
    /// Angle of the relative rotation, rad.
    pub angle: f64,
}

impl Equilibrium {
    /// Adopts the shape of another model of the same design as if it had been solved at `inputs`; the history is
    /// forgotten.
    ///
    /// The next solve corrects the difference of the two models.
    pub fn adopt(&mut self, other: &Self, unknowns: &[f64], inputs: &Inputs) {
        self.reset();
        if let (Some(own), Some(other)) = (&mut self.contact, &other.contact) {
            own.friction.take_over(&other.friction);
        }
        self.branch.unknowns = transferred(&self.chain, &other.chain, unknowns);
        self.branch.inputs = Some(inputs.clone());
    }

    /// Deviation of the last solved shape of another model of the same design from an equilibrium of this one, estimated
    /// by one Newton step of this model. The branch of this model is forgotten: it is left at the end of that step.
    ///
    /// `None` if nothing is solved yet, if the step is too long for an estimate, or if this model is not stable there.
    pub fn deviation_of(&mut self, other: &Self) -> Option<TipDeviation> {
        let inputs = other.branch.inputs.clone()?;
        self.adopt(other, other.unknowns(), &inputs);
        let mut unknowns = std::mem::take(&mut self.branch.unknowns);
        let mut potential = self.potential(&inputs, &unknowns);
        let stable =
            potential.linearise(&unknowns).is_some() && potential.factorise(0.0) && potential.is_stable();
        let mut step: Vec<f64> = potential.gradient().iter().map(|slope| -slope).collect();
        if stable {
            potential.solve(&mut step);
        }
        let first = norm(&self.metric, &step);
        let mut near = stable && first <= NEAR * self.chain.radian_norm();
        let mut growth = 1.0;
        if near {
            unknowns.iter_mut().zip(&step).for_each(|(unknown, by)| *unknown += by);
            if other.branch.softness() > SOFT {
                // What another step adds tells how much more would follow.
                let ratio =
                    self.next_step(&inputs, &unknowns, &mut step).map_or(f64::NAN, |next| next / first);
                near = ratio <= DIVERGING;
                growth = 1.0 / (1.0 - ratio);
            }
        }
        self.work.place(&self.chain, &inputs, &unknowns);
        self.branch.unknowns = unknowns;
        let deviation = || TipDeviation::between(&self.tip(), &other.tip()).times(growth);
        near.then(deviation).filter(TipDeviation::is_finite)
    }
}

impl Equilibrium {
    /// Whether the last solved shape is so soft that errors of the forces change it more than in proportion.
    #[must_use]
    pub fn is_soft(&self) -> bool {
        self.branch.softness() > SOFT
    }

    /// Length (radian norm) of a step from `unknowns` with the last factorisation, which is written to `step`.
    fn next_step(&mut self, inputs: &Inputs, unknowns: &[f64], step: &mut [f64]) -> Option<f64> {
        let mut potential = self.potential(inputs, unknowns);
        potential.slope(unknowns)?;
        step.iter_mut().zip(potential.gradient()).for_each(|(by, slope)| *by = -slope);
        potential.solve(step);
        Some(norm(&self.metric, step))
    }
}

impl Equilibrium {
    /// Distance (m) of a tip from its unloaded place at these inputs: that of the unloaded device behind as much shaft, at the same base.
    pub(crate) fn tip_travel(&self, inputs: &Inputs, tip: &Pose) -> f64 {
        let shaft = self.chain.inserted(self.chain.growth(inputs.insertion));
        let unloaded = match &self.chain.tip_at_rest {
            Some(own) => inputs.root().advanced(shaft).transform(own),
            None => inputs.base.position + inputs.base.axis() * (shaft + self.chain.length()),
        };
        (tip.position - unloaded).norm()
    }
}

impl TipDeviation {
    /// No deviation.
    pub const NONE: Self = Self { distance: 0.0, angle: 0.0 };

    /// The deviation of two poses.
    #[must_use]
    pub fn between(a: &Pose, b: &Pose) -> Self {
        let angle = rotation_log(&a.rotation.tr_mul(&b.rotation)).norm();
        Self { distance: (a.position - b.position).norm(), angle }
    }

    /// The largest factor by which `error` may be multiplied to stay within the fraction `part` of this tolerance.
    pub(crate) fn room(&self, error: &Self, part: f64) -> f64 {
        part * (self.distance / error.distance).min(self.angle / error.angle)
    }

    /// Distance and angle multiplied by a factor.
    #[must_use]
    pub(crate) fn times(self, factor: f64) -> Self {
        Self { distance: factor * self.distance, angle: factor * self.angle }
    }

    /// Upper bound of two successive deviations.
    #[must_use]
    pub(crate) fn plus(self, other: Self) -> Self {
        Self { distance: self.distance + other.distance, angle: self.angle + other.angle }
    }

    pub(crate) fn is_finite(&self) -> bool {
        self.distance.is_finite() && self.angle.is_finite()
    }
}

/// The amplitudes of the strains of another chain, or of those nearest to them.
fn transferred(to: &Chain, from: &Chain, unknowns: &[f64]) -> Vec<f64> {
    let mut out = vec![0.0; to.freedoms()];
    for (k, (own, other)) in to.elements.iter().zip(&from.elements).enumerate() {
        let (target, source) = (&mut out[to.first[k]..to.first[k + 1]], from.part(k, unknowns));
        if own.has_modes_of(other) {
            target.copy_from_slice(source);
        } else {
            own.projection(other).into_iter().for_each(|(i, j, part)| target[i] += part * source[j]);
        }
    }
    out
}

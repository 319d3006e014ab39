//! What an answer was judged to be off by, and how long that holds.

use nalgebra::{SVector, Vector3};
use serde::{Deserialize, Serialize};

use super::ladder::CLIMB;
use crate::equilibrium::{Equilibrium, Gap, Inputs};
use crate::geometry::Pose;

/// Change of what surrounds or loads the manipulator, relative to its size, after which a rung is judged again.
const CHANGED: f64 = 0.02;

/// Displacement of the tip, relative to the length, and turn of the tip (rad), after which a rung is judged again.
const MOVED: f64 = 0.02;

/// How many times as long a rung stands that is as much better than needed.
const STANDING: f64 = 5.0;

/// When a model was judged last, and its error there.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Judgement {
    inputs: Inputs,
    tip: Pose,
    field: Vector3<f64>,
    /// The error of the tip.
    pub(super) gap: Gap,
}

impl Judgement {
    /// That the last answer of `model`, at `inputs`, is off by `gap`.
    pub(super) fn new(model: &Equilibrium, inputs: &Inputs, gap: Gap) -> Self {
        let tip = model.tip();
        let field = model.field_at(inputs, &tip.position).unwrap_or_default();
        Self { inputs: inputs.clone(), tip, field, gap }
    }

    /// The same instead of an earlier one, without allocating.
    pub(super) fn renew(&mut self, model: &Equilibrium, inputs: &Inputs, gap: Gap) {
        self.inputs.copy_from(inputs);
        (self.tip, self.gap) = (model.tip(), gap);
        self.field = model.field_at(inputs, &self.tip.position).unwrap_or_default();
    }

    /// Whether enough has changed since to judge again: the better it was, beside the tolerance, the more may.
    pub(super) fn is_old(
        &self,
        model: &Equilibrium,
        inputs: &Inputs,
        (tolerance, length): (&Gap, f64),
    ) -> bool {
        let room = tolerance.room(&self.gap, CLIMB).clamp(1.0, STANDING);
        let (tip, then) = (model.tip(), &self.inputs);
        let far = |change: f64, a: f64, b: f64| change > room * CHANGED * a.max(b);
        let other = |a: &Vector3<f64>, b: &Vector3<f64>| far((a - b).norm(), a.norm(), b.norm());
        let moved = Gap::between(&tip, &self.tip);
        let [gradient, before] = [inputs, then].map(|i| SVector::from(i.field_gradient));
        let field = || model.field_at(inputs, &tip.position).unwrap_or_default();
        moved.distance > room * MOVED * length
            || moved.angle > room * MOVED
            || far((gradient - before).norm(), gradient.norm(), before.norm())
            || other(&inputs.tip_force, &then.tip_force)
            || other(&inputs.tip_moment, &then.tip_moment)
            || other(&inputs.gravity, &then.gravity)
            || inputs.ring_forces.iter().zip(&then.ring_forces).any(|(a, b)| other(a, b))
            || other(&field(), &self.field)
    }
}

//! What an answer was judged to be off by, and how long that holds.

use nalgebra::{SVector, Vector3};
use serde::{Deserialize, Serialize};

use crate::equilibrium::{Equilibrium, Inputs, Solution, TipDeviation};
use crate::geometry::Pose;

/// Part of the tolerance beyond which a cheaper model of the interaction is left.
pub(super) const CLIMB: f64 = 0.5;

/// Change of what surrounds or loads the manipulator, relative to its size, after which a model is judged again.
const CHANGED: f64 = 0.02;

/// Displacement of the tip, relative to the length, and turn of the tip (rad), after which a model is judged again.
const MOVED: f64 = 0.02;

/// How many times as long a model stands that is as much better than needed.
const STANDING: f64 = 10.0;

/// Power of the loads with which an error is taken to grow until it is judged again: that of strain modes of degree 2 grows with
/// the fourth of a small bend, with the seventh from 65 to 87 deg a core.
const GROWTH: i32 = 5;

/// When a model was judged last, and its error there.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct ErrorEstimate {
    inputs: Inputs,
    tip: Pose,
    field: Vector3<f64>,
    /// The error of the tip.
    pub(super) gap: TipDeviation,
}

impl ErrorEstimate {
    /// That the last answer of `model`, at `inputs`, is off by `gap`.
    pub(super) fn new(model: &Equilibrium, inputs: &Inputs, gap: TipDeviation) -> Self {
        let tip = model.tip();
        let field = model.field_at(inputs, &tip.position).unwrap_or_default();
        Self { inputs: inputs.clone(), tip, field, gap }
    }

    /// The same instead of an earlier one, without allocating.
    pub(super) fn renew(&mut self, model: &Equilibrium, inputs: &Inputs, gap: TipDeviation) {
        self.inputs.copy_from(inputs);
        (self.tip, self.gap) = (model.tip(), gap);
        self.field = model.field_at(inputs, &self.tip.position).unwrap_or_default();
    }

    /// How much has changed since: 1 where it is enough to judge again unless the model was much better than needed.
    pub(super) fn age(&self, model: &Equilibrium, inputs: &Inputs, length: f64) -> f64 {
        let (tip, then) = (model.tip(), &self.inputs);
        let part =
            |change: f64, a: f64, b: f64| if change == 0.0 { 0.0 } else { change / (CHANGED * a.max(b)) };
        let other = |a: &Vector3<f64>, b: &Vector3<f64>| part((a - b).norm(), a.norm(), b.norm());
        let moved = TipDeviation::between(&tip, &self.tip);
        let Inputs {
            // These change the field at the tip and its pose, which are looked at.
            magnet: _,
            magnet_strength: _,
            uniform_field: _,
            base: _,
            field_gradient,
            tip_force,
            tip_moment,
            ring_forces,
            gravity,
        } = inputs;
        let [gradient, before] = [field_gradient, &then.field_gradient].map(|g| SVector::from(*g));
        let field = model.field_at(inputs, &tip.position).unwrap_or_default();
        let changes = [
            moved.distance / (MOVED * length),
            moved.angle / MOVED,
            part((gradient - before).norm(), gradient.norm(), before.norm()),
            other(tip_force, &then.tip_force),
            other(tip_moment, &then.tip_moment),
            other(gravity, &then.gravity),
            other(&field, &self.field),
        ];
        let forces = ring_forces.iter().zip(&then.ring_forces).map(|(a, b)| other(a, b));
        changes.into_iter().chain(forces).fold(0.0, f64::max)
    }

    /// Whether that is enough to judge again: the better it was, beside the tolerance, the older it may be.
    pub(super) fn is_old(&self, age: f64, tolerance: &TipDeviation) -> bool {
        age > tolerance.room(&self.gap, CLIMB).clamp(1.0, STANDING)
    }

    /// What the error may be at that age.
    pub(super) fn error(&self, age: f64) -> TipDeviation {
        self.gap.times((1.0 + CHANGED * age).powi(GROWTH))
    }
}

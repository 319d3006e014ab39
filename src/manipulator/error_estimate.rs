//! The error estimate of a model, and for how long it remains valid.

use nalgebra::{SVector, Vector3};
use serde::{Deserialize, Serialize};

use crate::equilibrium::{DiscretisationError, Equilibrium, Inputs, Solution, TipDeviation};
use crate::geometry::Pose;

/// Fraction of the tolerance above which a cheaper interaction model is left.
pub(super) const CLIMB: f64 = 0.5;

/// Relative change of the field or of a load after which the error is estimated again.
const CHANGED: f64 = 0.02;

/// Tip displacement, relative to the length, and tip rotation (rad) after which the error is estimated again.
const MOVED: f64 = 0.02;

/// Largest factor by which the interval between error estimates is extended when the error is far below the tolerance.
const STANDING: f64 = 10.0;

/// Power of the bend with which the error is assumed to grow between two estimates at the same loads: that of strain modes of degree
/// 2 grows with the fourth power of a small bending angle, with the seventh from 65 to 87 deg per core.
const GROWTH: i32 = 4;

/// Age from which on an estimate is made anew because quadrature rules have changed: where two rules meet, they may alternate.
const OF_OTHER_RULES: f64 = 1.0;

/// Safety factor on the deviation from a finer discretisation, which is of first order and whose strain modes are themselves not
/// converged. The example `estimate` records how often this covers the error.
const SAFETY: f64 = 2.0;

/// Estimated error of a model: the part that grows with loads and bend, and a bound that does not.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct ModelError {
    growing: TipDeviation,
    bound: TipDeviation,
}

impl ModelError {
    /// That of a model whose deviation from a richer one is known.
    pub(super) fn of_model(deviation: TipDeviation) -> Self {
        Self { growing: deviation, bound: TipDeviation::NONE }
    }

    /// That of a discretisation.
    pub(super) fn of_discretisation(error: &DiscretisationError) -> Self {
        Self { growing: error.seen.times(SAFETY), bound: error.unseen }
    }

    /// With the deviation from a richer model, whose own error this is.
    pub(super) fn beside(self, deviation: TipDeviation) -> Self {
        Self { growing: self.growing.plus(deviation), ..self }
    }

    pub(super) fn total(&self) -> TipDeviation {
        self.growing.plus(self.bound)
    }
}

/// The last error estimate of a model, with the inputs, tip pose and field it was made at.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct ErrorEstimate {
    inputs: Inputs,
    tip: Pose,
    field: Vector3<f64>,
    /// Fraction of closed windings of each core, whether or not the model has the bending stop; empty if none has.
    closed: Vec<f64>,
    /// Bend of the cores, see [`bend`].
    bend: f64,
    /// Which quadrature rules the model had: those that follow one another may err in opposite directions.
    rules: u32,
    /// Estimated error of the tip pose.
    error: ModelError,
    /// Whether the shape was soft, so that its error changes faster.
    soft: bool,
}

impl ErrorEstimate {
    /// Records the estimated error of the last solution of `model`, at `inputs`.
    ///
    /// `stops` tells whether a model of the hierarchy has the bending stop.
    pub(super) fn new(model: &Equilibrium, inputs: &Inputs, error: ModelError, stops: bool) -> Self {
        let tip = model.tip();
        Self {
            inputs: inputs.clone(),
            tip,
            field: model.field_at(inputs, &tip.position).unwrap_or_default(),
            closed: model.closed_windings().filter(|_| stops).collect(),
            bend: bend(model),
            rules: model.quadrature_fingerprint(),
            error,
            soft: model.is_soft(),
        }
    }

    /// Replaces the estimate by a new one without allocating.
    pub(super) fn renew(&mut self, model: &Equilibrium, inputs: &Inputs, error: ModelError) {
        self.inputs.copy_from(inputs);
        (self.tip, self.error, self.soft) = (model.tip(), error, model.is_soft());
        (self.bend, self.rules) = (bend(model), model.quadrature_fingerprint());
        self.field = model.field_at(inputs, &self.tip.position).unwrap_or_default();
        self.closed.iter_mut().zip(model.closed_windings()).for_each(|(own, now)| *own = now);
    }

    /// Change since the estimate, in units of the change that calls for a new one (for an error close to the tolerance).
    pub(super) fn age(&self, model: &Equilibrium, inputs: &Inputs, length: f64) -> f64 {
        let (tip, then) = (model.tip(), &self.inputs);
        let part =
            |change: f64, a: f64, b: f64| if change == 0.0 { 0.0 } else { change / (CHANGED * a.max(b)) };
        let other = |a: &Vector3<f64>, b: &Vector3<f64>| part((a - b).norm(), a.norm(), b.norm());
        let moved = TipDeviation::between(&tip, &self.tip);
        let Inputs {
            // These act through the field at the tip and the tip pose, which are compared below.
            sources: _,
            uniform_field: _,
            base: _,
            insertion: _,
            feed_force: _,
            roll: _,
            guidewire_insertion,
            field_gradient,
            tip_force,
            tip_moment,
            ring_forces,
            gravity,
            widening: _, // both are 0 at every solved shape
            softening: _,
        } = inputs;
        let [gradient, before] = [field_gradient, &then.field_gradient].map(|g| SVector::from(*g));
        let field = model.field_at(inputs, &tip.position).unwrap_or_default();
        let changes = [
            moved.distance / (MOVED * length),
            moved.angle / MOVED,
            (guidewire_insertion - then.guidewire_insertion).abs() / (MOVED * length),
            part((gradient - before).norm(), gradient.norm(), before.norm()),
            other(tip_force, &then.tip_force),
            other(tip_moment, &then.tip_moment),
            other(gravity, &then.gravity),
            other(&field, &self.field),
        ];
        let forces = ring_forces.iter().zip(&then.ring_forces).map(|(a, b)| other(a, b));
        // A stiffness that appears within a few degrees is missing from a cheaper model all at once.
        let stops =
            model.closed_windings().zip(&self.closed).map(|(now, then)| part((now - then).abs(), now, *then));
        changes.into_iter().chain(forces).chain(stops).fold(0.0, f64::max)
    }

    /// Distance of the tip from its unloaded place when the estimate was made, m; `model` is any of the device.
    pub(super) fn tip_travel(&self, model: &Equilibrium) -> f64 {
        model.tip_travel(&self.inputs, &self.tip)
    }

    /// Whether a new estimate is due at that age: the smaller the error relative to the tolerance, the older it may be, unless the
    /// shape is soft.
    pub(super) fn is_old(&self, age: f64, tolerance: &TipDeviation) -> bool {
        let standing = if self.soft { 1.0 } else { STANDING };
        age > tolerance.room(&self.error.total(), CLIMB).clamp(1.0, standing)
    }

    /// Whether it was made with other quadrature rules than those of `model` now, and is not recent.
    pub(super) fn is_of_other_rules(&self, age: f64, model: &Equilibrium) -> bool {
        age > OF_OTHER_RULES && self.rules != model.quadrature_fingerprint()
    }

    /// The error extrapolated to that age and to the present bend of `model`.
    ///
    /// At the same bend the error follows the loads, whose change is the age. It grows where the bend grows, by no more than
    /// a bend in proportion to that change would give, as a shape near the straight one bends by many times its little bend.
    pub(super) fn error(&self, age: f64, model: &Equilibrium) -> TipDeviation {
        let change = 1.0 + CHANGED * age;
        let bend = bend(model);
        let growth = if bend > self.bend { (bend / self.bend).min(change.powi(GROWTH)) } else { 1.0 };
        self.error.growing.times(change * growth).plus(self.error.bound)
    }
}

/// Sum of the powers of the cores' bends with which their errors grow.
fn bend(model: &Equilibrium) -> f64 {
    model.core_angles().map(|angle| angle.powi(GROWTH)).sum()
}

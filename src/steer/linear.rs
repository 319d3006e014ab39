//! Derivatives of the target's errors and of the limits.

use nalgebra::{DMatrix, DVector};

use super::aim::Aim;
use super::bounds::Bound;
use super::constants::RANK;
use super::moves::Freedom;
use super::state::State;
use super::target::Target;
use crate::error::Error;

/// Derivatives that may serve for several steps: those of the target's errors and the limits, at the freedoms of some inputs.
#[derive(Debug, Clone)]
pub(super) struct Linear {
    pub(super) rates: DMatrix<f64>,
    pub(super) freedoms: Vec<Freedom>,
    pub(super) bounds: Vec<Bound>,
    /// Whether they are those of the present state.
    pub(super) exact: bool,
    /// The target whose errors they belong to, but for its numbers.
    kind: [bool; 4],
}

impl Linear {
    /// Exact ones.
    pub(super) fn at(state: &State, aim: &Aim<'_>) -> Result<Self, Error> {
        let Aim { target, tolerances, rules } = aim;
        let freedoms = state.freedoms(rules);
        let jacobian = state.manipulator.jacobian()?;
        let outputs = state.outputs();

        let rates = target.rates(&jacobian, outputs, tolerances, &freedoms);
        let mut bounds = rules.bodies.bounds(&rules.limits, &state.inputs, outputs, &jacobian, &freedoms);
        bounds.extend(state.margin_bound(rules, &freedoms)?);
        Ok(Self { rates, freedoms, bounds, exact: true, kind: kind(target) })
    }

    /// Whether these are derivatives of what this target asks for.
    pub(super) fn is_of(&self, target: &Target) -> bool {
        self.kind == kind(target)
    }

    /// What is left of these errors after a step.
    pub(super) fn left(&self, errors: &DVector<f64>, step: &DVector<f64>) -> DVector<f64> {
        errors - &self.rates * step
    }

    /// The part of a direction of the freedoms that changes none of the target's errors; `None` where nothing of it is left.
    pub(super) fn free(&self, direction: &DVector<f64>) -> Option<DVector<f64>> {
        let decomposed = self.rates.clone().svd(false, true);
        let least = RANK * decomposed.singular_values.max();
        let mut out = direction.clone();
        for (value, row) in decomposed.singular_values.iter().zip(decomposed.v_t?.row_iter()) {
            if *value > least {
                let along = row.transpose();
                out -= &along * along.dot(direction);
            }
        }
        (out.norm() > RANK * direction.norm()).then_some(out)
    }

    /// Takes note of what a step has brought (Broyden 1965, doi 10.1090/S0025-5718-1965-0198670-6).
    pub(super) fn learn(&mut self, step: &DVector<f64>, taken: &DVector<f64>) {
        let missed = taken - &self.rates * step;
        self.rates += missed * step.transpose() / step.norm_squared();
        for bound in &mut self.bounds {
            bound.slack += bound.gradient.dot(step);
        }
        self.exact = false;
    }
}

/// What a target asks for.
fn kind(target: &Target) -> [bool; 4] {
    let Target { position, direction, angle, force } = target;
    [position.is_some(), direction.is_some(), angle.is_some(), force.is_some()]
}

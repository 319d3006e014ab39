//! What a walk is after.

use nalgebra::DVector;

use super::state::{Rules, State};
use super::target::{Target, Tolerances};

/// A target, how near counts as reached, and what every step on the way keeps to.
#[derive(Debug, Clone, Copy)]
pub(super) struct Aim<'a> {
    pub(super) target: &'a Target,
    pub(super) tolerances: &'a Tolerances,
    pub(super) rules: &'a Rules,
}

impl Aim<'_> {
    /// What is missing at a state, in tolerances.
    pub(super) fn errors(&self, state: &State) -> DVector<f64> {
        self.target.errors(state.outputs(), self.tolerances)
    }

    /// The largest part of it: reached up to 1.
    pub(super) fn misfit(&self, state: &State) -> f64 {
        self.target.misfit(state.outputs(), self.tolerances)
    }
}

//! Everything that changes in an instance's life: what a saved state keeps.

use std::sync::Arc;

use super::given::Given;
use super::rates::Rates;
use super::state::State;
use crate::manipulator::{Jacobian, Manipulator};

/// Where an instance stands, with all that its answers depend on.
#[derive(Debug, Clone)]
pub(super) struct Condition {
    pub(super) state: State,
    pub(super) given: Given,
    /// Time derivatives of the inputs.
    pub(super) rates: Rates,
    /// The manipulator that the parameters describe, once it is needed.
    pub(super) device: Option<Manipulator>,
    /// The device's derivatives where it is solved, once they are needed.
    pub(super) jacobian: Option<Arc<Jacobian>>,
    /// Whether the device's outputs are those of `given`.
    pub(super) solved: bool,
    /// Whether it was solved for a reading host since the last step, so that the next step finds its work done.
    pub(super) ahead: bool,
    pub(super) near_fold: bool,
    /// Jumps until the last communication point.
    pub(super) snaps: u32,
    pub(super) time: f64,
    pub(super) stop: Option<f64>,
}

impl Condition {
    /// Freshly instantiated.
    pub(super) fn new(start: &Given) -> Self {
        Self {
            state: State::Instantiated,
            given: start.clone(),
            rates: Rates::default(),
            device: None,
            jacobian: None,
            solved: false,
            ahead: false,
            near_fold: false,
            snaps: 0,
            time: 0.0,
            stop: None,
        }
    }
}

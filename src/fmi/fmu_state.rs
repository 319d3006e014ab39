//! The FMU state: everything about an instance that changes, and that `fmi2GetFMUstate` therefore saves.

use std::sync::Arc;

use super::host_values::HostValues;
use super::input_derivatives::InputDerivatives;
use super::state::State;
use crate::manipulator::{Jacobian, Manipulator};

/// The FMU state of an instance.
#[derive(Debug, Clone)]
pub(super) struct FmuState {
    /// State of the calling sequence.
    pub(super) state: State,
    /// Inputs and parameters as the host has set them.
    pub(super) host_values: HostValues,
    /// Time derivatives of the inputs.
    pub(super) input_derivatives: InputDerivatives,
    /// The manipulator that the parameters describe; built when it is first needed.
    pub(super) manipulator: Option<Manipulator>,
    /// Derivatives of the manipulator's outputs at its present equilibrium; computed when they are first needed.
    pub(super) jacobian: Option<Arc<Jacobian>>,
    /// Whether the manipulator's outputs are those of the present host values.
    pub(super) solved: bool,
    /// Whether the equilibrium for the next communication point has been found already, because the host read outputs
    /// after setting inputs. The step then need not solve again.
    pub(super) solved_ahead: bool,
    /// Whether the last equilibrium was near a fold: the log tells of the approach once, not at every step.
    pub(super) near_fold: bool,
    /// In model exchange: the equilibrium of the last step that the host has accepted. Whatever inputs the host tries, the search
    /// starts from there, so that no value depends on what else was tried.
    pub(super) accepted: Option<Manipulator>,
    /// In model exchange: whether no equilibrium was found for the inputs now set.
    pub(super) unsolvable: bool,
    /// Snaps to another branch from initialisation to the last communication point, or to the last accepted step.
    pub(super) snaps: u32,
    /// Time of the last communication point, or as the host has set it, s.
    pub(super) time: f64,
}

impl FmuState {
    /// The FMU state of an instance that was just instantiated or reset.
    pub(super) fn new(start: &HostValues) -> Self {
        Self {
            state: State::Instantiated,
            host_values: start.clone(),
            input_derivatives: InputDerivatives::default(),
            manipulator: None,
            jacobian: None,
            solved: false,
            solved_ahead: false,
            near_fold: false,
            accepted: None,
            unsolvable: false,
            snaps: 0,
            time: 0.0,
        }
    }
}

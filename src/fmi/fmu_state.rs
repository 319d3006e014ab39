//! The FMU state: everything about an instance that changes, and that `fmi2GetFMUstate` therefore saves.

use std::collections::BTreeSet;
use std::sync::Arc;

use serde::{Deserialize, Serialize};

use super::host_values::HostValues;
use super::input_derivatives::InputDerivatives;
use super::state::State;
use crate::manipulator::{Jacobian, Manipulator};

/// What is known of an equilibrium.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub(super) enum Search {
    /// It was not sought yet.
    Open,
    /// It was found: the manipulator's outputs are those of it.
    Found,
    /// There is none, which the host can answer by other inputs.
    InVain,
    /// It is not sought, as the host values are not allowed together; with the reason.
    Refused(String),
}

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
    /// What is known of the equilibrium for the present host values.
    pub(super) search: Search,
    /// Variables to which the host wanted to give a value that was not taken, by value reference: they keep the value before, and
    /// nothing is solved until each has got one that is allowed.
    pub(super) refused: BTreeSet<u32>,
    /// Whether the equilibrium for the next communication point has been found already, because the host read outputs
    /// after setting inputs. The step then need not solve again.
    pub(super) solved_ahead: bool,
    /// Whether the last equilibrium was near a fold: the log tells of the approach once, not at every step.
    pub(super) near_fold: bool,
    /// In model exchange: the equilibrium of the last step that the host has accepted. Whatever inputs the host tries, the search
    /// starts from there, so that no value depends on what else was tried.
    pub(super) accepted: Option<Manipulator>,
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
            search: Search::Open,
            refused: BTreeSet::new(),
            solved_ahead: false,
            near_fold: false,
            accepted: None,
            snaps: 0,
            time: 0.0,
        }
    }
}

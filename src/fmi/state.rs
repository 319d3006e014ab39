//! Which call is allowed when.

use serde::{Deserialize, Serialize};

use super::variable::Role;

/// How a call ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ending {
    /// Done; what is worth knowing beside it stands in the log, in `solver.status` and in `stability.snaps`. The standard's
    /// `fmi2Warning` is never answered: `OMSimulator` and `PyFMI` take every status but `fmi2OK` for a failure.
    Ok,
    /// Not answered; nothing has changed.
    Discard,
    /// Refused or failed; the log says why.
    Error,
}

/// Where an instance stands in its life.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum State {
    /// Made, or reset.
    Instantiated,
    /// Between entering and leaving initialisation.
    Initialization,
    /// At a communication point.
    Stepping,
    /// An equilibrium was not found: the last good one, if there is any, can be read.
    Failed,
    /// Terminated.
    Terminated,
    /// A panic was caught.
    Broken,
}

/// The calls of the interface that depend on the state.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(missing_docs, reason = "each is the function of the standard with that name")]
pub enum Call {
    SetDebugLogging,
    SetupExperiment,
    EnterInitializationMode,
    ExitInitializationMode,
    Terminate,
    Reset,
    Get,
    Set,
    GetFmuState,
    SetFmuState,
    FreeFmuState,
    SerializeFmuState,
    GetDirectionalDerivative,
    SetRealInputDerivatives,
    GetRealOutputDerivatives,
    DoStep,
    GetStatus,
    /// What only an unfinished step allows: steps are finished when they return.
    CancelStep,
}

use State::{Broken, Failed, Initialization, Instantiated, Stepping, Terminated};

const UNBROKEN: &[State] = &[Instantiated, Initialization, Stepping, Failed, Terminated];

/// The table: the states in which each call is answered.
pub const ALLOWED: &[(Call, &[State])] = &[
    (Call::SetDebugLogging, UNBROKEN),
    (Call::SetupExperiment, &[Instantiated]),
    (Call::EnterInitializationMode, &[Instantiated]),
    (Call::ExitInitializationMode, &[Initialization]),
    (Call::Terminate, &[Stepping, Failed]),
    (Call::Reset, &[Instantiated, Initialization, Stepping, Failed, Terminated, Broken]),
    (Call::Get, &[Initialization, Stepping, Failed, Terminated]),
    (Call::Set, &[Instantiated, Initialization, Stepping]),
    (Call::GetFmuState, UNBROKEN),
    (Call::SetFmuState, UNBROKEN),
    (Call::FreeFmuState, UNBROKEN),
    (Call::SerializeFmuState, UNBROKEN),
    (Call::GetDirectionalDerivative, &[Initialization, Stepping, Failed, Terminated]),
    (Call::SetRealInputDerivatives, &[Instantiated, Initialization, Stepping]),
    (Call::GetRealOutputDerivatives, &[Stepping, Failed, Terminated]),
    (Call::DoStep, &[Stepping]),
    (Call::GetStatus, &[Stepping, Failed, Terminated]),
    (Call::CancelStep, &[]),
];

impl State {
    /// Whether `call` is answered in this state.
    #[must_use]
    pub fn allows(self, call: Call) -> bool {
        ALLOWED.iter().any(|(allowed, states)| *allowed == call && states.contains(&self))
    }

    /// Whether a variable in `role` may be set in this state.
    #[must_use]
    pub fn may_set(self, role: Role) -> bool {
        match role {
            Role::Input | Role::Tunable => self.allows(Call::Set),
            Role::Fixed => matches!(self, Instantiated | Initialization),
            Role::Constant | Role::Output => false,
        }
    }
}

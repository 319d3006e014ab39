//! The states of the calling sequence, and which call is allowed in which state (FMI 2.0.4, section 4.2.4).

use serde::{Deserialize, Serialize};

use super::variable::{Causality, Variability};

/// How a call ended: the `fmi2Status` that it returns.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ending {
    /// The call succeeded. What else the user should know is in the log, in `solver.status` and in `stability.snaps`. The
    /// standard's `fmi2Warning` is never returned: `OMSimulator` and `PyFMI` take every status but `fmi2OK` for a failure.
    Ok,
    /// The call was not answered, and nothing has changed.
    Discard,
    /// The call was refused or failed; the log says why.
    Error,
}

/// A state of the calling sequence.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum State {
    /// After instantiation or a reset.
    Instantiated,
    /// In initialisation mode.
    Initialization,
    /// At a communication point, ready for the next step.
    Stepping,
    /// No equilibrium was found. If one was found before, its outputs can still be read.
    Failed,
    /// After termination.
    Terminated,
    /// After a panic inside the library: only a reset or freeing the instance is allowed.
    Broken,
}

/// The calls of the interface that are allowed in some states only.
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
    /// Never allowed: a step is finished when `fmi2DoStep` returns, so that there is none to cancel.
    CancelStep,
}

use State::{Broken, Failed, Initialization, Instantiated, Stepping, Terminated};

const UNBROKEN: &[State] = &[Instantiated, Initialization, Stepping, Failed, Terminated];

/// The states in which each call is allowed.
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
    /// When it is, for messages.
    #[must_use]
    pub fn in_words(self) -> &'static str {
        match self {
            Instantiated => "before initialisation",
            Initialization => "in initialisation mode",
            Stepping => "between communication steps",
            Failed => "after a failed solve",
            Terminated => "after termination",
            Broken => "after an internal failure",
        }
    }

    /// Whether `call` is allowed in this state.
    #[must_use]
    pub fn allows(self, call: Call) -> bool {
        ALLOWED.iter().any(|(allowed, states)| *allowed == call && states.contains(&self))
    }

    /// Whether variables of this causality and variability may be set in this state.
    #[must_use]
    pub fn may_set(self, causality: Causality, variability: Variability) -> bool {
        match (causality, variability) {
            (Causality::Input, _) | (Causality::Parameter, Variability::Tunable) => self.allows(Call::Set),
            (Causality::Parameter, _) => matches!(self, Instantiated | Initialization),
            (Causality::Output | Causality::Local, _) => false,
        }
    }
}

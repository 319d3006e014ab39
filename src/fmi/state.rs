//! The states of the calling sequence, and which call is allowed in which state (FMI 2.0.4, sections 3.2.3 and 4.2.4).

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

/// The two ways to use an FMU. Both give the same values and derivatives.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Interface {
    /// The FMU steps through time, and its shape follows from one communication point to the next.
    CoSimulation,
    /// The host steps through time; between the steps that it accepts it asks for values at any inputs.
    ModelExchange,
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
    /// In event mode, where the host may change everything that may change.
    Event,
    /// In continuous-time mode.
    ContinuousTime,
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
    EnterEventMode,
    NewDiscreteStates,
    EnterContinuousTimeMode,
    CompletedIntegratorStep,
    SetTime,
    /// To set continuous states, of which there are none.
    SetContinuousStates,
    /// To read continuous states, their derivatives and nominal values, or event indicators, of which there are none.
    GetContinuousStates,
}

use State::{Broken, ContinuousTime, Event, Failed, Initialization, Instantiated, Stepping, Terminated};

const UNBROKEN: &[State] =
    &[Instantiated, Initialization, Stepping, Event, ContinuousTime, Failed, Terminated];

/// Where outputs can be read.
const READABLE: &[State] = &[Initialization, Stepping, Event, ContinuousTime, Failed, Terminated];

/// The states in which each call is allowed.
pub const ALLOWED: &[(Call, &[State])] = &[
    (Call::SetDebugLogging, UNBROKEN),
    (Call::SetupExperiment, &[Instantiated]),
    (Call::EnterInitializationMode, &[Instantiated]),
    (Call::ExitInitializationMode, &[Initialization]),
    (Call::Terminate, &[Stepping, Event, ContinuousTime, Failed]),
    (
        Call::Reset,
        &[Instantiated, Initialization, Stepping, Event, ContinuousTime, Failed, Terminated, Broken],
    ),
    (Call::Get, READABLE),
    (Call::Set, &[Instantiated, Initialization, Stepping, Event, ContinuousTime]),
    (Call::GetFmuState, UNBROKEN),
    (Call::SetFmuState, UNBROKEN),
    (Call::FreeFmuState, UNBROKEN),
    (Call::SerializeFmuState, UNBROKEN),
    (Call::GetDirectionalDerivative, READABLE),
    (Call::SetRealInputDerivatives, &[Instantiated, Initialization, Stepping]),
    (Call::GetRealOutputDerivatives, &[Stepping, Failed, Terminated]),
    (Call::DoStep, &[Stepping]),
    (Call::GetStatus, &[Stepping, Failed, Terminated]),
    (Call::CancelStep, &[]),
    (Call::EnterEventMode, &[ContinuousTime]),
    (Call::NewDiscreteStates, &[Event]),
    (Call::EnterContinuousTimeMode, &[Event]),
    (Call::CompletedIntegratorStep, &[ContinuousTime]),
    (Call::SetTime, &[Event, ContinuousTime]),
    (Call::SetContinuousStates, &[ContinuousTime]),
    (Call::GetContinuousStates, &[Initialization, Event, ContinuousTime, Failed, Terminated]),
];

impl Call {
    /// The interface that a call belongs to; `None` if both have it.
    #[must_use]
    pub fn interface(self) -> Option<Interface> {
        match self {
            Self::SetRealInputDerivatives
            | Self::GetRealOutputDerivatives
            | Self::DoStep
            | Self::GetStatus
            | Self::CancelStep => Some(Interface::CoSimulation),
            Self::EnterEventMode
            | Self::NewDiscreteStates
            | Self::EnterContinuousTimeMode
            | Self::CompletedIntegratorStep
            | Self::SetTime
            | Self::SetContinuousStates
            | Self::GetContinuousStates => Some(Interface::ModelExchange),
            _ => None,
        }
    }
}

impl Interface {
    /// What an instance of it is for, in messages.
    #[must_use]
    pub fn in_words(self) -> &'static str {
        match self {
            Self::CoSimulation => "co-simulation",
            Self::ModelExchange => "model exchange",
        }
    }
}

impl State {
    /// When it is, for messages.
    #[must_use]
    pub fn in_words(self) -> &'static str {
        match self {
            Instantiated => "before initialisation",
            Initialization => "in initialisation mode",
            Stepping => "between communication steps",
            Event => "in event mode",
            ContinuousTime => "in continuous-time mode",
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

    /// The interface that has this state; `None` if both have it.
    #[must_use]
    pub fn interface(self) -> Option<Interface> {
        match self {
            Stepping => Some(Interface::CoSimulation),
            Event | ContinuousTime => Some(Interface::ModelExchange),
            _ => None,
        }
    }

    /// Whether variables of this causality and variability may be set in this state.
    #[must_use]
    pub fn may_set(self, causality: Causality, variability: Variability) -> bool {
        match (causality, variability) {
            (Causality::Input, Variability::Continuous) => self.allows(Call::Set),
            // In continuous-time mode everything else stays as it is (FMI 2.0.4, section 3.2.3).
            (Causality::Input, _) | (Causality::Parameter, Variability::Tunable) => {
                self != ContinuousTime && self.allows(Call::Set)
            }
            (Causality::Parameter, _) => matches!(self, Instantiated | Initialization),
            (Causality::Output | Causality::Local, _) => false,
        }
    }
}

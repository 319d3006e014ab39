//! The table of allowed calls, against the tables of the standard (sections 3.2.3 and 4.2.4).

use mcm::fmi::state::{ALLOWED, Call, Interface, State};
use mcm::fmi::variable::Causality::{Input, Local, Output, Parameter};
use mcm::fmi::variable::Variability::{Constant, Continuous, Discrete, Fixed, Tunable};

const STATES: [State; 8] = [
    State::Instantiated,
    State::Initialization,
    State::Stepping,
    State::Event,
    State::ContinuousTime,
    State::Failed,
    State::Terminated,
    State::Broken,
];

#[test]
fn every_call_has_one_row() {
    for (call, _) in ALLOWED {
        assert_eq!(ALLOWED.iter().filter(|(other, _)| other == call).count(), 1, "{call:?}");
    }
    assert_eq!(ALLOWED.len(), 25);
}

#[test]
fn after_a_panic_only_reset_answers() {
    for (call, _) in ALLOWED {
        assert_eq!(State::Broken.allows(*call), *call == Call::Reset, "{call:?}");
    }
}

#[test]
fn reset_is_allowed_always_and_steps_only_at_communication_points() {
    for state in STATES {
        assert!(state.allows(Call::Reset), "{state:?}");
        assert_eq!(state.allows(Call::DoStep), state == State::Stepping, "{state:?}");
        assert_eq!(state.allows(Call::SetupExperiment), state == State::Instantiated, "{state:?}");
        assert!(!state.allows(Call::CancelStep), "no step is ever pending: {state:?}");
        if state.interface() != Some(Interface::ModelExchange) {
            let set = state.may_set(Input, Continuous);
            assert_eq!(state.allows(Call::SetRealInputDerivatives), set, "{state:?}");
        }
        assert_eq!(state.allows(Call::SerializeFmuState), state.allows(Call::SetFmuState), "{state:?}");
    }
}

#[test]
fn nothing_is_read_before_initialisation() {
    assert!(!State::Instantiated.allows(Call::Get));
    assert!(State::Initialization.allows(Call::Get));
    assert!(State::Failed.allows(Call::Get), "the last good state is readable");
}

#[test]
fn parameters_are_fixed_after_initialisation_and_outputs_are_never_set() {
    for state in STATES {
        let before = matches!(state, State::Instantiated | State::Initialization);
        assert_eq!(state.may_set(Parameter, Fixed), before, "{state:?}");
        let running = matches!(state, State::Stepping | State::Event | State::ContinuousTime);
        assert_eq!(state.may_set(Input, Continuous), before || running, "{state:?}");
        let tunable = before || running && state != State::ContinuousTime;
        assert_eq!(state.may_set(Parameter, Tunable), tunable, "{state:?}");
        for (causality, variability) in [(Output, Continuous), (Output, Discrete), (Local, Constant)] {
            assert!(!state.may_set(causality, variability), "{state:?}");
        }
    }
}

#[test]
fn modes_of_model_exchange_are_entered_from_one_another() {
    let only = |call, states: &[State]| {
        for state in STATES {
            assert_eq!(state.allows(call), states.contains(&state), "{call:?} {state:?}");
        }
        assert_eq!(call.interface(), Some(Interface::ModelExchange));
    };
    only(Call::EnterEventMode, &[State::ContinuousTime]);
    only(Call::EnterContinuousTimeMode, &[State::Event]);
    only(Call::NewDiscreteStates, &[State::Event]);
    only(Call::CompletedIntegratorStep, &[State::ContinuousTime]);
    only(Call::SetTime, &[State::Event, State::ContinuousTime]);
    for (call, states) in ALLOWED {
        let of_one = call.interface().filter(|_| !states.is_empty());
        assert!(
            of_one.is_none_or(|of| states.iter().all(|state| state.interface().is_none_or(|its| its == of))),
            "{call:?} is allowed in a state of the other interface"
        );
    }
}

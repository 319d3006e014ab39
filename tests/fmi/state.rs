//! The table of allowed calls, against the table of the standard (section 4.2.4).

use mcm::fmi::state::{ALLOWED, Call, State};
use mcm::fmi::variable::Causality::{Input, Local, Output, Parameter};
use mcm::fmi::variable::Variability::{Constant, Continuous, Discrete, Fixed, Tunable};

const STATES: [State; 6] = [
    State::Instantiated,
    State::Initialization,
    State::Stepping,
    State::Failed,
    State::Terminated,
    State::Broken,
];

#[test]
fn every_call_has_one_row() {
    for (call, _) in ALLOWED {
        assert_eq!(ALLOWED.iter().filter(|(other, _)| other == call).count(), 1, "{call:?}");
    }
    assert_eq!(ALLOWED.len(), 18);
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
        assert_eq!(
            state.allows(Call::SetRealInputDerivatives),
            state.may_set(Input, Continuous),
            "{state:?}"
        );
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
        assert_eq!(state.may_set(Input, Continuous), before || state == State::Stepping, "{state:?}");
        assert_eq!(state.may_set(Parameter, Tunable), state.may_set(Input, Continuous), "{state:?}");
        for (causality, variability) in [(Output, Continuous), (Output, Discrete), (Local, Constant)] {
            assert!(!state.may_set(causality, variability), "{state:?}");
        }
    }
}

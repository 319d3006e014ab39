//! The start of a life in order.

use std::ffi::{CStr, c_char};

use mcm::fmi::bindings::*;
use mcm::fmi::ffi::*;

use super::logger;

/// An instance with the logger of `environment`.
///
/// # Safety
/// `location` is null or zero-terminated.
pub(crate) unsafe fn instantiate(guid: &CStr, location: *const c_char, environment: usize) -> fmi2Component {
    let functions = logger::callbacks(environment);
    // SAFETY: texts and callbacks outlive the call.
    let made = unsafe {
        fmi2Instantiate(
            c"one".as_ptr(),
            fmi2Type::fmi2CoSimulation,
            guid.as_ptr(),
            location,
            &raw const functions,
            0,
            0,
        )
    };
    assert!(!made.is_null(), "{:?}", logger::heard(environment));
    made
}

/// From instantiation to the first communication point.
pub(crate) fn initialise(component: fmi2Component) {
    // SAFETY: no pointers but the handle.
    unsafe {
        assert_eq!(fmi2SetupExperiment(component, 0, 0.0, 0.0, 0, 0.0), fmi2Status::fmi2OK);
        assert_eq!(fmi2EnterInitializationMode(component), fmi2Status::fmi2OK);
        assert_eq!(fmi2ExitInitializationMode(component), fmi2Status::fmi2OK);
    }
}

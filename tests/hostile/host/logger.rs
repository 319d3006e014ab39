//! The logger that tests give to instances, and what it has heard.

use std::collections::BTreeMap;
use std::ffi::{CStr, c_char};
use std::ptr;
use std::sync::{Mutex, PoisonError};

use mcm::fmi::bindings::*;

/// What was said, by the environment that each instance's host gives it.
static HEARD: Mutex<BTreeMap<usize, Vec<String>>> = Mutex::new(BTreeMap::new());

fn in_heard<T>(work: impl FnOnce(&mut BTreeMap<usize, Vec<String>>) -> T) -> T {
    work(&mut HEARD.lock().unwrap_or_else(PoisonError::into_inner))
}

/// The standard's logger is variadic; one that takes no further arguments is compatible with it in C's calling convention on every
/// platform that FMUs run on, as the FMU gives none.
unsafe extern "C" fn logger(
    environment: fmi2ComponentEnvironment,
    name: fmi2String,
    _status: fmi2Status,
    category: fmi2String,
    format: fmi2String,
) {
    // SAFETY: the FMU gives zero-terminated texts.
    let text = |text: *const c_char| unsafe { CStr::from_ptr(text) }.to_string_lossy();
    let said = format!("{} {}: {}", text(name), text(category), printed(&text(format)));
    in_heard(|heard| heard.entry(environment.addr()).or_default().push(said));
}

/// What C's `printf` makes of a format without arguments.
fn printed(format: &str) -> String {
    let conversions = format.replace("%%", "").matches('%').count();
    assert_eq!(conversions, 0, "a conversion without an argument: {format}");
    format.replace("%%", "%")
}

/// What an instance of this environment has said: `instance category: message`.
pub(crate) fn heard(environment: usize) -> Vec<String> {
    in_heard(|heard| heard.get(&environment).cloned().unwrap_or_default())
}

/// What an instance of this environment has said, as [`heard`] gives it; it is then forgotten.
pub(crate) fn take(environment: usize) -> Vec<String> {
    in_heard(|heard| heard.remove(&environment).unwrap_or_default())
}

/// Callbacks with the logger alone.
pub(crate) fn callbacks(environment: usize) -> fmi2CallbackFunctions {
    type Fixed =
        unsafe extern "C" fn(fmi2ComponentEnvironment, fmi2String, fmi2Status, fmi2String, fmi2String);
    // SAFETY: see `logger`.
    let logger: fmi2CallbackLogger = unsafe { std::mem::transmute::<Option<Fixed>, _>(Some(logger)) };
    fmi2CallbackFunctions {
        logger,
        allocateMemory: None,
        freeMemory: None,
        stepFinished: None,
        componentEnvironment: ptr::without_provenance_mut(environment),
    }
}

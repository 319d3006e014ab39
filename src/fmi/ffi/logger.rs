//! The host's logger, and endings as the standard's status.

use std::ffi::CString;
use std::ptr;

use super::super::bindings::{
    fmi2CallbackFunctions, fmi2CallbackLogger, fmi2ComponentEnvironment, fmi2Status,
};
use super::super::log::Category;
use super::super::state::Ending;

/// The host's logger, with the arguments that belong to one instance.
#[derive(Clone)]
pub(super) struct Logger {
    call: fmi2CallbackLogger,
    environment: fmi2ComponentEnvironment,
    instance_name: CString,
}

// SAFETY: the pointer is only handed back to the host, during a call that the host itself made on this thread.
unsafe impl Send for Logger {}

impl Logger {
    /// The logger among the host's callbacks; without callbacks, messages go nowhere.
    pub(super) fn new(callbacks: Option<fmi2CallbackFunctions>, instance_name: &str) -> Self {
        Self {
            call: callbacks.and_then(|callbacks| callbacks.logger),
            environment: callbacks.map_or(ptr::null_mut(), |callbacks| callbacks.componentEnvironment),
            instance_name: c_string(instance_name),
        }
    }

    /// Tells the host a message.
    pub(super) fn tell(&self, ending: Ending, category: Category, message: &str) {
        let Some(call) = self.call else { return };
        let (category, format) = (c_string(category.name()), c_string(&message.replace('%', "%%")));
        let name = self.instance_name.as_ptr();
        // SAFETY: the host has given this function with this signature, and all strings outlive the call. The format is the text
        // itself, without a conversion: some hosts do not format, and would show "%s".
        unsafe { call(self.environment, name, status(ending), category.as_ptr(), format.as_ptr()) }
    }
}

/// The text as a C string, with blanks for zero bytes, which would end it.
fn c_string(text: &str) -> CString {
    CString::new(text.replace('\0', " ")).unwrap_or_default()
}

/// The standard's status for an ending.
pub(super) fn status(ending: Ending) -> fmi2Status {
    match ending {
        Ending::Ok => fmi2Status::fmi2OK,
        Ending::Discard => fmi2Status::fmi2Discard,
        Ending::Error => fmi2Status::fmi2Error,
    }
}

//! The host's logger, and how endings are told in C.

use std::ffi::CString;

use super::super::bindings::{fmi2CallbackLogger, fmi2ComponentEnvironment, fmi2Status};
use super::super::log::Category;
use super::super::state::Ending;

/// The host's logger, with what it wants to be called with.
pub(super) struct Logger {
    pub(super) call: fmi2CallbackLogger,
    pub(super) environment: fmi2ComponentEnvironment,
    pub(super) instance_name: CString,
}

// SAFETY: the pointer is only handed back to the host, during a call that the host itself made on this thread.
unsafe impl Send for Logger {}

impl Logger {
    pub(super) fn tell(&self, ending: Ending, category: Category, message: &str) {
        let Some(call) = self.call else { return };
        let (category, message) = (c_string(category.name()), c_string(message));
        let name = self.instance_name.as_ptr();
        // SAFETY: the host gave this function with this signature; all texts outlive the call.
        unsafe {
            call(self.environment, name, status(ending), category.as_ptr(), c"%s".as_ptr(), message.as_ptr());
        }
    }
}

/// Without the zero bytes that C would take for the end.
pub(super) fn c_string(text: &str) -> CString {
    CString::new(text.replace('\0', " ")).unwrap_or_default()
}

pub(super) fn status(ending: Ending) -> fmi2Status {
    match ending {
        Ending::Ok => fmi2Status::fmi2OK,
        Ending::Discard => fmi2Status::fmi2Discard,
        Ending::Error => fmi2Status::fmi2Error,
    }
}

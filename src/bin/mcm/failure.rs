//! Failure of a command, and exit statuses.

use std::io::{ErrorKind, Write};
use std::process::ExitCode;

/// Exit status for bad input.
pub(crate) const BAD_INPUT: u8 = 1;
/// Exit status of a solve that did not converge.
pub(crate) const NOT_CONVERGED: u8 = 2;
/// Exit status of a solve that ended at an equilibrium known to be unstable, which only happens with methods that
/// ignore stability.
pub(crate) const UNSTABLE: u8 = 3;
/// Exit status of a solve that ended at a neutral equilibrium, where one direction is free.
pub(crate) const NEUTRAL: u8 = 4;

/// Failure of a command.
#[derive(Debug)]
pub(crate) enum Failure {
    /// An error message for standard error.
    Message(String),
    /// The reader of the output has closed the pipe; no message is printed.
    ReaderGone,
}

impl Failure {
    /// Prints the message, if any, and returns the exit status.
    pub(crate) fn report(self) -> ExitCode {
        if let Self::Message(message) = self {
            // Where standard error is closed, the exit status still reports the failure.
            let _ = writeln!(std::io::stderr(), "error: {message}");
        }
        BAD_INPUT.into()
    }
}

impl From<mcm::error::Error> for Failure {
    fn from(error: mcm::error::Error) -> Self {
        Self::Message(error.to_string())
    }
}

impl From<std::io::Error> for Failure {
    fn from(error: std::io::Error) -> Self {
        match error.kind() {
            ErrorKind::BrokenPipe => Self::ReaderGone,
            _ => Self::Message(error.to_string()),
        }
    }
}

impl From<csv::Error> for Failure {
    fn from(error: csv::Error) -> Self {
        Self::Message(error.to_string())
    }
}

impl From<serde_json::Error> for Failure {
    fn from(error: serde_json::Error) -> Self {
        Self::Message(error.to_string())
    }
}

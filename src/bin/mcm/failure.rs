//! Why a command gave up, and its exit status.

use std::io::{ErrorKind, Write};
use std::process::ExitCode;

/// Exit status for bad input.
pub(crate) const BAD_INPUT: u8 = 1;
/// Exit status of a solve that did not converge.
pub(crate) const NOT_CONVERGED: u8 = 2;
/// Exit status of a solve that ended at an equilibrium known to be unstable, as only a method that is blind to
/// stability can.
pub(crate) const UNSTABLE: u8 = 3;
/// Exit status of a solve that ended at a neutral equilibrium, which one direction may leave freely.
pub(crate) const NEUTRAL: u8 = 4;

/// A message for standard error.
#[derive(Debug)]
pub(crate) enum Failure {
    /// Bad input, in words.
    Message(String),
    /// The reader of our output went away: nothing to say, nobody to say it to.
    ReaderGone,
}

impl Failure {
    /// Says what went wrong and gives the exit status.
    pub(crate) fn report(self) -> ExitCode {
        if let Self::Message(message) = self {
            // Standard error closed: the exit status still tells.
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

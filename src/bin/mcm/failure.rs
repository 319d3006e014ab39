//! Failure of a command, and exit statuses.

use std::io::Write;
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
/// Exit status of a command that was stopped by Ctrl-C: 128 and the number of the signal, as shells have it.
pub(crate) const STOPPED: u8 = 130;

/// Failure of a command: its message for standard error.
#[derive(Debug)]
pub(crate) struct Failure(pub(crate) String);

impl Failure {
    /// What happened to the file or stream called `name`.
    pub(crate) fn writing(name: impl std::fmt::Display, error: impl std::fmt::Display) -> Self {
        Self(format!("cannot write {name}: {error}"))
    }

    /// Prints the message and returns the exit status.
    pub(crate) fn report(self) -> ExitCode {
        // Where standard error is closed, the exit status still reports the failure.
        let _ = writeln!(std::io::stderr(), "error: {}", self.0);
        BAD_INPUT.into()
    }
}

impl From<mcm::error::Error> for Failure {
    fn from(error: mcm::error::Error) -> Self {
        // Of several faults each is an error.
        Self(error.to_string().replace('\n', "\nerror: "))
    }
}

//! Ctrl-C: a sweep ends at its next row, and at once when it is pressed again; any other command ends at once.

use std::sync::atomic::{AtomicBool, Ordering};

use super::failure::{Failure, STOPPED};
use super::output::remove_unfinished;

/// Whether the command ends by itself when it is asked to.
static PATIENT: AtomicBool = AtomicBool::new(false);

static REQUESTED: AtomicBool = AtomicBool::new(false);

/// From now on nothing half written is left by Ctrl-C.
pub(crate) fn listen() -> Result<(), Failure> {
    ctrlc::set_handler(|| {
        if REQUESTED.swap(true, Ordering::Relaxed) || !PATIENT.load(Ordering::Relaxed) {
            remove_unfinished();
            std::process::exit(STOPPED.into());
        }
    })
    .map_err(|error| Failure(format!("cannot listen to Ctrl-C: {error}")))
}

/// From now on the command asks itself whether to stop.
pub(crate) fn ask() {
    PATIENT.store(true, Ordering::Relaxed);
}

/// Whether to stop.
pub(crate) fn requested() -> bool {
    REQUESTED.load(Ordering::Relaxed)
}

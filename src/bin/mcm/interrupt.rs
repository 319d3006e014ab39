//! Ctrl-C: the command ends at the next row, and at once when it is pressed again.

use std::sync::atomic::{AtomicBool, Ordering};

use super::failure::{Failure, STOPPED};

static REQUESTED: AtomicBool = AtomicBool::new(false);

/// From now on Ctrl-C asks to stop.
pub(crate) fn listen() -> Result<(), Failure> {
    ctrlc::set_handler(|| {
        if REQUESTED.swap(true, Ordering::Relaxed) {
            std::process::exit(STOPPED.into());
        }
    })
    .map_err(|error| Failure(format!("cannot listen to Ctrl-C: {error}")))
}

/// Whether to stop.
pub(crate) fn requested() -> bool {
    REQUESTED.load(Ordering::Relaxed)
}

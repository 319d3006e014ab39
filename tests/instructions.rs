//! Which instructions a test runs with.

use std::sync::{Mutex, PoisonError};

use mcm::numerics::processor::Instructions;

/// What `run` gives with portable instructions, or with those of the processor. Other tests that run beside it get the same
/// bits with either; of those that compare them one runs at a time.
pub(crate) fn with_instructions<T>(portable: bool, run: impl FnOnce() -> T) -> T {
    static CHOICE: Mutex<()> = Mutex::new(());
    let _alone = CHOICE.lock().unwrap_or_else(PoisonError::into_inner);
    Instructions::force_portable(portable);
    let out = run();
    Instructions::force_portable(false);
    out
}

//! The guard that stops panics: they must not cross the C boundary, nor print to the host's terminal.

use std::cell::{Cell, RefCell};
use std::panic::{AssertUnwindSafe, PanicHookInfo, catch_unwind, set_hook, take_hook};
use std::sync::{Once, OnceLock};

thread_local! {
    static GUARDED: Cell<bool> = const { Cell::new(false) };
    static TEXT: RefCell<Option<String>> = const { RefCell::new(None) };
}

static HOOK: Once = Once::new();

/// The panic hook that was set before. It is kept here and not captured by the new hook, which would then need memory that
/// is lost when the host unloads the library.
static BEFORE: OnceLock<Hook> = OnceLock::new();

/// A panic hook: what the standard library calls when a thread panics.
type Hook = Box<dyn Fn(&PanicHookInfo<'_>) + Send + Sync>;

/// Does `work` and catches a panic in it.
///
/// Panics elsewhere in the process are handled by the hook that was set before.
///
/// ```
/// use mcm::fmi::guard::guarded;
/// assert_eq!(guarded(|| 1 + 1), Ok(2));
/// let nothing: Vec<u8> = Vec::new();
/// assert!(guarded(|| nothing[0]).unwrap_err().contains("index out of bounds"));
/// ```
///
/// # Errors
/// The message of the panic and its location in the source.
pub fn guarded<T>(work: impl FnOnce() -> T) -> Result<T, String> {
    HOOK.call_once(|| {
        BEFORE.get_or_init(take_hook);
        set_hook(Box::new(|panic| {
            if GUARDED.get() {
                TEXT.set(Some(panic.to_string()));
            } else if let Some(before) = BEFORE.get() {
                before(panic);
            }
        }));
    });
    let outer = GUARDED.replace(true);
    // What the work was changing may be inconsistent now; the caller discards it: see `Instance::break_down`.
    let result = catch_unwind(AssertUnwindSafe(work));
    GUARDED.set(outer);
    result.map_err(|_| TEXT.take().unwrap_or_else(|| "panic".into()))
}

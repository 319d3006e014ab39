//! A panic stops here: it must not cross the C boundary, nor print into the host's terminal.

use std::cell::{Cell, RefCell};
use std::panic::{AssertUnwindSafe, PanicHookInfo, catch_unwind, set_hook, take_hook};
use std::sync::{Once, OnceLock};

thread_local! {
    static GUARDED: Cell<bool> = const { Cell::new(false) };
    static TEXT: RefCell<Option<String>> = const { RefCell::new(None) };
}

static HOOK: Once = Once::new();

/// The hook that was set before. Were it captured, the new hook would need memory that is lost when the host unloads the
/// library.
static BEFORE: OnceLock<Hook> = OnceLock::new();

/// What std calls when a thread panics.
type Hook = Box<dyn Fn(&PanicHookInfo<'_>) + Send + Sync>;

/// Does `work`; a panic in it becomes its text.
///
/// Panics elsewhere in the process are left to the hook that was set before.
///
/// ```
/// use mcm::fmi::guard::guarded;
/// assert_eq!(guarded(|| 1 + 1), Ok(2));
/// let nothing: Vec<u8> = Vec::new();
/// assert!(guarded(|| nothing[0]).unwrap_err().contains("index out of bounds"));
/// ```
///
/// # Errors
/// The message and place of the panic.
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
    // Whatever the work was changing is thrown away by the caller: see `Instance::break_down`.
    let result = catch_unwind(AssertUnwindSafe(work));
    GUARDED.set(outer);
    result.map_err(|_| TEXT.take().unwrap_or_else(|| "panic".into()))
}

//! The live instances, by handle.
//!
//! A handle is a number and not an address, so that a call with an unknown or freed handle ends with an error and not with
//! a memory fault.

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, PoisonError, TryLockError};

use super::guard::guarded;
use super::instance::Instance;
use super::state::{Call, Ending};

type Live = BTreeMap<usize, Arc<Mutex<Instance>>>;

static LIVE: Mutex<Live> = Mutex::new(BTreeMap::new());

/// Instances and saved FMU states are numbered together, so that none can be taken for another.
static NEXT_HANDLE: AtomicUsize = AtomicUsize::new(1);

fn live<T>(work: impl FnOnce(&mut Live) -> T) -> T {
    work(&mut LIVE.lock().unwrap_or_else(PoisonError::into_inner))
}

/// A handle that was never used before; never 0.
pub(super) fn new_handle() -> usize {
    NEXT_HANDLE.fetch_add(1, Ordering::Relaxed)
}

/// Registers an instance and returns its handle.
pub(super) fn enter(instance: Instance) -> usize {
    let handle = new_handle();
    live(|live| live.insert(handle, Arc::new(Mutex::new(instance))));
    handle
}

/// Drops the instance with this handle; an unknown handle does nothing.
pub(super) fn leave(handle: usize) {
    drop(live(|live| remove(live, handle)));
}

fn remove(live: &mut Live, handle: usize) -> Option<Arc<Mutex<Instance>>> {
    let instance = live.remove(&handle);
    if live.is_empty() {
        *live = Live::new(); // an emptied map keeps a node, which would be lost when the host unloads the library
    }
    instance
}

/// Does `work` on the instance with this handle, if its state allows `call`; `name` is that of the C function.
///
/// A panic breaks this instance only.
pub(super) fn on(
    handle: usize,
    name: &str,
    call: Call,
    work: impl FnOnce(&mut Instance) -> Ending,
) -> Ending {
    let Some(instance) = live(|live| live.get(&handle).cloned()) else {
        return Ending::Error;
    };
    let mut instance = match instance.try_lock() {
        Ok(instance) => instance,
        Err(TryLockError::Poisoned(poisoned)) => poisoned.into_inner(),
        // The host calls from within its logger, or from two threads at once: to wait could mean a deadlock.
        Err(TryLockError::WouldBlock) => return Ending::Error,
    };
    let done = guarded(|| if instance.allows(call, name) { work(&mut instance) } else { Ending::Error });
    done.unwrap_or_else(|panic| {
        guarded(|| instance.break_down(&format!("{name}: {panic}"))).unwrap_or(Ending::Error)
    })
}

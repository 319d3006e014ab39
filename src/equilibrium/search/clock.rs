//! The processor time of this thread.

use std::time::Duration;

/// Processor time of this thread since some moment; `None` on a system that does not report it.
#[cfg(not(target_family = "wasm"))]
pub(crate) fn processor_time() -> Option<Duration> {
    Some(cpu_time::ThreadTime::try_now().ok()?.as_duration())
}

/// A clock of the surroundings: seconds since some moment.
#[cfg(target_family = "wasm")]
static CLOCK: std::sync::OnceLock<fn() -> f64> = std::sync::OnceLock::new();

/// Gives WebAssembly, which has no clock of its own, that of the page: seconds since some moment. The first one counts.
#[cfg(target_family = "wasm")]
pub fn set_clock(seconds: fn() -> f64) {
    CLOCK.get_or_init(|| seconds);
}

/// Time of the clock that the page has given; `None` before.
#[cfg(target_family = "wasm")]
pub(crate) fn processor_time() -> Option<Duration> {
    Duration::try_from_secs_f64(CLOCK.get()?()).ok()
}

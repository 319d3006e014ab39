//! Processor time budget of a solve.

use std::cell::OnceCell;
use std::time::Duration;

use super::clock::processor_time;

/// A budget of processor time of this thread. Its clock starts at the first query, which a well predicted step never
/// makes.
#[derive(Debug)]
pub(crate) struct Deadline {
    budget: Duration,
    start: OnceCell<Option<Duration>>,
}

impl Deadline {
    /// A budget in seconds.
    pub(crate) fn new(seconds: f64) -> Self {
        let budget = Duration::try_from_secs_f64(seconds).unwrap_or(Duration::MAX);
        Self { budget, start: OnceCell::new() }
    }

    /// Whether the budget is used up; never on a system that does not report the time of threads.
    pub(crate) fn has_passed(&self) -> bool {
        self.elapsed() > self.budget
    }

    /// What is left of the budget, s.
    pub(crate) fn left(&self) -> f64 {
        self.budget.saturating_sub(self.elapsed()).as_secs_f64()
    }

    fn elapsed(&self) -> Duration {
        let start = self.start.get_or_init(processor_time);
        start.and_then(|start| processor_time()?.checked_sub(start)).unwrap_or_default()
    }
}

//! How long a cheaper model is not tried again.

use serde::{Deserialize, Serialize};

/// Largest number of changes between two trials of a cheaper model; each failed trial doubles the number.
const PATIENCE: u32 = 16;

/// Number of changes before a cheaper model is tried: those left, and those after the next failure.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Wait {
    left: u32,
    next: u32,
    /// Age at which the last change was counted.
    pub(super) counted: f64,
}

impl Wait {
    /// A trial is due at the first change.
    pub(super) const NONE: Self = Self { left: 0, next: 1, counted: 0.0 };

    /// Whether a cheaper model is to be tried at that age; a change is counted once the age has grown by one.
    pub(super) fn is_over(&mut self, age: f64) -> bool {
        if age - self.counted <= 1.0 {
            return false;
        }
        let over = self.left == 0;
        (self.left, self.counted) = (self.left.saturating_sub(1), age);
        over
    }

    /// The wait after a trial that failed.
    pub(super) fn longer(self) -> Self {
        Self { left: self.next, next: PATIENCE.min(2 * self.next), ..self }
    }
}

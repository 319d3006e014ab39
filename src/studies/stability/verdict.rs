//! Verdict on the result of a method.

use serde::Serialize;

/// Result of one attempt to solve one cell of the map.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// The stable equilibrium to which quasi-static loading from the unloaded shape leads.
    Branch,
    /// Another stable equilibrium.
    OtherStable,
    /// An unstable equilibrium.
    Unstable,
    /// Reported as solved, but not close to an equilibrium.
    Wrong,
    /// Reported as not solved, with a finite residual.
    Stalled,
    /// Reported as not solved, with a residual that is not finite.
    Diverged,
}

impl Verdict {
    /// Every verdict and its legend label, from best to worst for a user who does not check the result.
    pub const ALL: [(Self, &str); 6] = [
        (Self::Branch, "the stable shape of slow loading"),
        (Self::OtherStable, "another stable shape"),
        (Self::Stalled, "none found, and reported so"),
        (Self::Diverged, "diverged, and reported so"),
        (Self::Unstable, "unstable shape, not reported"),
        (Self::Wrong, "no equilibrium, not reported"),
    ];
}

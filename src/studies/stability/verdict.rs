//! What a method's answer is worth.

use serde::Serialize;

/// What came of one attempt to solve one cell of the map.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// The stable equilibrium to which quasi-static loading from the unloaded shape leads.
    Branch,
    /// Another stable equilibrium.
    OtherStable,
    /// An equilibrium that the smallest disturbance leaves.
    Unstable,
    /// Called solved, but no equilibrium is there.
    Wrong,
    /// Not solved, and said so, with a finite residual.
    Stalled,
    /// Not solved, and said so, with a residual that is not finite.
    Diverged,
}

impl Verdict {
    /// Every verdict and what a legend calls it, from best to worst for whoever does not look further.
    pub const ALL: [(Self, &str); 6] = [
        (Self::Branch, "the stable shape of slow loading"),
        (Self::OtherStable, "another stable shape"),
        (Self::Stalled, "stalled, said so"),
        (Self::Diverged, "diverged, said so"),
        (Self::Unstable, "unstable shape, not said"),
        (Self::Wrong, "no shape in balance, not said"),
    ];
}

//! Which numbers of a random kind a run is asked for.

use std::ops::Range;

/// Numbers of random cases, and the seed of all.
pub(crate) struct Numbers {
    pub(crate) numbers: Range<u64>,
    pub(crate) seed: u64,
}

impl Numbers {
    /// Those of the command line, COUNT [FIRST [SEED]], which is said where the count is missing.
    pub(crate) fn asked() -> Option<Self> {
        let arguments: Vec<u64> = std::env::args().skip(1).filter_map(|text| text.parse().ok()).collect();
        let Some(count) = arguments.first() else {
            println!("say: COUNT [FIRST [SEED]]");
            return None;
        };

        let argument = |at: usize, unless: u64| arguments.get(at).copied().unwrap_or(unless);
        let first = argument(1, 0);
        Some(Self { numbers: first..first + count, seed: argument(2, 1) })
    }
}

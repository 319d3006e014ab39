//! The direction of a walk.

use serde::{Deserialize, Serialize};

/// Direction in which the first key varies.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) enum Way {
    Forth,
    Back,
}

impl Way {
    pub(crate) fn name(self) -> &'static str {
        if self == Self::Forth { "forth" } else { "back" }
    }

    pub(crate) fn named(name: &str) -> Option<Self> {
        [Self::Forth, Self::Back].into_iter().find(|way| way.name() == name)
    }
}

//! All field sources near a device.

use std::fmt;

use serde::{Deserialize, Serialize};

use super::source::{Drive, Source};
use crate::error::Error;
use crate::geometry::Pose;

/// The field sources near a device: magnets and coils, each a rigid body, in one list.
///
/// The external magnet is the first of them, if it is a magnet. An `Option<&Source>` stands for a list of one or none.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Sources(Vec<Source>);

/// Which source one is among those of its kind, counted from 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum SourceName {
    /// A magnet; the first one is the external magnet.
    Magnet(usize),
    /// A coil.
    Coil(usize),
}

impl SourceName {
    /// Its body of this number, counted from 0, in words: magnets have several, a coil is one.
    #[must_use]
    pub fn body(&self, number: usize) -> String {
        match self {
            Self::Magnet(_) => format!("part {} of {self}", number + 1),
            Self::Coil(_) => self.to_string(),
        }
    }
}

/// Counted from 1, as in scene files and in the FMU.
impl fmt::Display for SourceName {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Magnet(0) => out.write_str("the external magnet"),
            Self::Magnet(number) => write!(out, "magnet {}", number + 1),
            Self::Coil(number) => write!(out, "coil {}", number + 1),
        }
    }
}

impl Sources {
    /// Largest number of sources.
    pub const MOST: usize = 16;

    /// These magnets and coils.
    ///
    /// # Errors
    /// [`Error::Count`] for more than [`Self::MOST`]; a list that does not begin with a magnet keeps a place for one, because an FMU
    /// always has it.
    pub fn new(list: Vec<Source>) -> Result<Self, Error> {
        let keeps_a_place = list.first().is_some_and(|first| first.drive() != Drive::Factor);
        let given = list.len() + usize::from(keeps_a_place);
        if given <= Self::MOST {
            return Ok(Self(list));
        }
        let expected = format!("at most {}", Self::MOST);
        Err(Error::Count { quantity: "list of magnets and coils".into(), given, expected })
    }

    /// All of them in their order.
    #[must_use]
    pub fn list(&self) -> &[Source] {
        &self.0
    }

    /// The external magnet.
    #[must_use]
    pub fn magnet(&self) -> Option<&Source> {
        self.0.first().filter(|first| first.drive() == Drive::Factor)
    }

    /// The name of the source of this number; a number beyond the list is that of a magnet.
    #[must_use]
    pub fn name(&self, number: usize) -> SourceName {
        let drive = self.0.get(number).map_or(Drive::Factor, |source| source.drive());
        let before = self.0.iter().take(number).filter(|source| source.drive() == drive).count();
        match drive {
            Drive::Factor => SourceName::Magnet(before),
            Drive::Current => SourceName::Coil(before),
        }
    }

    /// Whether the source of this number is in the way of others: a coil always, a magnet unless its strength is 0.
    #[must_use]
    pub fn is_there(&self, number: usize, strength: f64) -> bool {
        let driven = self.0.get(number).map(|source| source.drive());
        strength != 0.0 || driven == Some(Drive::Current)
    }

    /// Checks that no two sources overlap; `at` gives the pose of each that is there, and whether it may have
    /// moved since the last check.
    ///
    /// # Errors
    /// [`Error::Unsupported`] naming two that overlap.
    pub fn check_apart(&self, at: impl Fn(usize) -> Option<(Pose, bool)>) -> Result<(), Error> {
        for (number, second) in self.0.iter().enumerate() {
            for (before, first) in self.0.iter().enumerate().take(number) {
                let (Some((here, moved)), Some((there, also))) = (at(before), at(number)) else { continue };
                if !moved && !also {
                    continue;
                }
                let seen = there.seen_from(&here);
                let deepest = first.depth_in(second, &seen);
                if deepest > 0.0 {
                    let (one, other) = (self.name(before), self.name(number));
                    let depth = 1e3 * deepest;
                    return Err(Error::Unsupported(format!("{one} and {other} overlap by {depth:.3} mm")));
                }
            }
        }
        Ok(())
    }
}

impl From<Option<&Source>> for Sources {
    fn from(magnet: Option<&Source>) -> Self {
        Self(magnet.cloned().into_iter().collect())
    }
}

impl From<&Sources> for Sources {
    fn from(sources: &Sources) -> Self {
        sources.clone()
    }
}

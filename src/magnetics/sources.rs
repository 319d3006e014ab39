//! All field sources near a device.

use std::fmt;

use serde::{Deserialize, Serialize};

use super::assembly::Assembly;
use crate::error::Error;
use crate::geometry::Pose;

/// The field sources near a device: the external magnet, and further magnets and coils, each a rigid body.
///
/// An `Option<&Assembly>` stands for the external magnet alone.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Sources {
    magnet: Option<Assembly>,
    further: Vec<Assembly>,
}

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
            Self::Magnet(_) => format!("cylinder {} of {self}", number + 1),
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

    /// The external magnet (`None` for none), and further magnets and coils.
    ///
    /// # Errors
    /// [`Error::Count`] for more than [`Self::MOST`] sources.
    pub fn new(magnet: Option<Assembly>, further: Vec<Assembly>) -> Result<Self, Error> {
        if further.len() < Self::MOST {
            return Ok(Self { magnet, further });
        }
        Err(Error::Count {
            quantity: "list of magnets and coils".into(),
            given: further.len() + 1,
            expected: format!("at most {}", Self::MOST),
        })
    }

    /// The external magnet.
    #[must_use]
    pub fn magnet(&self) -> Option<&Assembly> {
        self.magnet.as_ref()
    }

    /// The further magnets and coils.
    #[must_use]
    pub fn further(&self) -> &[Assembly] {
        &self.further
    }

    /// All sources with their numbers: 0 is the external magnet, from 1 on the further ones.
    pub fn numbered(&self) -> impl Iterator<Item = (usize, &Assembly)> {
        self.magnet.iter().map(|magnet| (0, magnet)).chain((1..).zip(&self.further))
    }

    /// The name of the source of this number.
    #[must_use]
    pub fn name(&self, number: usize) -> SourceName {
        let before = &self.further[..number.saturating_sub(1).min(self.further.len())];
        let coils = before.iter().filter(|source| source.coil().is_some()).count();
        match number.checked_sub(1).and_then(|further| self.further.get(further)) {
            Some(source) if source.coil().is_some() => SourceName::Coil(coils),
            _ => SourceName::Magnet(number - coils),
        }
    }

    /// Whether the source of this number is in the way of others: a coil always, a magnet unless its strength is 0.
    #[must_use]
    pub fn is_there(&self, number: usize, strength: f64) -> bool {
        strength != 0.0 || matches!(self.name(number), SourceName::Coil(_))
    }

    /// Checks that no two sources overlap; `at` gives the pose of each that is there, and whether it may have
    /// moved since the last check.
    ///
    /// # Errors
    /// [`Error::Unsupported`] naming two that overlap.
    pub fn check_apart(&self, at: impl Fn(usize) -> Option<(Pose, bool)>) -> Result<(), Error> {
        for (number, second) in self.numbered() {
            for (before, first) in self.numbered().take_while(|(before, _)| *before < number) {
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

impl From<Option<&Assembly>> for Sources {
    fn from(magnet: Option<&Assembly>) -> Self {
        Self { magnet: magnet.cloned(), further: Vec::new() }
    }
}

impl From<&Sources> for Sources {
    fn from(sources: &Sources) -> Self {
        sources.clone()
    }
}

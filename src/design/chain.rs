//! The chain of bodies from base to tip, checked once.

use super::section::{Ring, Span};
use super::specification::Specification;
use crate::error::Error;

/// What lies between two rings (or between base and tip), and the ring at its end.
#[derive(Debug, Clone, PartialEq)]
pub struct Segment {
    /// The deformable spans, base to tip.
    pub spans: Vec<Span>,
    /// The ring at the distal end, if there is one.
    pub ring: Option<Ring>,
}

/// A checked design: every number in range, every body derived.
#[derive(Debug, Clone, PartialEq)]
pub struct Design {
    specification: Specification,
    base_ring: Option<Ring>,
    segments: Vec<Segment>,
}

impl Design {
    /// Checks a specification and derives its bodies.
    ///
    /// # Errors
    /// [`Error::Range`] naming the first quantity out of range.
    pub fn new(_specification: Specification) -> Result<Self, Error> {
        Err(Error::Unsupported("unfinished".into()))
    }

    /// What the design was made from.
    #[must_use]
    pub fn specification(&self) -> &Specification {
        &self.specification
    }

    /// The ring at the base, clamped with the base frame at its proximal face.
    #[must_use]
    pub fn base_ring(&self) -> Option<&Ring> {
        self.base_ring.as_ref()
    }

    /// The segments, base to tip.
    #[must_use]
    pub fn segments(&self) -> &[Segment] {
        &self.segments
    }

    /// All rings, base to tip.
    pub fn rings(&self) -> impl Iterator<Item = &Ring> {
        self.base_ring.iter().chain(self.segments.iter().filter_map(|segment| segment.ring.as_ref()))
    }

    /// Length of the straight unloaded manipulator, m.
    #[must_use]
    pub fn length(&self) -> f64 {
        let spans: f64 = self.segments.iter().flat_map(|s| &s.spans).map(|span| span.length).sum();
        spans + self.rings().map(|ring| ring.length).sum::<f64>()
    }
}

//! A frame of the chain, by what it carries.

use crate::equilibrium::ring_body::RingBody;
use crate::rod::{SectionMaterial, Station};

/// What a frame carries, whose pose is told beside it.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Frame<'a> {
    /// The material that a Gauss point of an element stands for; the pose is that of the section.
    Station(&'a Station),
    /// Material of a section, per length or not.
    Section(&'a SectionMaterial),
    /// A ring by its number; the pose is that of its node, on its proximal face.
    Ring(usize, &'a RingBody),
    /// The tip so far (m) beyond the frame, which is the last node's.
    Tip(f64),
}

impl<'a> Frame<'a> {
    /// The material, if it is that of a section.
    pub(super) fn material(&self) -> Option<&'a SectionMaterial> {
        match self {
            Self::Station(station) => Some(&station.material),
            Self::Section(material) => Some(material),
            Self::Ring(..) | Self::Tip(_) => None,
        }
    }
}

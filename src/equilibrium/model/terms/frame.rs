//! Frame of the chain, by the body that it carries.

use super::super::chain::Chain;
use super::super::ring_body::RingBody;
use super::super::source_field::{Near, StationFields};
use crate::design::Direction;
use crate::rod::{SectionMaterial, Station};

/// Fields of the sources at the points of a station, as far as they were evaluated already.
#[derive(Debug, Clone, Copy)]
pub(crate) struct NearStation<'a> {
    /// The fields of each source.
    pub(crate) fields: &'a [StationFields],
    /// Number of the station, counted along the chain.
    pub(crate) station: usize,
}

impl<'a> NearStation<'a> {
    /// None evaluated.
    pub(crate) const NONE: Self = Self { fields: &[], station: 0 };

    /// The field of the source of this number at the station's points, in its axes.
    pub(crate) fn of(&self, source: usize) -> &'a [Near] {
        self.fields.get(source).map_or(&[], |fields| fields.at(self.station))
    }
}

/// The body that a frame carries; the pose of the frame is given separately.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Frame<'a> {
    /// The material represented by a Gauss point of an element; the pose is that of the section. The fields of
    /// the sources at its points may have been evaluated already.
    Station(&'a Station, NearStation<'a>),
    /// Material of a section, per length or as a whole.
    #[cfg_attr(
        not(feature = "methods"),
        expect(dead_code, reason = "of methods that integrate along the rod")
    )]
    Section(&'a SectionMaterial),
    /// A ring or another rigid body by its number; the pose is that of its node.
    Ring(usize, &'a RingBody),
    /// The tip at this distance (m) beyond the frame, which is that of the last node.
    Tip(f64),
}

impl<'a> Frame<'a> {
    /// Frames at the nodes of `chain`, each with its node: the rings, and the tip at the last node.
    pub(crate) fn at_nodes(chain: &'a Chain) -> impl Iterator<Item = (usize, Self)> {
        let rings =
            chain.rings.iter().enumerate().map(|(number, body)| (body.node, Self::Ring(number, body)));
        rings.chain([(chain.elements.len(), Self::Tip(chain.tip_offset))])
    }

    /// Direction in which the body is magnetised, in its directors.
    pub(crate) fn direction(&self) -> Direction {
        match self {
            Self::Ring(_, body) => body.direction,
            _ => self.material().map_or(Direction::Axial, |material| material.direction),
        }
    }

    /// The material, if the body is that of a section.
    pub(crate) fn material(&self) -> Option<&'a SectionMaterial> {
        match self {
            Self::Station(station, _) => Some(&station.material),
            Self::Section(material) => Some(material),
            Self::Ring(..) | Self::Tip(_) => None,
        }
    }
}

//! Contacts of the chain with the wall of a vessel.

use nalgebra::Vector3;

use super::walls::Touch;

/// A part of an arc in contact, within which the force is a smooth function of the arc length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ArcPart {
    /// Element and its piece.
    pub(crate) on: (usize, usize),
    /// Its ends along the element, m.
    pub(crate) ends: [f64; 2],
    /// Its greatest depth in the wall, m.
    pub(crate) deepest: f64,
    /// Number of the arc that it belongs to.
    pub(crate) arc: usize,
}

/// Where the chain touches the wall.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Site {
    /// The rims of a ring, by its number.
    Ring(usize),
    /// An arc, by its number.
    Arc(usize),
    /// The round end of a chain that ends without a ring.
    Tip,
}

/// Contact with the wall at one place, or at one Gauss point of an arc.
#[derive(Debug, Clone, Copy)]
pub(crate) struct WallContact {
    pub(crate) site: Site,
    /// The place on the wall, m, world axes.
    pub(crate) at: Vector3<f64>,
    /// Force of the wall on the chain, N, world axes.
    pub(crate) force: Vector3<f64>,
    /// Depth in the wall, m.
    pub(crate) depth: f64,
}

impl WallContact {
    pub(crate) fn new(site: Site, touch: &Touch) -> Self {
        Self { site, at: touch.at, force: -touch.load.force, depth: touch.depth }
    }
}

/// All contacts with the wall at the shape evaluated last.
#[derive(Debug, Clone, Default)]
pub(crate) struct WallContacts {
    pub(crate) all: Vec<WallContact>,
    /// Forces of friction on the chain, N, world axes, each with the ring that it acts on.
    pub(crate) friction: Vec<(Option<usize>, Vector3<f64>)>,
    /// The arcs in contact; storage that is used again.
    pub(crate) parts: Vec<ArcPart>,
}

impl WallContacts {
    /// Forgets them, and keeps their storage.
    pub(super) fn clear(&mut self) {
        self.all.clear();
        self.friction.clear();
    }
}

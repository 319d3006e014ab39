//! Contacts of the chain with the wall of a vessel.

use nalgebra::Vector3;

use super::terms::Touch;
use crate::rod::Load;

/// A part of an arc in contact, within which the force is a smooth function of the arc length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ArcPart {
    /// Element and its piece.
    pub(super) on: (usize, usize),
    /// Its ends along the element, m.
    pub(super) ends: [f64; 2],
    /// Its greatest depth in the wall, m.
    pub(super) deepest: f64,
    /// Number of the arc that it belongs to.
    pub(super) arc: usize,
}

/// Where the chain touches the wall.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Site {
    /// The rims of a ring, by its number.
    Ring(usize),
    /// An arc, by its number.
    Arc(usize),
    /// The round end of a chain that ends without a ring.
    Tip,
}

/// Contact with the wall at one place, or at one Gauss point of an arc.
#[derive(Debug, Clone, Copy)]
pub(super) struct WallContact {
    pub(super) site: Site,
    /// The place on the wall, m, world axes.
    pub(super) at: Vector3<f64>,
    /// Force of the wall on the chain, N, world axes.
    pub(super) force: Vector3<f64>,
    /// Depth in the wall, m.
    pub(super) depth: f64,
}

impl WallContact {
    pub(super) fn new(site: Site, touch: &Touch) -> Self {
        Self { site, at: touch.at, force: -touch.load.force, depth: touch.depth }
    }
}

/// All contacts with the wall at the shape evaluated last.
#[derive(Debug, Clone, Default)]
pub(super) struct WallLoads {
    pub(super) contacts: Vec<WallContact>,
    /// Forces of friction on the chain, N, world axes, each with the ring that it acts on.
    pub(super) friction: Vec<(Option<usize>, Vector3<f64>)>,
    /// Loads on nodes, in world axes.
    pub(super) on_nodes: Vec<(usize, Load)>,
    /// The arcs in contact; storage that is used again.
    pub(super) parts: Vec<ArcPart>,
}

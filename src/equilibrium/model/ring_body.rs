//! Ring of the chain: a rigid magnet on a node.

use crate::constants::VACUUM_PERMEABILITY;
use crate::design::Ring;
use crate::error::Error;
use crate::geometry::Pose;
use crate::magnetics::{AxialSource, Outline};

/// A rigid ring with its proximal face at a node.
#[derive(Debug, Clone)]
pub(crate) struct RingBody {
    /// Dimensions and material.
    pub(crate) ring: Ring,
    /// The number of its node; 0 is the clamped base.
    pub(crate) node: usize,
    /// Its field, in its own frame.
    pub(crate) source: AxialSource,
    /// Magnetisation, A/m.
    pub(crate) magnetisation: f64,
}

impl RingBody {
    pub(crate) fn new(ring: &Ring, node: usize) -> Result<Self, Error> {
        Ok(Self {
            ring: *ring,
            node,
            source: AxialSource::new(ring.inner_radius, ring.outer_radius, ring.length, ring.remanence)?,
            magnetisation: ring.remanence / VACUUM_PERMEABILITY,
        })
    }

    /// Distance of its centre from its node, m.
    pub(crate) fn half_length(&self) -> f64 {
        0.5 * self.ring.length
    }

    /// Largest distance of its points from its centre, m.
    pub(crate) fn extent(&self) -> f64 {
        self.ring.outer_radius.hypot(self.half_length())
    }

    /// Its outline without the bore: no part of the manipulator or of a magnet is assumed to fit into it.
    pub(crate) fn outline(&self) -> Outline {
        Outline::cylinder(0.0, self.ring.outer_radius, self.ring.length)
    }

    /// Pose of its centre for a node at the pose `node`.
    pub(crate) fn centre(&self, node: &Pose) -> Pose {
        node.advanced(self.half_length())
    }
}

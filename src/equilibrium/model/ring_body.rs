//! Ring of the chain: a rigid magnet on a node.

use crate::constants::VACUUM_PERMEABILITY;
use crate::design::{Direction, RigidShape, Ring};
use crate::error::Error;
use crate::geometry::Pose;
use crate::magnetics::{AxialSource, DirectedMagnet, Outline};

/// A rigid ring, or another rigid body, on a node.
#[derive(Debug, Clone)]
pub(crate) struct RingBody {
    /// Dimensions and material.
    pub(crate) ring: Ring,
    /// The number of its node; 0 is the clamped base.
    pub(crate) node: usize,
    /// Distance of its proximal face from its node, m: the length of the bodies that it is welded to.
    pub(crate) start: f64,
    /// Its outline and, where it is magnetised along its axis, its field, in its own frame.
    pub(crate) source: AxialSource,
    /// Its field, where it is not.
    pub(crate) directed: Option<DirectedMagnet>,
    /// Magnetisation, A/m.
    pub(crate) magnetisation: f64,
    /// Direction of the magnetisation, in the directors.
    pub(crate) direction: Direction,
    /// Magnetic moment along that direction, A m2.
    pub(crate) moment: f64,
}

impl RingBody {
    pub(crate) fn new(ring: &Ring, node: usize, start: f64) -> Result<Self, Error> {
        let source = AxialSource::new(ring.inner_radius, ring.outer_radius, ring.length, ring.remanence)?;
        let moment = match ring.shape {
            RigidShape::Tube => source.moment(),
            RigidShape::Ball => ring.moment(),
        };

        // A ring magnetised along its axis has the field of its source, which costs less.
        let remanence = ring.direction.vector() * ring.remanence;
        let directed = match ring.shape {
            _ if ring.remanence == 0.0 => None,
            RigidShape::Ball => Some(DirectedMagnet::ball(ring.outer_radius, remanence)?),
            RigidShape::Tube if ring.direction.is_axial() => None,
            RigidShape::Tube => {
                let radii = [ring.inner_radius, ring.outer_radius];
                Some(DirectedMagnet::cylinder(radii, ring.length, remanence)?)
            }
        };

        Ok(Self {
            ring: *ring,
            node,
            start,
            source,
            directed,
            magnetisation: ring.remanence / VACUUM_PERMEABILITY,
            direction: ring.direction,
            moment,
        })
    }

    /// Half of its length, m.
    pub(crate) fn half_length(&self) -> f64 {
        0.5 * self.ring.length
    }

    /// Distance of its centre from its node, m.
    pub(crate) fn to_centre(&self) -> f64 {
        self.start + self.half_length()
    }

    /// Distance of its distal face from its node, m.
    pub(crate) fn end(&self) -> f64 {
        self.start + self.ring.length
    }

    /// Largest distance of its points from its centre, m.
    pub(crate) fn extent(&self) -> f64 {
        match self.ring.shape {
            RigidShape::Tube => self.ring.outer_radius.hypot(self.half_length()),
            RigidShape::Ball => self.ring.outer_radius,
        }
    }

    /// Its outline without the bore: no part of the manipulator or of a magnet is assumed to fit into it.
    pub(crate) fn outline(&self) -> Outline {
        match self.ring.shape {
            RigidShape::Tube => Outline::cylinder(0.0, self.ring.outer_radius, self.ring.length),
            RigidShape::Ball => Outline::Sphere(self.ring.outer_radius),
        }
    }

    /// Pose of its centre for a node at the pose `node`.
    pub(crate) fn centre(&self, node: &Pose) -> Pose {
        node.advanced(self.to_centre())
    }
}

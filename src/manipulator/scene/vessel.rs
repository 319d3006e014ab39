//! Tables `[vessel]` and `[feed]` of a scene: the vessel's lumen and wall, and the shaft that is pushed in.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::tube::BackboneEntries;
use super::units::{MM_PER_M, PA_PER_MPA};
use crate::error::Error;
use crate::vessel::{Branch, Lumen, Vessel, Wall};

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, default)]
pub(super) struct VesselEntries {
    /// Young's modulus of the wall.
    pub(super) wall_modulus_mpa: f64,
    /// Coefficient of Coulomb friction: about 0.04 oiled or wet, 1 dry silicone.
    pub(super) friction: f64,
    /// Closed STL file in mm instead of branches; its path is relative to the scene.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) mesh_stl: Option<String>,
    /// A tube about a centreline. One table for each; where they overlap they are open to each other.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) branch: Vec<BranchEntries>,
}

impl Default for VesselEntries {
    /// A soft silicone without friction.
    fn default() -> Self {
        Self { wall_modulus_mpa: 1.0, friction: 0.0, mesh_stl: None, branch: Vec::new() }
    }
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(super) struct BranchEntries {
    /// Name for messages; each branch has its own.
    pub(super) name: String,
    /// Points of its centreline, at least two.
    pub(super) points_mm: Vec<[f64; 3]>,
    /// Radius: one number, or a list with one for each point.
    pub(super) radius_mm: RadiusEntry,
}

/// One radius for all points, or one for each.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(untagged, expecting = "a number, or a list with one number for each point")]
pub(super) enum RadiusEntry {
    Same(f64),
    Each(Vec<f64>),
}

/// How a device is held at its base. Its number is that of the FMU's enumeration.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum FeedMode {
    /// The base holds the first body.
    #[default]
    Clamped = 0,
    /// The base is a port through which a shaft of given length is pushed in.
    Insertion = 1,
    /// A given force pushes the shaft in through the port; the length follows.
    Force = 2,
}

#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, default)]
pub(super) struct FeedEntries {
    /// How the device is held at its base.
    pub(super) mode: FeedMode,
    /// Length of shaft inside the port; in mode `force` where the search begins.
    pub(super) insertion_mm: f64,
    /// Turn of the shaft about its axis.
    pub(super) roll_deg: f64,
    /// Push on the shaft in mode `force`; left out: 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) force_n: Option<f64>,
    /// The shaft. Left out: the backbone goes on behind the base.
    ///
    /// Its stiffness is either `shore_a` or `elastic_modulus_mpa`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) shaft: Option<BackboneEntries>,
}

impl VesselEntries {
    /// The vessel; `mesh` is what was found under the name of its mesh.
    pub(super) fn si(&self, mesh: Option<&Result<Lumen, Error>>) -> Result<Vessel, Error> {
        Ok(Vessel { wall: self.wall()?, lumen: self.lumen(mesh)? })
    }

    fn wall(&self) -> Result<Wall, Error> {
        Wall::new(self.wall_modulus_mpa * PA_PER_MPA)?.with_friction(self.friction)
    }

    /// Checks all but what depends on the mesh.
    pub(super) fn check_before_mesh(&self) -> Result<(), Error> {
        self.wall()?;
        let is_mesh = self.mesh_stl.is_some() && self.branch.is_empty();
        if is_mesh { Ok(()) } else { self.lumen(None).map(|_| ()) }
    }
}

impl BranchEntries {
    pub(super) fn si(&self) -> Result<Branch, Error> {
        let points: Vec<Vector3<f64>> =
            self.points_mm.iter().map(|point| Vector3::from(*point) / MM_PER_M).collect();
        let radii: Vec<f64> = match &self.radius_mm {
            RadiusEntry::Same(radius) => vec![radius / MM_PER_M; points.len()],
            RadiusEntry::Each(radii) => radii.iter().map(|radius| radius / MM_PER_M).collect(),
        };
        Branch::new(&self.name, &points, &radii)
    }
}

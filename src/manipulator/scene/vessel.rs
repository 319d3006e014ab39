//! Tables `[vessel]` and `[feed]` of a scene: the vessel's lumen and wall, and the shaft that is pushed in.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::tube::BackboneEntries;
use super::units::{MM_PER_M, PA_PER_MPA};
use crate::error::Error;
use crate::vessel::{Branch, Lumen, Vessel, Wall};

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct VesselEntries {
    pub(super) wall_modulus_mpa: f64,
    pub(super) friction: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) mesh_stl: Option<String>,
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
#[serde(deny_unknown_fields)]
pub(super) struct BranchEntries {
    pub(super) name: String,
    pub(super) points_mm: Vec<[f64; 3]>,
    pub(super) radius_mm: RadiusEntry,
}

/// One radius for all points, or one for each.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(untagged, expecting = "a number, or a list with one number for each point")]
pub(super) enum RadiusEntry {
    Same(f64),
    Each(Vec<f64>),
}

/// How a device is held at its base. Its number is that of the FMU's enumeration.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
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
#[serde(deny_unknown_fields, default)]
pub(super) struct FeedEntries {
    pub(super) mode: FeedMode,
    pub(super) insertion_mm: f64,
    pub(super) roll_deg: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) force_n: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) shaft: Option<BackboneEntries>,
}

impl VesselEntries {
    /// The vessel; `mesh` is what was found under the name of its mesh.
    pub(super) fn si(&self, mesh: Option<&Result<Lumen, Error>>) -> Result<Vessel, Error> {
        let wall = Wall::new(self.wall_modulus_mpa * PA_PER_MPA)?.with_friction(self.friction)?;
        Ok(Vessel { lumen: self.lumen(mesh)?, wall })
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

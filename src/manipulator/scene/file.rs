//! The tables and keys of a scene file, as written: units in the names.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::choices;
use super::numbers::Numbers;
use super::pose::TURN_AXIS;
use super::sections::{GroupEntries, SectionEntries};
use super::segments::{HelixEntries, RingEntries};
use super::sources::{CoilEntries, Magnets};
use super::tube::{BackboneEntries, GuidewireEntries};
use super::units::MM_PER_M;
use super::vessel::{FeedEntries, VesselEntries};
use crate::equilibrium::{Interaction, Settings};
use crate::manipulator::way::WayRow;
use crate::vessel::Lumen;

/// A scene as its file states it, with all omitted entries filled in.
///
/// Its numbers are those of the file, not in SI units: writing it and reading it back changes no bit.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, default)]
pub struct SceneFile {
    /// The device: what is built.
    ///
    /// A chain of segments, each a soft magnetic helix and the ring magnet at its end, a plain magnetised rod, or any sections in a row.
    pub(super) design: DesignEntries,
    /// A background field: uniform, and changing linearly about the origin.
    pub(super) field: FieldEntries,
    /// A magnet outside: coaxial cylinders along `z`, or one piece of a `shape`. Left out: no magnet.
    ///
    /// An empty table is the pair of the paper, 120 mm below the middle of the device. Several magnets are several tables `[[magnet]]`.
    #[serde(skip_serializing_if = "Magnets::are_none")]
    pub(super) magnet: Magnets,
    /// A coil: a winding about the `z` of its frame, with an iron core or without. One table for each.
    ///
    /// The limit is that of coils and magnets after the first together.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) coil: Vec<CoilEntries>,
    /// Where the device is clamped; unloaded it points along the `z` of the base.
    ///
    /// With a shaft (table `[feed]`) it is the pose of the port.
    pub(super) base: BaseEntries,
    /// Forces and moments on the device, fixed in the world frame.
    pub(super) load: LoadEntries,
    /// Gravity, from which the device has its weight.
    pub(super) gravity: GravityEntries,
    /// What is computed, and how.
    pub(super) model: ModelEntries,
    /// A vessel around the device. Left out: none.
    ///
    /// Either `mesh_stl` or at least one `[[vessel.branch]]`; `mcm init --vessel aorta` prints an aorta.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) vessel: Option<VesselEntries>,
    /// A shaft that is pushed in through the base, which then is the port. Left out: none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) feed: Option<FeedEntries>,
    /// A wire inside, straight when unloaded, that slides and turns freely. Left out: none.
    ///
    /// The bodies that it is in need a lumen.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) guidewire: Option<GuidewireEntries>,
    /// The way to the inputs of the scene, which decides between several shapes.
    ///
    /// Left out: directly from the unloaded shape.
    #[serde(skip_serializing_if = "StartEntries::are_none")]
    pub(super) start: StartEntries,
    /// Standard deviations of any numbers of the scene, for `mcm solve --uncertainty`.
    ///
    /// A key in quotes names a number by its table and key, with indices from 1: `"field.uniform_mt[2]"`; the deviation has the unit of that key.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub(super) uncertainty: BTreeMap<String, f64>,
    /// Correlations of two of these deviations; left out: 0.
    ///
    /// The key names both numbers: `"design.helix.shore_a, design.ring.remanence_t"`.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub(super) correlation: BTreeMap<String, f64>,
    /// The lumen of the mesh that the vessel names, or why there is none.
    #[serde(skip)]
    pub(super) mesh: Option<Result<Lumen, crate::error::Error>>,
}

#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, default)]
pub(super) struct StartEntries {
    /// Inputs that are solved before the scene's own, table by table; at most 200.
    ///
    /// The keys are names of inputs in the FMU, in quotes, the numbers in SI units: `"magnet.position[3]" = -0.01`. An input that a row does
    /// not name is as the scene states it.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) way: Vec<WayRow>,
}

impl StartEntries {
    fn are_none(&self) -> bool {
        self.way.is_empty()
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub(super) enum DesignKind {
    /// Helices with ring magnets between them.
    #[default]
    Segments,
    /// A plain magnetised rod.
    Cylinder,
    /// Any tubes, rods, magnets and balls in a row.
    Sections,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub(super) enum SpiralName {
    /// All right-handed, as built.
    Helical,
    /// Spread evenly over the circle.
    Axisymmetric,
    /// Every second one mirrored.
    Alternating,
}

/// Table `[design]`: which keys may be present depends on `kind`.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, default)]
pub(super) struct DesignEntries {
    /// Kind of the device.
    pub(super) kind: DesignKind,
    /// Number of segments, each a helix and the ring at its end.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) segments: Option<usize>,
    /// Whether there is a ring at the base.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) base_magnet: Option<bool>,
    /// Whether there is a ring at the tip.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) tip_magnet: Option<bool>,
    /// How the spirals are wound.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) spiral: Option<SpiralName>,
    /// Turns the spirals about the axis: one number, or a list with one for each segment.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) spiral_start_deg: Option<Numbers>,
    /// Length of the rod; no default.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) length_mm: Option<f64>,
    /// Outer radius of the rod; no default.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) radius_mm: Option<f64>,
    /// Radius of the rod's bore; left out: 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) inner_radius_mm: Option<f64>,
    /// Shore A hardness of the rod's rubber without particles; left out: as of a helix.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) shore_a: Option<f64>,
    /// Young's modulus of the rod.
    ///
    /// Together with `remanence_t` it takes the place of `shore_a`, `volume_fraction` and `particle_remanence_t`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) elastic_modulus_mpa: Option<f64>,
    /// Poisson's ratio of the rod; left out: as of a helix.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) poisson: Option<f64>,
    /// Volume fraction of magnetic particles in the rod; left out: as of a helix.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) volume_fraction: Option<f64>,
    /// Remanence of these particles; left out: as of a helix.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) particle_remanence_t: Option<f64>,
    /// Remanence of the rod along its axis, with `elastic_modulus_mpa`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) remanence_t: Option<f64>,
    /// Density of the rod; left out: that of the mixture, or 1000.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) density_kg_m3: Option<f64>,
    /// The helix of every segment; the defaults are those of Table 1 of the paper.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) helix: Option<HelixEntries>,
    /// The ring magnets; their radii are those of the helix.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) ring: Option<RingEntries>,
    /// A tube through the bores of all bodies. Left out: none.
    ///
    /// Its stiffness is either `shore_a` or `elastic_modulus_mpa`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) backbone: Option<BackboneEntries>,
    /// A section of a device of kind `"sections"`, proximal to distal: one table for each.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) section: Vec<SectionEntries>,
    /// Sections that are repeated together. One table for each group.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) group: Vec<GroupEntries>,
}

#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, default)]
pub(super) struct FieldEntries {
    /// Uniform field in the world frame.
    pub(super) uniform_mt: [f64; 3],
    /// Right-handed turn of the uniform field about `turn_axis`.
    pub(super) turn_deg: f64,
    /// Axis of that turn in the world frame; the default takes +z towards +y.
    ///
    /// It may have any length but 0.
    pub(super) turn_axis: [f64; 3],
    /// Gradient of the linear field: dBx/dx, dBx/dy, dBx/dz, dBy/dy, dBy/dz.
    ///
    /// The other four follow, as such a field has neither sources nor currents.
    pub(super) gradient_t_per_m: [f64; 5],
}

impl Default for FieldEntries {
    fn default() -> Self {
        Self { uniform_mt: [0.0; 3], turn_deg: 0.0, turn_axis: TURN_AXIS, gradient_t_per_m: [0.0; 5] }
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, default)]
pub(super) struct BaseEntries {
    /// Position of the clamped end.
    pub(super) position_mm: [f64; 3],
    /// Unit quaternion, scalar first, from its frame to the world's.
    pub(super) orientation_wxyz: [f64; 4],
    /// Right-handed turn of the base about `turn_axis` through its position.
    pub(super) turn_deg: f64,
    /// Axis of that turn in the world frame; the default takes +z towards +y.
    ///
    /// It may have any length but 0.
    pub(super) turn_axis: [f64; 3],
}

impl Default for BaseEntries {
    fn default() -> Self {
        Self {
            position_mm: [0.0; 3],
            orientation_wxyz: [1.0, 0.0, 0.0, 0.0],
            turn_deg: 0.0,
            turn_axis: TURN_AXIS,
        }
    }
}

#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, default)]
pub(super) struct LoadEntries {
    /// Force on the tip.
    pub(super) tip_force_n: [f64; 3],
    /// Moment on the tip.
    pub(super) tip_moment_nm: [f64; 3],
    /// Forces on the centres of the rings, from the base on; left out: none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) ring_force_n: Option<Vec<[f64; 3]>>,
}

#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, default)]
pub(super) struct GravityEntries {
    /// Acceleration in the world frame; on Earth [0.0, 0.0, -9.81] where z is up.
    pub(super) acceleration_m_s2: [f64; 3],
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, default)]
pub(super) struct ModelEntries {
    /// Level of interaction: which magnetic parts act on which.
    #[serde(serialize_with = "choices::write_level", deserialize_with = "choices::read_level")]
    #[cfg_attr(test, schemars(schema_with = "choices::levels"))]
    pub(super) interaction: Interaction,
    /// How the equilibrium is found: `potential`, or one of the others to compare with.
    #[serde(deserialize_with = "choices::read_method")]
    #[cfg_attr(test, schemars(schema_with = "choices::methods"))]
    pub(super) method: String,
    /// Whether windings that touch stop the bending; left out: the level decides, `auto` has it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) bending_stop: Option<bool>,
    /// How far the tip may be from the converged answer of the model.
    pub(super) tolerance_position_mm: f64,
    /// How far the tip may be turned against the converged answer of the model.
    pub(super) tolerance_angle_deg: f64,
    /// How far the tip may be from that, relative to its distance from its unloaded place; 0: any.
    ///
    /// The smaller of this and `tolerance_position_mm` holds, where this is never less than 1e-5 mm.
    pub(super) tolerance_relative: f64,
    /// Processor time that one solve may take.
    pub(super) time_budget_s: f64,
    /// Number of iterations that one solve may take.
    pub(super) iterations: usize,
    /// Whether the wrench of magnets and coils on one another is computed as well.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub(super) mutual_wrenches: bool,
}

impl Default for ModelEntries {
    fn default() -> Self {
        let settings = Settings::default();
        Self {
            interaction: Interaction::Auto,
            method: choices::POTENTIAL.into(),
            bending_stop: None,
            tolerance_position_mm: settings.tolerance_position * MM_PER_M,
            tolerance_angle_deg: settings.tolerance_angle.to_degrees(),
            tolerance_relative: settings.tolerance_relative,
            time_budget_s: settings.time_budget,
            iterations: settings.iterations as usize,
            mutual_wrenches: false,
        }
    }
}

//! The tables and keys of a scene file, as written: units in the names.

use std::collections::BTreeMap;

use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::pose::TURN_AXIS;
use super::sources::{CoilEntries, Magnets};
use super::spiral_start::SpiralStartEntry;
use super::tube::{BackboneEntries, GuidewireEntries};
use super::vessel::{FeedEntries, VesselEntries};
use crate::equilibrium::{Interaction, Settings};
use crate::methods::Method;
use crate::vessel::Lumen;

/// A scene as its file states it, with all omitted entries filled in.
///
/// Its numbers are those of the file, not in SI units: writing it and reading it back changes no bit.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct SceneFile {
    pub(super) design: DesignEntries,
    pub(super) field: FieldEntries,
    #[serde(skip_serializing_if = "Magnets::are_none")]
    pub(super) magnet: Magnets,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) coil: Vec<CoilEntries>,
    pub(super) base: BaseEntries,
    pub(super) load: LoadEntries,
    pub(super) gravity: GravityEntries,
    pub(super) model: ModelEntries,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) vessel: Option<VesselEntries>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) feed: Option<FeedEntries>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) guidewire: Option<GuidewireEntries>,
    /// Standard deviations by key.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub(super) uncertainty: BTreeMap<String, f64>,
    /// Correlations by two keys.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub(super) correlation: BTreeMap<String, f64>,
    /// The lumen of the mesh that the vessel names, or why there is none.
    #[serde(skip)]
    pub(super) mesh: Option<Result<Lumen, crate::error::Error>>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum DesignKind {
    #[default]
    Segments,
    Cylinder,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum SpiralName {
    Helical,
    Axisymmetric,
    Alternating,
}

/// Table `[design]`: which keys may be present depends on `kind`.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct DesignEntries {
    pub(super) kind: DesignKind,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) segments: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) base_magnet: Option<bool>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) tip_magnet: Option<bool>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) spiral: Option<SpiralName>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) spiral_start_deg: Option<SpiralStartEntry>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) length_mm: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) radius_mm: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) inner_radius_mm: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) shore_a: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) elastic_modulus_mpa: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) poisson: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) volume_fraction: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) particle_remanence_t: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) remanence_t: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) density_kg_m3: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) helix: Option<HelixEntries>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) ring: Option<RingEntries>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) backbone: Option<BackboneEntries>,
}

#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct HelixEntries {
    pub(super) length_mm: f64,
    pub(super) boundary_angle_deg: f64,
    pub(super) radius_mm: f64,
    pub(super) windings: f64,
    pub(super) core_outer_radius_mm: f64,
    pub(super) core_inner_radius_mm: f64,
    pub(super) shore_a: f64,
    pub(super) poisson: f64,
    pub(super) volume_fraction: f64,
    pub(super) particle_remanence_t: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) density_kg_m3: Option<f64>,
}

impl Default for HelixEntries {
    /// Table 1 of Richter et al.
    fn default() -> Self {
        Self {
            length_mm: 4.0,
            boundary_angle_deg: 40.0,
            radius_mm: 2.0,
            windings: 2.0,
            core_outer_radius_mm: 0.95,
            core_inner_radius_mm: 0.75,
            shore_a: 33.0,
            poisson: 0.4,
            volume_fraction: 0.25,
            particle_remanence_t: 1.0,
            density_kg_m3: None,
        }
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct RingEntries {
    pub(super) length_mm: f64,
    pub(super) remanence_t: f64,
    pub(super) recoil_permeability: f64,
    pub(super) density_kg_m3: f64,
}

impl Default for RingEntries {
    /// Table 1 of Richter et al.; the density is that of `NdFeB`, rounded.
    fn default() -> Self {
        Self { length_mm: 1.0, remanence_t: 1.35, recoil_permeability: 1.0, density_kg_m3: 7000.0 }
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct FieldEntries {
    pub(super) uniform_mt: [f64; 3],
    pub(super) turn_deg: f64,
    pub(super) turn_axis: [f64; 3],
    pub(super) gradient_t_per_m: [f64; 5],
}

impl Default for FieldEntries {
    fn default() -> Self {
        Self { uniform_mt: [0.0; 3], turn_deg: 0.0, turn_axis: TURN_AXIS, gradient_t_per_m: [0.0; 5] }
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct BaseEntries {
    pub(super) position_mm: [f64; 3],
    pub(super) orientation_wxyz: [f64; 4],
    pub(super) turn_deg: f64,
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
#[serde(deny_unknown_fields, default)]
pub(super) struct LoadEntries {
    pub(super) tip_force_n: [f64; 3],
    pub(super) tip_moment_nm: [f64; 3],
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) ring_force_n: Option<Vec<[f64; 3]>>,
}

#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct GravityEntries {
    pub(super) acceleration_m_s2: [f64; 3],
}

#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct ModelEntries {
    #[serde(serialize_with = "write_level", deserialize_with = "read_level")]
    pub(super) interaction: Interaction,
    #[serde(serialize_with = "write_method", deserialize_with = "read_method")]
    pub(super) method: Method,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) bending_stop: Option<bool>,
    pub(super) time_budget_s: f64,
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub(super) mutual_wrenches: bool,
}

impl Default for ModelEntries {
    fn default() -> Self {
        Self {
            interaction: Interaction::Auto,
            method: Method::Potential,
            bending_stop: None,
            time_budget_s: Settings::default().time_budget,
            mutual_wrenches: false,
        }
    }
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde hands over a reference")]
fn write_level<S: Serializer>(level: &Interaction, out: S) -> Result<S::Ok, S::Error> {
    out.serialize_str(level.name())
}

fn read_level<'de, D: Deserializer<'de>>(input: D) -> Result<Interaction, D::Error> {
    let name = String::deserialize(input)?;
    let known = Interaction::ALL.iter().map(|row| row.1);
    Interaction::named(&name).ok_or_else(|| unknown(&name, "not a level", known))
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde hands over a reference")]
fn write_method<S: Serializer>(method: &Method, out: S) -> Result<S::Ok, S::Error> {
    out.serialize_str(method.name())
}

fn read_method<'de, D: Deserializer<'de>>(input: D) -> Result<Method, D::Error> {
    let name = String::deserialize(input)?;
    let known = Method::ALL.iter().map(|row| row.1);
    Method::named(&name).ok_or_else(|| unknown(&name, "not available in this version", known))
}

fn unknown<E: Error>(name: &str, is: &str, known: impl Iterator<Item = &'static str>) -> E {
    let known: Vec<&str> = known.collect();
    E::custom(format!("\"{name}\" is {is}: choose one of {}", known.join(", ")))
}

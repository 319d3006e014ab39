//! The keys under which a scene file holds the quantities of a specification, and their units there.

use core::f64::consts::PI;

use toml::Value;

use super::path::entry;
use super::units::{MM_PER_M, PA_PER_MPA};
use crate::error::Error;
use crate::magnetics::Assembly;

/// Unit of a number in a scene file.
#[derive(Debug, Clone, Copy)]
enum Unit {
    /// That of the library.
    Same,
    Millimetre,
    Degree,
    Megapascal,
}

impl Unit {
    /// That of a key, which its name ends with.
    fn of(key: &str) -> Self {
        match key.rsplit('_').next() {
            Some("mm") => Self::Millimetre,
            Some("deg") => Self::Degree,
            Some("mpa") => Self::Megapascal,
            _ => Self::Same,
        }
    }

    /// A number of the file as the library has it.
    fn si(self, number: f64) -> f64 {
        match self {
            Self::Same => number,
            Self::Millimetre => number / MM_PER_M,
            Self::Degree => number.to_radians(),
            Self::Megapascal => number * PA_PER_MPA,
        }
    }

    /// A range in words, with its limits in this unit.
    fn range(self, words: &str) -> String {
        let factor = match self {
            Self::Same => return words.to_owned(),
            Self::Millimetre => MM_PER_M,
            Self::Degree => 180.0 / PI,
            Self::Megapascal => 1.0 / PA_PER_MPA,
        };
        let limit = |word: &str| {
            let number = if word == "pi" { Some(PI) } else { word.parse().ok() };
            // Rounded to the digits that matter.
            number.map_or_else(
                || word.to_owned(),
                |number: f64| format!("{}", (number * factor * 1e9).round() / 1e9),
            )
        };
        words.split(' ').map(limit).collect::<Vec<_>>().join(" ")
    }
}

/// Quantities as [`crate::design`] and [`crate::magnetics`] name them, and the keys that may hold them. `*` is the number of a
/// cylinder.
const KEYS: [(&str, &str); 52] = [
    ("number of segments", "design.segments"),
    ("helix length L (m)", "design.helix.length_mm"),
    ("boundary angle Theta (rad)", "design.helix.boundary_angle_deg"),
    ("helix radius R (m)", "design.helix.radius_mm"),
    ("windings W", "design.helix.windings"),
    ("core outer radius r_oc (m)", "design.helix.core_outer_radius_mm"),
    ("core inner radius r_ic (m)", "design.helix.core_inner_radius_mm"),
    ("Shore A hardness", "design.helix.shore_a"),
    ("Poisson's ratio", "design.helix.poisson"),
    ("volume fraction Phi", "design.helix.volume_fraction"),
    ("particle remanence B_r (T)", "design.helix.particle_remanence_t"),
    ("density (kg/m3)", "design.helix.density_kg_m3"),
    ("ring length L_mag (m)", "design.ring.length_mm"),
    ("ring remanence B_r (T)", "design.ring.remanence_t"),
    ("ring recoil permeability mu_r", "design.ring.recoil_permeability"),
    ("density (kg/m3)", "design.ring.density_kg_m3"),
    ("backbone outer radius (m)", "design.backbone.outer_radius_mm"),
    ("backbone inner radius (m)", "design.backbone.inner_radius_mm"),
    ("Shore A hardness", "design.backbone.shore_a"),
    ("Young's modulus (Pa)", "design.backbone.elastic_modulus_mpa"),
    ("Poisson's ratio", "design.backbone.poisson"),
    ("density (kg/m3)", "design.backbone.density_kg_m3"),
    ("cylinder length (m)", "design.length_mm"),
    ("cylinder radius (m)", "design.radius_mm"),
    ("cylinder inner radius (m)", "design.inner_radius_mm"),
    ("Shore A hardness", "design.shore_a"),
    ("Young's modulus (Pa)", "design.elastic_modulus_mpa"),
    ("Poisson's ratio", "design.poisson"),
    ("volume fraction Phi", "design.volume_fraction"),
    ("particle remanence B_r (T)", "design.particle_remanence_t"),
    ("cylinder remanence (T)", "design.remanence_t"),
    ("density (kg/m3)", "design.density_kg_m3"),
    ("shaft outer radius (m)", "feed.shaft.outer_radius_mm"),
    ("shaft inner radius (m)", "feed.shaft.inner_radius_mm"),
    ("Shore A hardness", "feed.shaft.shore_a"),
    ("Young's modulus (Pa)", "feed.shaft.elastic_modulus_mpa"),
    ("Poisson's ratio", "feed.shaft.poisson"),
    ("density (kg/m3)", "feed.shaft.density_kg_m3"),
    ("guidewire radius (m)", "guidewire.radius_mm"),
    ("Young's modulus (Pa)", "guidewire.elastic_modulus_mpa"),
    ("vessel wall modulus (Pa)", "vessel.wall_modulus_mpa"),
    ("vessel friction", "vessel.friction"),
    ("magnet outer radius (m)", "magnet.cylinders[*].radius_mm"),
    ("magnet inner radius (m)", "magnet.cylinders[*].inner_radius_mm"),
    ("magnet length (m)", "magnet.cylinders[*].length_mm"),
    ("magnet offset (m)", "magnet.cylinders[*].offset_mm"),
    ("magnet remanence (T)", "magnet.cylinders[*].remanence_t"),
    ("coil inner radius (m)", "coil[*].inner_radius_mm"),
    ("coil outer radius (m)", "coil[*].outer_radius_mm"),
    ("coil length (m)", "coil[*].length_mm"),
    ("coil turns", "coil[*].turns"),
    ("coil reach (m)", "coil[*].reach_mm"),
];

/// What follows from several keys of the helix.
const HEIGHT: &str = "winding height h (m)";

/// The same error with the key and the number as `file` writes them, if it is of a quantity with a key.
pub(super) fn as_written(error: Error, file: &Value) -> Error {
    let Error::Range { quantity, value, allowed } = &error else { return error };
    let written = |key: &str| entry(&mut file.clone(), key).ok().and_then(|entry| number(entry));
    let candidates = KEYS.iter().filter(|(name, _)| name == quantity).flat_map(|(_, key)| {
        let cylinders = if key.contains('*') { 1..=Assembly::MOST_MAGNETS } else { 1..=1 };
        cylinders.map(|cylinder| key.replace('*', &cylinder.to_string()))
    });
    let magnets = file.get("magnet").and_then(Value::as_array).map_or(0, Vec::len);
    let candidates = candidates.flat_map(|key| match key.strip_prefix("magnet.") {
        Some(rest) if magnets > 0 => (1..=magnets).map(|magnet| format!("magnet[{magnet}].{rest}")).collect(),
        _ => vec![key],
    });
    for key in candidates {
        let unit = Unit::of(&key);
        if let Some(number) = written(&key).filter(|number| unit.si(*number).total_cmp(value).is_eq()) {
            return Error::range(key, number, unit.range(allowed));
        }
    }
    if quantity == HEIGHT { Error::range(format!("design.helix: {HEIGHT}"), *value, allowed) } else { error }
}

fn number(entry: &Value) -> Option<f64> {
    entry.as_float().or_else(|| entry.as_integer().map(|whole| whole as f64))
}

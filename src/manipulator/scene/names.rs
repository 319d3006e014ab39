//! The keys under which a scene file holds the quantities of a specification, and their units there.

use core::f64::consts::PI;

use toml::Value;

use super::path::entry;
use super::units::{MM_PER_M, PA_PER_MPA};
use crate::design::limits as design;
use crate::error::{Error, Interval};
use crate::magnetics::{Assembly, limits as magnetics};
use crate::vessel::{Wall, friction};

/// Unit of a number in a scene file.
#[derive(Debug, Clone, Copy)]
pub(super) enum Unit {
    /// That of the library.
    Same,
    Millimetre,
    Degree,
    Megapascal,
}

impl Unit {
    /// That of a key, which its name ends with.
    pub(super) fn of(key: &str) -> Self {
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

    /// How many of it make the unit of the library.
    pub(super) fn per_si(self) -> f64 {
        match self {
            Self::Same => 1.0,
            Self::Millimetre => MM_PER_M,
            Self::Degree => 180.0 / PI,
            Self::Megapascal => 1.0 / PA_PER_MPA,
        }
    }

    /// A range in words, with its limits in this unit.
    fn range(self, words: &str) -> String {
        let factor = self.per_si();
        let limit = |word: &str| {
            let number = if word == "pi" { Some(PI) } else { word.parse().ok() };
            // Rounded to the digits that matter.
            number.map_or_else(
                || word.to_owned(),
                |number: f64| format!("{}", (number * factor * 1e9).round() / 1e9),
            )
        };
        match self {
            Self::Same => words.to_owned(),
            _ => words.split(' ').map(limit).collect::<Vec<_>>().join(" "),
        }
    }
}

/// Quantities as [`crate::design`] and [`crate::magnetics`] name them, the keys that may hold them, and their range in the units of
/// the library. `*` is the number of a cylinder.
const KEYS: [(&str, &str, Interval); 52] = [
    ("number of segments", "design.segments", design::SEGMENTS),
    ("helix length L (m)", "design.helix.length_mm", design::LENGTH),
    ("boundary angle Theta (rad)", "design.helix.boundary_angle_deg", design::BOUNDARY_ANGLE),
    ("helix radius R (m)", "design.helix.radius_mm", design::LENGTH),
    ("windings W", "design.helix.windings", design::WINDINGS),
    ("core outer radius r_oc (m)", "design.helix.core_outer_radius_mm", design::CORE_OUTER_RADIUS),
    ("core inner radius r_ic (m)", "design.helix.core_inner_radius_mm", design::CORE_INNER_RADIUS),
    ("Shore A hardness", "design.helix.shore_a", design::SHORE_A),
    ("Poisson's ratio", "design.helix.poisson", design::POISSON),
    ("volume fraction Phi", "design.helix.volume_fraction", design::VOLUME_FRACTION),
    ("particle remanence B_r (T)", "design.helix.particle_remanence_t", design::REMANENCE),
    ("density (kg/m3)", "design.helix.density_kg_m3", design::DENSITY),
    ("ring length L_mag (m)", "design.ring.length_mm", design::LENGTH),
    ("ring remanence B_r (T)", "design.ring.remanence_t", design::REMANENCE),
    ("ring recoil permeability mu_r", "design.ring.recoil_permeability", design::RECOIL_PERMEABILITY),
    ("density (kg/m3)", "design.ring.density_kg_m3", design::DENSITY),
    ("backbone outer radius (m)", "design.backbone.outer_radius_mm", design::BACKBONE_OUTER_RADIUS),
    ("backbone inner radius (m)", "design.backbone.inner_radius_mm", design::TUBE_INNER_RADIUS),
    ("Shore A hardness", "design.backbone.shore_a", design::SHORE_A),
    ("Young's modulus (Pa)", "design.backbone.elastic_modulus_mpa", design::ELASTIC_MODULUS),
    ("Poisson's ratio", "design.backbone.poisson", design::POISSON),
    ("density (kg/m3)", "design.backbone.density_kg_m3", design::DENSITY),
    ("cylinder length (m)", "design.length_mm", design::LENGTH),
    ("cylinder radius (m)", "design.radius_mm", design::LENGTH),
    ("cylinder inner radius (m)", "design.inner_radius_mm", design::ROD_INNER_RADIUS),
    ("Shore A hardness", "design.shore_a", design::SHORE_A),
    ("Young's modulus (Pa)", "design.elastic_modulus_mpa", design::ELASTIC_MODULUS),
    ("Poisson's ratio", "design.poisson", design::POISSON),
    ("volume fraction Phi", "design.volume_fraction", design::VOLUME_FRACTION),
    ("particle remanence B_r (T)", "design.particle_remanence_t", design::REMANENCE),
    ("cylinder remanence (T)", "design.remanence_t", design::REMANENCE),
    ("density (kg/m3)", "design.density_kg_m3", design::DENSITY),
    ("shaft outer radius (m)", "feed.shaft.outer_radius_mm", design::LENGTH),
    ("shaft inner radius (m)", "feed.shaft.inner_radius_mm", design::TUBE_INNER_RADIUS),
    ("Shore A hardness", "feed.shaft.shore_a", design::SHORE_A),
    ("Young's modulus (Pa)", "feed.shaft.elastic_modulus_mpa", design::ELASTIC_MODULUS),
    ("Poisson's ratio", "feed.shaft.poisson", design::POISSON),
    ("density (kg/m3)", "feed.shaft.density_kg_m3", design::DENSITY),
    ("guidewire radius (m)", "guidewire.radius_mm", design::GUIDEWIRE_RADIUS),
    ("Young's modulus (Pa)", "guidewire.elastic_modulus_mpa", design::ELASTIC_MODULUS),
    ("vessel wall modulus (Pa)", "vessel.wall_modulus_mpa", Wall::MODULUS),
    ("vessel friction", "vessel.friction", friction::COEFFICIENT),
    ("magnet outer radius (m)", "magnet.cylinders[*].radius_mm", magnetics::SIZE),
    ("magnet inner radius (m)", "magnet.cylinders[*].inner_radius_mm", magnetics::MAGNET_INNER_RADIUS),
    ("magnet length (m)", "magnet.cylinders[*].length_mm", magnetics::SIZE),
    ("magnet offset (m)", "magnet.cylinders[*].offset_mm", magnetics::MAGNET_OFFSET),
    ("magnet remanence (T)", "magnet.cylinders[*].remanence_t", magnetics::MAGNET_REMANENCE),
    ("coil inner radius (m)", "coil[*].inner_radius_mm", magnetics::COIL_INNER_RADIUS),
    ("coil outer radius (m)", "coil[*].outer_radius_mm", magnetics::SIZE),
    ("coil length (m)", "coil[*].length_mm", magnetics::SIZE),
    ("coil turns", "coil[*].turns", magnetics::COIL_TURNS),
    ("coil reach (m)", "coil[*].reach_mm", magnetics::SIZE),
];

/// The range of every key of [`KEYS`], in the unit of the key.
#[cfg(test)]
pub(super) fn ranges() -> impl Iterator<Item = (&'static str, Interval)> {
    KEYS.iter().map(|(_, key, range)| (*key, range.scaled(Unit::of(key).per_si())))
}

/// What follows from several keys of the helix.
const HEIGHT: &str = "winding height h (m)";

/// The same error with the key and the number as `file` writes them, if it is of a quantity with a key.
pub(super) fn as_written(error: Error, file: &Value) -> Error {
    let Error::Range { quantity, value, allowed } = &error else { return error };
    let written = |key: &str| entry(&mut file.clone(), key).ok().and_then(|entry| number(entry));
    let candidates = KEYS.iter().filter(|(name, ..)| name == quantity).flat_map(|(_, key, _)| {
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
            let guess = Unit::rule(&key).and_then(|(rule, unit)| rule.guess(number, unit.per_si()));
            let guess = guess.map_or_else(String::new, |guess| format!("; {guess}"));
            return Error::range(key, number, unit.range(allowed) + &guess);
        }
    }
    if quantity == HEIGHT { Error::range(format!("design.helix: {HEIGHT}"), *value, allowed) } else { error }
}

fn number(entry: &Value) -> Option<f64> {
    entry.as_float().or_else(|| entry.as_integer().map(|whole| whole as f64))
}

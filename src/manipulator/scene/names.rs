//! The keys under which a scene file holds the quantities of a specification, and their units there.

use core::f64::consts::PI;

use toml::Value;

use super::path::entry;
use super::units::{MM_PER_M, PA_PER_MPA};
use crate::error::Error;
#[cfg(test)]
use crate::error::Interval;

/// Unit of a number in a scene file.
#[derive(Debug, Clone, Copy)]
pub(super) enum Unit {
    /// That of the library.
    Same,
    Millimetre,
    Degree,
    DegreePerMillimetre,
    Megapascal,
}

impl Unit {
    /// That of a key, which its name ends with.
    pub(super) fn of(key: &str) -> Self {
        if without_index(key).ends_with("_deg_per_mm") {
            return Self::DegreePerMillimetre;
        }
        match without_index(key).rsplit('_').next() {
            Some("mm") => Self::Millimetre,
            Some("deg") => Self::Degree,
            Some("mpa") => Self::Megapascal,
            _ => Self::Same,
        }
    }

    /// How many of it make the unit of the library.
    pub(super) fn per_si(self) -> f64 {
        match self {
            Self::Same => 1.0,
            Self::Millimetre => MM_PER_M,
            Self::Degree => 180.0 / PI,
            Self::DegreePerMillimetre => 180.0 / PI / MM_PER_M,
            Self::Megapascal => 1.0 / PA_PER_MPA,
        }
    }

    /// A number of it in the unit of the library.
    pub(super) fn in_si(self, number: f64) -> f64 {
        match self {
            Self::Same => number,
            Self::Millimetre => number / MM_PER_M,
            Self::Degree => number.to_radians(),
            Self::DegreePerMillimetre => number.to_radians() * MM_PER_M,
            Self::Megapascal => number * PA_PER_MPA,
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

/// The key of a list that the key of an entry belongs to, whose unit all entries have.
pub(super) fn without_index(key: &str) -> &str {
    key.trim_end_matches(|end: char| end.is_ascii_digit() || "[*]".contains(end))
}

/// The range of every quantity whose key holds a number, in the unit of the key.
#[cfg(test)]
pub(super) fn ranges() -> impl Iterator<Item = (&'static str, Interval)> {
    use crate::design::quantities::HELIX_WINDING_HEIGHT;
    use crate::{design, equilibrium, magnetics, vessel};

    let tables = [
        design::quantities::ALL,
        equilibrium::quantities::ALL,
        magnetics::quantities::ALL,
        vessel::quantities::ALL,
    ];
    let own = tables.into_iter().flatten().filter(|quantity| **quantity != &HELIX_WINDING_HEIGHT);
    own.map(|quantity| (quantity.key, quantity.interval.scaled(Unit::of(quantity.key).per_si())))
}

/// The error with the key and the number as `file` writes them, if it is of a quantity with a key.
pub(super) fn as_written(error: Error, file: &Value) -> Error {
    let Error::Range { value, allowed, identity: Some(identity), .. } = &error else { return error };
    let mut key = identity.key();
    // A single magnet may be a table instead of a list.
    if !file.get("magnet").is_some_and(Value::is_array) {
        key = key.replace("magnet[1].", "magnet.");
    }
    let Some(number) = entry(&mut file.clone(), &key).ok().and_then(|entry| number(entry)) else {
        return Error::range(format!("{key}: {}", identity.quantity.name), *value, allowed);
    };

    let unit = Unit::of(&key);
    let guess = Unit::rule(&key).and_then(|(rule, unit)| rule.guess(number, unit.per_si()));
    let guess = guess.map_or_else(String::new, |guess| format!("; {guess}"));
    Error::range(key, number, unit.range(allowed) + &guess)
}

fn number(entry: &Value) -> Option<f64> {
    entry.as_float().or_else(|| entry.as_integer().map(|whole| whole as f64))
}

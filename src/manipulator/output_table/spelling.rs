//! Units as names and people spell them.

use super::quantity::Quantity;

/// A unit as names and people spell it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spelled {
    /// What names end with; empty for a pure number.
    pub suffix: &'static str,
    /// The unit for people.
    pub label: &'static str,
    /// How many of it make one SI unit.
    pub per_si: f64,
}

const fn unit(suffix: &'static str, label: &'static str, per_si: f64) -> Spelled {
    Spelled { suffix, label, per_si }
}

pub(super) const NUMBER: Spelled = unit("", "", 1.0);
pub(super) const M: Spelled = unit("m", "m", 1.0);
pub(super) const MM: Spelled = unit("mm", "mm", 1e3);
pub(super) const UM: Spelled = unit("um", "um", 1e6);
const RAD: Spelled = unit("rad", "rad", 1.0);
pub(super) const DEG: Spelled = unit("deg", "deg", 180.0 / core::f64::consts::PI);
const T: Spelled = unit("t", "T", 1.0);
pub(super) const MT: Spelled = unit("mt", "mT", 1e3);
pub(super) const N: Spelled = unit("n", "N", 1.0);
pub(super) const MN: Spelled = unit("mn", "mN", 1e3);
pub(super) const NM: Spelled = unit("nm", "N m", 1.0);
pub(super) const NMM: Spelled = unit("nmm", "N.mm", 1e3);
pub(super) const UNM: Spelled = unit("unm", "mN.mm", 1e6);
pub(super) const J: Spelled = unit("j", "J", 1.0);
const PER_M: Spelled = unit("per_m", "1/m", 1.0);
const PER_MM: Spelled = unit("per_mm", "1/mm", 1e-3);

/// How each unit of the FMU can be spelled, that unit itself first.
const SPELLINGS: [(&str, &[Spelled]); 8] = [
    ("1", &[NUMBER]),
    ("m", &[M, MM, UM]),
    ("rad", &[RAD, DEG]),
    ("T", &[T, MT]),
    ("N", &[N, MN]),
    ("N.m", &[NM, NMM, UNM]),
    ("J", &[J]),
    ("1/m", &[PER_M, PER_MM]),
];

/// Columns of an output: the beginning of their names, and the unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spelling {
    /// What the names begin with.
    pub stem: &'static str,
    /// The unit of the numbers.
    pub unit: Spelled,
}

/// The line of an output in the table for people; `{}` in its label is the number of a magnet or coil, from 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Printed {
    /// What it is called.
    pub label: &'static str,
    /// The unit of the numbers.
    pub unit: Spelled,
    /// What the unit is followed by; empty for nothing.
    pub note: &'static str,
}

impl Quantity {
    /// The units in which it can be spelled, the SI unit first.
    #[must_use]
    pub fn spellings(&self) -> &'static [Spelled] {
        SPELLINGS.iter().find(|(unit, _)| *unit == self.unit).map_or(&[NUMBER], |(_, known)| known)
    }

    /// Its SI unit.
    #[must_use]
    pub fn si(&self) -> Spelled {
        self.spellings()[0]
    }
}

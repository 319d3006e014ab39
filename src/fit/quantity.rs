//! What can be measured.

use nalgebra::Vector3;

use crate::error::Error;
use crate::manipulator::Outputs;

/// An output that can be measured, with its unit in the name; the names are those of the columns of `mcm sweep`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Quantity {
    kind: usize,
    axis: usize,
}

/// A number of the outputs by its name, with three components or one, and its unit in SI.
type Entry = (&'static str, &'static str, f64, fn(&Outputs) -> Vector3<f64>);

const MM: f64 = 1e3;
const MT: f64 = 1e3;

/// What comes before the axis in a name, what comes after, the number of units in the SI unit, and how it is read. Single numbers have
/// no axis.
const ENTRIES: [Entry; 10] = [
    ("alpha", "_deg", 180.0 / core::f64::consts::PI, |o| Vector3::x() * o.tip_angle),
    ("largest_core_angle", "_deg", 180.0 / core::f64::consts::PI, |o| {
        Vector3::x() * o.core_angles.iter().copied().fold(0.0, f64::max)
    }),
    ("tip", "_mm", MM, |o| o.tip.position),
    ("magnetic_force", "_n", 1.0, |o| o.magnetic_force),
    ("magnetic_torque", "_nm", 1.0, |o| o.magnetic_torque),
    ("base_reaction_force", "_n", 1.0, |o| o.base_reaction_force),
    ("base_reaction_moment", "_nm", 1.0, |o| o.base_reaction_moment),
    ("magnet_reaction_force", "_n", 1.0, |o| o.magnet_reaction_force),
    ("magnet_reaction_torque", "_nm", 1.0, |o| o.magnet_reaction_torque),
    ("tip_field", "_mt", MT, |o| o.tip_field),
];

/// Number of entries, at the beginning, that are single numbers.
const SINGLE: usize = 2;

const AXES: [&str; 3] = ["x", "y", "z"];

impl Quantity {
    /// All of them.
    pub fn all() -> impl Iterator<Item = Self> {
        (0..ENTRIES.len())
            .flat_map(|kind| (0..if kind < SINGLE { 1 } else { 3 }).map(move |axis| Self { kind, axis }))
    }

    /// The quantity with this name: `alpha_deg`, `tip_y_mm`, `magnetic_force_z_n`, ...
    ///
    /// # Errors
    /// [`Error::Unsupported`] for any other name.
    pub fn named(name: &str) -> Result<Self, Error> {
        Self::all()
            .find(|each| each.name() == name)
            .ok_or_else(|| Error::Unsupported(format!("`{name}` is nothing that can be measured")))
    }

    /// Its name.
    #[must_use]
    pub fn name(self) -> String {
        let (before, after, ..) = ENTRIES[self.kind];
        if self.kind < SINGLE {
            format!("{before}{after}")
        } else {
            format!("{before}_{}{after}", AXES[self.axis])
        }
    }

    /// Its value in the outputs of a solve, in its unit.
    #[must_use]
    pub fn read(self, outputs: &Outputs) -> f64 {
        let (_, _, units, read) = ENTRIES[self.kind];
        read(outputs)[self.axis] * units
    }
}

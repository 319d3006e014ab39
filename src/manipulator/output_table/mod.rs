//! The table of outputs: a row for each quantity that a solve gives. Variables of the FMU, JSON, columns of sweeps and measured
//! tables, and the printed table are read from it.
//!
//! A new output is a field of [`super::Outputs`] with how it is read, a row here, and its rows in the Jacobian; one without these
//! rows has its derivatives by differences of neighbouring devices ([`Derivative::Neighbours`]).

mod row; // what a row says

mod spelling; // units as names and people spell them

mod names; // names of numbers with their units

pub mod quantity; // units and quantities

mod device; // pose of the tip, loads, shape, bodies

mod surroundings; // sources, shaft, vessel

mod centreline; // tangents and curvatures

pub use centreline::CENTRELINE;
pub use device::{DEVICE, SOLVE};
pub use row::{Derivative, Index, OutputRow, Owner, Request, Scope, WrenchPart};
pub use spelling::{Printed, Spelled, Spelling};
pub use surroundings::{CONTACT, SHAFT, SOURCES};

/// The groups of rows in the order of the FMU's variables. What is added comes last, so that value references stay.
const GROUPS: [&[OutputRow]; 6] = [DEVICE, SOLVE, SOURCES, SHAFT, CONTACT, CENTRELINE];

/// All rows, in the order of the columns of a table: those that every device has, then those of a vessel, of a shaft, and of sources
/// on one another.
pub fn rows() -> impl Iterator<Item = &'static OutputRow> {
    let all = || GROUPS.into_iter().flatten();
    [Scope::Always, Scope::Vessel, Scope::Shaft, Scope::MutualWrenches]
        .into_iter()
        .flat_map(move |scope| all().filter(move |row| row.scope == scope))
}

/// The row with this name.
///
/// ```
/// use mcm::manipulator::output_table::row;
/// assert_eq!(row("shape.curvature").map(|row| row.quantity.unit), Some("1/m"));
/// assert!(row("shape.curvatures").is_none());
/// ```
#[must_use]
pub fn row(name: &str) -> Option<&'static OutputRow> {
    rows().find(|row| row.name == name)
}

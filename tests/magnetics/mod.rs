//! Tests of `magnetics`.

mod axial_rule;
mod batch;
mod coil;
mod consistency;
mod directed;
pub(crate) mod face_integral;
mod field;
mod magnets;
mod material;
mod multipoles;
mod mutual;
mod overlap;
mod overlap_solids;
mod pair_table;
mod reference;
mod sheet;
mod wrench;

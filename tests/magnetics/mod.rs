//! Tests of `magnetics`.

mod axial_rule;
mod consistency;
mod field;
mod field_table;
mod material;
mod multipoles;
mod overlap;
mod reference;
mod wrench;

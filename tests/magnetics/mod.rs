//! Tests of `magnetics`.

mod axial_rule;
mod consistency;
mod field;
mod material;
mod reference;
mod wrench;

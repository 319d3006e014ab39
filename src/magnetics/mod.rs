//! Magnetic fields, and the forces and torques that they exert on magnetised bodies.

mod assembly;
mod axial_rule;
mod axial_source;
mod axisymmetric;
mod batch;
mod dipole;
mod edge;
mod face_rule;
mod field_table;
mod integrals;
mod jet;
mod lanes;
mod multipole;
mod overlap;
mod pair_table;
mod points;
mod uniform;
mod wrench;

pub use assembly::{Assembly, AxialMagnet};
pub use axial_rule::AxialRule;
pub use axial_source::AxialSource;
pub use dipole::Dipole;
pub use face_rule::FaceRule;
pub use field_table::FieldTable;
pub use jet::{FieldHessian, Jet};
pub use overlap::{Outline, depth};
pub use pair_table::{PairRule, PairTable};
pub use uniform::LinearField;
pub use wrench::Wrench;

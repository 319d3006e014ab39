//! Magnetic fields, and the forces and torques that they exert on magnetised bodies.

mod axial_rule;
mod axial_source;
mod axisymmetric;
mod batch;
mod box_potential;
mod dipole;
mod edge;
mod face_rule;
mod integrals;
mod jet;
mod lanes;
pub mod limits;
mod multipole;
mod overlap;
mod pair_table;
mod points;
pub mod quantities;
mod shape_derivatives;
mod sheet;
mod sheet_lanes;
mod solid_harmonics;
mod sources;
mod transverse;
mod uniform;
mod wrench;

pub use axial_rule::AxialRule;
pub use axial_source::AxialSource;
pub use dipole::Dipole;
pub use face_rule::FaceRule;
pub use jet::{FieldHessian, Jet};
pub use overlap::{Annulus, Outline, depth};
pub use pair_table::{PairRule, PairTable};
pub use sheet::{DipoleSheet, FieldAccuracy, SecondSums, SheetSums};
pub use sources::*;
pub use uniform::LinearField;
pub use wrench::Wrench;

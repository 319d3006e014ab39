//! Magnetic fields, and the forces and torques that they exert on magnetised bodies.

mod assembly;
mod axial_rule;
mod axial_source;
mod axisymmetric;
mod batch;
mod coil;
mod dipole;
mod edge;
mod face_rule;
mod integrals;
mod iron_core;
mod jet;
mod lanes;
mod multipole;
mod overlap;
mod pair_table;
mod points;
mod sheet;
mod sheet_lanes;
mod sources;
mod uniform;
mod wrench;

pub use assembly::{Assembly, AxialMagnet};
pub use axial_rule::AxialRule;
pub use axial_source::AxialSource;
pub use coil::Coil;
pub use dipole::Dipole;
pub use face_rule::FaceRule;
pub use iron_core::IronCore;
pub use jet::{FieldHessian, Jet};
pub use overlap::{Outline, depth};
pub use pair_table::{PairRule, PairTable};
pub use sheet::{DipoleSheet, FieldAccuracy, SecondSums, SheetSums};
pub use sources::{SourceName, Sources};
pub use uniform::LinearField;
pub use wrench::Wrench;

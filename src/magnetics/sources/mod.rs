//! Field sources: one trait, one file a kind, one list.

mod coil;
mod cylinders;
mod list;
mod multipoles;
mod mutual;
mod part;
mod solenoid;
mod source;

pub use coil::Coil;
pub use cylinders::{AxialMagnet, Cylinders};
pub use list::{SourceName, Sources};
pub use multipoles::{MultipoleCoil, MultipoleTable};
pub use part::Part;
pub use solenoid::Solenoid;
pub use source::{Drive, FieldSource, Source};

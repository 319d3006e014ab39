//! Field sources: one trait, one file a kind, one list.

mod coil;
mod cuboid;
mod cylinders;
mod list;
mod multipoles;
mod mutual;
mod oblique;
mod part;
mod shape;
mod shapes;
mod solenoid;
mod source;
mod sphere;

pub use coil::Coil;
pub use cuboid::Cuboid;
pub use cylinders::{AxialMagnet, Cylinders};
pub use list::{SourceName, Sources};
pub use multipoles::{MultipoleCoil, MultipoleTable};
pub use oblique::ObliqueCylinder;
pub use part::Part;
pub use shape::{Shape, ShapedMagnet};
pub use shapes::{SHAPES, shape_named};
pub use solenoid::Solenoid;
pub use source::{Drive, FieldSource, Source};
pub use sphere::Sphere;

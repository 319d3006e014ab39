//! Design of the manipulator: materials, bodies and the chain that they form.

mod area;
mod chain;
mod checks;
mod demagnetisation;
mod direction;
mod helix;
pub mod limits;
mod material;
mod modulus;
mod moment;
mod per_segment;
mod preset;
pub mod quantities;
mod section;
mod section_limits;
mod sectioned;
mod sections;
mod segment;
mod segmented;
mod specification;
mod tube;
pub mod unit_mistake;
mod value_list;

pub use chain::Design;
pub use demagnetisation::demagnetising_factor;
pub use direction::Direction;
pub use helix::{HelixGeometry, HelixVolumes, SpiralVolume};
pub use limits::{MOST_PERMEABLE, MOST_SECTIONS, MOST_SEGMENTS};
pub use material::{
    DENSEST_PACKING, ELASTOMER_DENSITY, PARTICLE_DENSITY, composite_density, composite_shear_modulus,
    gent_hardness, gent_modulus, shear_modulus,
};
pub use modulus::Modulus;
pub use moment::RelativeMoment;
pub use section::{RigidShape, Ring, SectorKind, Span, SpanKind, Spiral, Stiffness, Taper};
pub use sections::{MeasuredStiffness, Section, SectionBody, SectionMagnet, Sections};
pub use segment::Segment;
pub use specification::{
    Backbone, Cylinder, CylinderMaterial, Guidewire, Helix, RingMagnet, Segmented, Specification, SpiralKind,
    SpiralStart,
};
pub use value_list::ValueList;

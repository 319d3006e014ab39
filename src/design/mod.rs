//! Design of the manipulator: materials, bodies and the chain that they form.

mod chain;
mod demagnetisation;
mod direction;
mod helix;
pub mod limits;
mod material;
mod moment;
mod preset;
pub mod quantities;
mod section;
mod section_limits;
mod sectioned;
mod sections;
mod segmented;
mod specification;
pub mod unit_mistake;
mod value_list;

pub use chain::{Design, Segment};
pub use demagnetisation::demagnetising_factor;
pub use direction::Direction;
pub use helix::{HelixGeometry, HelixVolumes, SpiralVolume};
pub use limits::{MOST_PERMEABLE, MOST_SECTIONS, MOST_SEGMENTS};
pub use material::{
    DENSEST_PACKING, ELASTOMER_DENSITY, PARTICLE_DENSITY, composite_density, composite_shear_modulus,
    gent_hardness, gent_modulus, shear_modulus,
};
pub use moment::RelativeMoment;
pub use section::{RigidShape, Ring, SectorKind, Span, SpanKind, Spiral, Stiffness, Taper};
pub use sections::{MeasuredStiffness, Section, SectionBody, SectionMagnet, Sections};
pub use specification::{
    Backbone, Cylinder, CylinderMaterial, Guidewire, Helix, Modulus, RingMagnet, Segmented, Specification,
    SpiralKind, SpiralStart,
};
pub use value_list::ValueList;

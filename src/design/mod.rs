//! Design of the manipulator: materials, bodies and the chain that they form.

mod chain;
mod demagnetisation;
mod helix;
pub mod limits;
mod material;
mod moment;
mod preset;
pub mod quantities;
mod section;
mod specification;
pub mod unit_mistake;

pub use chain::{Design, Segment};
pub use demagnetisation::demagnetising_factor;
pub use helix::{HelixGeometry, HelixVolumes, SpiralVolume};
pub use limits::{MOST_PERMEABLE, MOST_SEGMENTS};
pub use material::{
    DENSEST_PACKING, ELASTOMER_DENSITY, PARTICLE_DENSITY, composite_density, composite_shear_modulus,
    gent_hardness, gent_modulus, shear_modulus,
};
pub use moment::RelativeMoment;
pub use section::{Ring, SectorKind, Span, SpanKind, Spiral, Stiffness};
pub use specification::{
    Backbone, Cylinder, CylinderMaterial, Guidewire, Helix, Modulus, RingMagnet, Segmented, Specification,
    SpiralKind, SpiralStart,
};

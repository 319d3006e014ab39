//! What is built: materials, bodies and the chain that they form.

mod chain;
mod section;
mod specification;

pub use chain::{Design, Segment};
pub use section::{Ring, Span, SpanKind, Spiral, SpiralKind, Stiffness};
pub use specification::{
    Backbone, Cylinder, CylinderMaterial, Helix, Modulus, RingMagnet, Segmented, Specification,
};

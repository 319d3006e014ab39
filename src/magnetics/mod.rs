//! Magnetic fields and what they do to magnetised bodies.

mod assembly;

pub use assembly::{Assembly, AxialMagnet};

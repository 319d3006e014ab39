//! The vessel that a manipulator is pushed through: how far a point is from its wall.

mod branch;
mod clearance;
mod lumen;

pub use branch::Branch;
pub use clearance::Clearance;
pub use lumen::Lumen;

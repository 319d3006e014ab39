//! The vessel that a manipulator is pushed through: how far a point is from its wall.

pub mod aorta;
mod branch;
mod clearance;
mod lumen;
mod wall;
mod whole;

pub use aorta::Aorta;
pub use branch::Branch;
pub use clearance::Clearance;
pub use lumen::Lumen;
pub use wall::Wall;
pub use whole::Vessel;

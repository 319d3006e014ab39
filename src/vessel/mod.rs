//! The vessel that a manipulator is pushed through: how far a point is from its wall.

pub mod aorta;
mod bounding_tree;
mod branch;
mod clearance;
pub mod friction;
mod grid;
mod lumen;
mod mesh;
pub mod quantities;
mod sampling;
#[cfg(feature = "stl")]
mod stl;
mod surface;
mod triangle;
mod wall;
mod whole;

pub use aorta::Aorta;
pub use branch::Branch;
pub use clearance::Clearance;
pub use grid::DistanceGrid;
pub use lumen::Lumen;
pub use mesh::Mesh;
pub use wall::Wall;
pub use whole::Vessel;

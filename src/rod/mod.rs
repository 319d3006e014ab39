//! The elastic rod: strain modes, kinematics, stiffness, and load potentials on moving frames.

mod basis;
mod bending;
mod bending_stop;
mod charges;
mod cubature;
mod element;
mod element_derivatives;
mod fine_points;
mod kinematics;
mod lining;
mod load;
mod moments;
mod piece;
mod placed_derivatives;
mod placed_load;
mod row;
mod row_table;
mod section_dipoles;
mod section_material;
mod source_geometry;
mod strain_norm;

pub use bending_stop::{BendingStop, StopLoads};
pub use charges::Charges;
pub use cubature::{SectionPoint, StationQuadrature};
pub use element::{Element, Resolution, Station};
pub use element_derivatives::{ElementDerivatives, ElementLoads, Order, START};
pub use kinematics::{Configuration, FrameState, StationState};
pub use load::{Load, turning};
pub use moments::SectionMoments;
pub use piece::Piece;
pub use placed_load::{PlacedCoupling, PlacedLoad};
pub use row::{COMPONENTS, Row};
pub use row_table::RowTable;
pub use section_dipoles::{SectionDipoles, SectionStiffness};
pub use section_material::SectionMaterial;
pub use source_geometry::SourceGeometry;

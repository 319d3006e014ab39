//! The elastic rod: strain modes, kinematics, stiffness, and loads as energies on moving frames.

mod basis;
mod bending;
mod charges;
mod cubature;
mod element;
mod fine_points;
mod kinematics;
mod load;
mod matter;
mod moments;
mod piece;
mod row;
mod sheet;
mod sight;
mod stop;
mod tangent;

pub use charges::Charges;
pub use cubature::{Sample, SectionPoint};
pub use element::{Element, Resolution, Station};
pub use kinematics::{Configuration, StationState};
pub use load::{Load, turning};
pub use matter::Matter;
pub use moments::SectionMoments;
pub use piece::Piece;
pub use row::{COMPONENTS, Row};
pub use sheet::Sheet;
pub use sight::Sight;
pub use tangent::{Order, START, Tangent};

//! The elastic rod: strain modes, kinematics, stiffness, and loads as energies on moving frames.

mod basis;
mod bending;
mod charges;
mod cubature;
mod element;
mod kinematics;
mod load;
mod matter;
mod moments;
mod sheet;
mod stop;
mod tangent;

pub use charges::Charges;
pub use cubature::{Sample, SectionPoint, Sight};
pub use element::{COMPONENTS, Element, Piece, Resolution, Row, Station};
pub use kinematics::{Configuration, StationState};
pub use load::{Load, turning};
pub use matter::Matter;
pub use moments::SectionMoments;
pub use sheet::Sheet;
pub use tangent::{Order, START, Tangent};

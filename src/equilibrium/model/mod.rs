//! The model: the discretised chain, its inputs, and the potential with all its terms.

mod chain;
mod condensation;
mod definition;
mod elastic_norm;
mod factorisation;
mod free_turn;
mod guidewire;
mod guidewire_loads;
mod hessian;
mod inputs;
mod layout;
mod loads;
mod newton_equations;
mod pair_loads;
mod pair_quadrature;
mod pool;
mod potential;
pub mod quantities;
mod ring_body;
mod ring_field;
mod settings;
mod shape_points;
mod source_field;
mod span_quadrature;
mod surroundings;
mod terms;
mod workspace;

pub(crate) use chain::{Chain, arc_lengths};
pub(crate) use definition::Model;
pub(crate) use elastic_norm::ElasticNorm;
pub(crate) use factorisation::Origin;
pub(crate) use free_turn::FreeTurn;
pub use inputs::Inputs;
pub use inputs::PlacedSource;
pub(crate) use inputs::{LONGEST_INSERTION, LONGEST_REACH};
pub use layout::Input;
pub(crate) use layout::{Counts, VECTOR};
pub(crate) use pair_quadrature::PairQuadrature;
pub(crate) use potential::{EVERY_DIRECTION, EigenSearch, Potential, THOROUGH};
pub use settings::{Interaction, Settings};
pub(crate) use shape_points::{ShapePoint, Site, point_at, strained};
pub(crate) use surroundings::Surroundings;
pub(crate) use terms::{Frame, NearStation, Terms, overlap};
#[cfg(feature = "methods")]
pub(crate) use terms::{TermWrenches, blocks};
pub(crate) use workspace::Workspace;

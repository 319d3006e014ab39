//! Potential energy of the whole chain, its minimum and the stability of that minimum.
//!
//! Four folders, each of which uses only those before it: `model` (the discretised chain and its potential), `contact` (what a vessel
//! does to it), `search` (from inputs to a stable shape) and `sensitivity` (derivatives of that shape).

mod contact;
mod model;
mod search;
mod sensitivity;

pub use contact::{Body, Contact, WallForces};
pub use model::{Input, Inputs, Interaction, PlacedSource, Settings, quantities};
pub(crate) use model::{LONGEST_INSERTION, LONGEST_REACH};
pub(crate) use search::Deadline;
#[cfg(target_family = "wasm")]
pub use search::set_clock;
pub use search::{
    BranchSnapshot, Budget, Diagram, Equilibrium, Outcome, Report, Shape, Solution, TipDeviation, Verifier,
};
pub use sensitivity::{DiscretisationError, Jacobian, Output, Refinement};
pub(crate) use sensitivity::{Linearised, Neighbourhood};
#[cfg(feature = "methods")]
pub(crate) use {
    contact::Placed,
    model::{Chain, Frame, PairQuadrature, TermWrenches, Terms, arc_lengths, blocks},
};

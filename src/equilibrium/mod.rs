//! The potential of the whole chain, its minimum, its stability.

mod chain;
mod condensed;
mod dead;
mod follow;
mod inputs;
mod pair;
mod potential;
mod reduction;
mod rules;
mod settings;
mod snapshot;
mod solver;
mod source;
mod spans;

pub use follow::Report;
pub use inputs::Inputs;
pub use settings::{Interaction, Settings};
pub use snapshot::Snapshot;
pub use solver::Equilibrium;

//! The potential of the whole chain, its minimum, its stability.

mod chain;
mod condensed;
mod dead;
mod follow;
mod inputs;
mod internal;
mod pair;
mod potential;
mod reduction;
mod rules;
mod settings;
mod solver;
mod source;
mod spans;
mod views;

pub use follow::Report;
pub use inputs::Inputs;
pub use settings::{Interaction, Settings};
pub use solver::Equilibrium;

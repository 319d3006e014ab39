//! The potential of the whole chain, its minimum, its stability.

mod chain;
mod condensed;
mod dead;
mod follow;
mod inputs;
mod methods;
mod pair;
mod potential;
mod reduction;
mod rules;
mod settings;
mod solver;
mod source;
mod spans;

pub use follow::Report;
pub use inputs::Inputs;
pub use methods::{Comparison, Discretisation, Method, Solver};
pub use settings::{Interaction, Settings};
pub use solver::Equilibrium;

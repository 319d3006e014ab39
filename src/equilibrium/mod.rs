//! The potential of the whole chain, its minimum, its stability.

mod chain;
mod columns;
mod condensed;
mod correction;
mod dead;
mod drift;
mod field_rates;
mod follow;
mod inputs;
mod internal;
mod interpolation;
mod jacobian;
mod methods;
mod pair;
mod potential;
mod reduction;
mod rows;
mod rules;
mod sensitivity;
mod settings;
mod snapshot;
mod solver;
mod source;
mod spans;
mod transfer;
mod views;

pub use correction::Report;
pub use inputs::Inputs;
pub use jacobian::{Input, Jacobian, Output};
pub use methods::{Comparison, Discretisation, Method};
pub use settings::{Interaction, Settings};
pub use snapshot::Snapshot;
pub use solver::Equilibrium;
pub use transfer::Gap;

//! The potential of the whole chain, its minimum, its stability.

mod chain;
mod external;
mod follow;
mod inputs;
mod pair;
mod potential;
mod reduction;
mod rules;
mod settings;

pub use inputs::Inputs;
pub use settings::{Interaction, Settings};

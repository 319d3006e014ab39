//! The potential of the whole chain, its minimum, its stability.

mod chain;
mod external;
mod inputs;
mod pair;
mod potential;
mod reduction;
mod settings;

pub use inputs::Inputs;
pub use settings::{Interaction, Settings};

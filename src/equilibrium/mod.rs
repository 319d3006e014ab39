//! The potential of the whole chain, its minimum, its stability.

mod settings;

pub use settings::{Interaction, Settings};

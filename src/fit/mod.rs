//! What the device is: its parameters from measured rows of inputs and outputs, and how well the rows tell them.
//!
//! [`Fit`] finds the numbers of a scene with which the model comes nearest to [`Data`]: Gauss and Newton's method by exact sensitivities,
//! with covariance, profile likelihood intervals, and the combinations of parameters that the rows cannot tell apart.

mod data;
mod descent;
mod estimate;
mod experiments;
mod identifiability;
mod noise;
mod problem;
mod profile;
mod quantity;
mod spectrum;

pub use data::{Data, Measured};
pub use estimate::{Fit, Loss, Options};
pub use identifiability::Untold;
pub use quantity::Quantity;

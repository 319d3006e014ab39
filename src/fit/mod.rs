//! What the device is: its parameters from measured rows of inputs and outputs, and how sure they are.
//!
//! [`Measurements`] are the rows; [`Fit`] finds the parameters by exact sensitivities, with covariance, intervals, what the rows cannot
//! tell apart, and which further rows would.

mod columns;
mod constants;
mod devices;
mod directions;
mod estimate;
mod experiments;
mod intervals;
mod loss;
mod measurable;
mod measurements;
mod outcome;
mod problem;
mod scatter;

pub use directions::Direction;
pub use estimate::Settings;
pub use experiments::Experiment;
pub use loss::Loss;
pub use measurable::Measurable;
pub use measurements::{Measurements, Row};
pub use outcome::{Cell, Fit, Parameter};

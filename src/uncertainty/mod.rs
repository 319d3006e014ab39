//! How sure the outputs are, where numbers of the scene are known to a standard deviation only.
//!
//! [`Bands`] are of first order, by exact sensitivities: they cost little more than a solve. [`Samples`] draw devices and solve each:
//! they also hold where the shape is near a fold, and tell how likely it is that the device snaps.

mod bands;
mod samples;

pub use bands::{Bands, COVERAGE};
pub use samples::Samples;

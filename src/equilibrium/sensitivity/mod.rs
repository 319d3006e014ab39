//! Derivatives of a solved shape and of all that is read of it, by its inputs and by the model itself.

mod derivatives;
mod input_derivatives;
mod jacobian;
mod neighbours;
mod output_derivatives;
mod push_rates;
mod refinement;
mod response;
mod shape_derivatives;
mod wrench_derivatives;

pub use jacobian::Jacobian;
pub(crate) use neighbours::{Linearised, Neighbourhood};
pub use output_derivatives::Output;
pub use refinement::{DiscretisationError, Refinement};

//! The search for an equilibrium: predict, correct, halve, descend, and how stable what is found is.

mod answers;
mod branch_test;
mod clock;
mod continuation;
mod corrector;
mod deadline;
mod descent;
mod evaluator;
mod follow;
mod friction_corrector;
mod friction_memory;
mod history;
mod inserted_length;
mod interpolation;
mod model_transfer;
mod outcome;
mod path;
mod predictor;
mod pushed_margin;
mod report;
mod scratch;
mod snapshot;
mod solution;
mod solve;
mod solver;
mod stability;
mod stages;
mod verifier;

#[cfg(target_family = "wasm")]
pub use clock::set_clock;
pub use continuation::{Diagram, Shape};
pub(crate) use deadline::Deadline;
pub(crate) use inserted_length::ByInsertion;
pub use model_transfer::TipDeviation;
pub(crate) use model_transfer::{DIVERGING, NEAR, SOFT};
pub use outcome::{Budget, Outcome};
pub use report::Report;
pub use snapshot::BranchSnapshot;
pub use solution::Solution;
pub use solver::Equilibrium;
pub use verifier::Verifier;

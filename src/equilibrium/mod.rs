//! Potential energy of the whole chain, its minimum and the stability of that minimum.

mod answers;
mod assessment;
mod chain;
mod clock;
mod condensation;
mod contact;
mod continuation;
mod correct;
mod deadline;
mod descend;
mod elastic_norm;
mod factorisation;
mod feed;
mod free_turn;
mod friction;
mod friction_feed;
mod friction_loads;
mod friction_passes;
mod friction_places;
mod grip;
mod guidewire;
mod guidewire_loads;
mod hessian;
mod history;
mod hold_turn;
mod input_derivatives;
mod inputs;
mod interpolation;
mod jacobian;
mod layout;
mod loads;
mod model_transfer;
mod neighbours;
mod newton_equations;
mod outcome;
mod output_derivatives;
mod pair_loads;
mod pair_quadrature;
mod pool;
mod potential;
mod predict;
mod pushed_margin;
pub mod quantities;
mod refinement;
mod report;
mod response;
mod ring_body;
mod ring_field;
mod search;
mod sensitivity;
mod settings;
mod shape_derivatives;
mod shape_points;
mod snapshot;
mod solution;
mod solve;
mod solver;
mod source_field;
mod span_quadrature;
mod surface;
mod terms;
mod verifier;
mod wall_contacts;
mod wall_forces;
mod wall_loads;
mod wall_search;
mod workspace;
mod wrench_derivatives;

#[cfg(target_family = "wasm")]
pub use clock::set_clock;
pub use continuation::{Diagram, Shape};
pub(crate) use deadline::Deadline;
pub(crate) use inputs::LONGEST_INSERTION;
pub use inputs::{Inputs, PlacedSource};
pub use jacobian::Jacobian;
pub use layout::Input;
pub use model_transfer::TipDeviation;
pub(crate) use neighbours::{Linearised, Neighbourhood};
pub use outcome::{Body, Budget, Contact, Outcome};
pub use output_derivatives::Output;
pub use refinement::{DiscretisationError, Refinement};
pub use report::Report;
pub use settings::{Interaction, Settings};
pub use snapshot::BranchSnapshot;
pub use solution::Solution;
pub use solver::Equilibrium;
pub use verifier::Verifier;
pub use wall_forces::WallForces;
#[cfg(feature = "methods")]
pub(crate) use {
    chain::{Chain, arc_lengths},
    contact::Placed,
    pair_quadrature::PairQuadrature,
    terms::{Frame, TermWrenches, Terms, blocks},
};

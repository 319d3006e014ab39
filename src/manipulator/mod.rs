//! The device as its user sees it: inputs in, shape and forces out, with the last shape kept between solves.

mod branch;
mod collapse;
mod device;
mod error_estimate;
mod followed;
mod hierarchy;
mod measured_margin;
mod models;
mod neighbours;
pub mod output_table;
mod outputs;
mod prediction;
mod pushed;
mod scene;
mod sensitivities;
mod strains;
mod tolerance;
mod variation;
mod wait;
mod way;

pub use crate::equilibrium::{Body, Budget, Contact, Input, Inputs, Jacobian, Outcome, Output, PlacedSource};
pub use branch::{Branch, Fold, PathSnapshot};
pub use collapse::{Collapse, Remedy, rings_attract};
pub use device::{Manipulator, Snapshot};
pub use followed::Followed;
pub use models::models_of_auto;
pub use neighbours::Neighbours;
#[cfg(feature = "methods")]
pub(crate) use outputs::Resolution;
pub use outputs::{Outputs, Reaction, Status};
pub use scene::{FeedMode, METHODS, POTENTIAL, Scene, SceneFile, Uncertainty};
pub use sensitivities::Sensitivities;
pub use tolerance::TipTolerance;
pub(crate) use variation::Number;
pub use variation::Variant;
pub use way::{Way, WayRow};

//! Where the external magnet must be: inputs that bring the tip to a target, along a way without a snap.
//!
//! [`Steering`] walks: every step is solved from the shape before, so that what it finds can be driven. It uses the exact Jacobian of the
//! device, keeps to [`Limits`], and says which of them stops it.

mod aim;
mod bounds;
mod constants;
mod limits;
mod linear;
mod moves;
mod plan;
mod quadratic_program;
mod rapidly_exploring_random_tree;
mod sequential_quadratic_programming;
mod state;
mod steering;
mod stride;
mod target;
mod track;

pub use limits::{Limit, Limits};
pub use moves::Move;
pub use plan::Plan;
pub use sequential_quadratic_programming::Step;
pub use steering::{Answer, Steering};
pub use target::{Residual, Target, Tolerances};

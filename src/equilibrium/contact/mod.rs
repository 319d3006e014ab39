//! What a vessel does to the chain: wall, friction, and bodies that overlap.

mod bodies;
mod friction;
mod friction_contact;
mod friction_places;
mod lagged_friction;
mod loading;
mod overlap;
mod surface;
mod vessel_contact;
mod wall_contacts;
mod wall_forces;
mod wall_search;
mod walls;

pub use bodies::{Body, Contact};
pub(crate) use friction::{FrictionMemory, Stage};
pub(crate) use friction_places::KeptShape;
#[cfg(feature = "methods")]
pub(crate) use overlap::Placed;
pub(crate) use vessel_contact::VesselContact;
pub use wall_forces::WallForces;

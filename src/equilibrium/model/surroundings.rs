//! What surrounds the chain and touches it, as the potential knows it.

use super::chain::Chain;
use super::inputs::Inputs;
use super::workspace::Workspace;

/// What surrounds the chain and pushes on it, as a vessel does.
pub(crate) trait Surroundings: core::fmt::Debug {
    /// Adds the loads on the chain at the shape that is placed in `work`; returns the energy (J) of those that are not on nodes.
    fn load(&mut self, chain: &Chain, inputs: &Inputs, unknowns: &[f64], work: &mut Workspace) -> f64;
}

//! Holding the free turn of a shape in a search.

use super::free_turn::FreeTurn;
use super::history::History;
use super::inputs::Inputs;
use super::search::Search;

impl Search<'_> {
    /// Holds the free turn of the last shape for the way to `target`, unless the loads there are not symmetric.
    pub(super) fn take_up_turn(&mut self, branch: &History, target: &Inputs) {
        self.work.free_turn = branch.turn.filter(|_| self.is_symmetric(target));
        if self.work.free_turn != branch.turn {
            self.work.factorisation = None;
        }
    }

    /// Holds the free turn of a shape from now on, if there is one; returns whether there is.
    pub(super) fn hold_turn(&mut self, inputs: &Inputs, unknowns: &[f64]) -> bool {
        let (chain, metric) = (self.model.chain, self.model.metric);
        let symmetric = self.is_symmetric(inputs);
        self.work.free_turn = if symmetric { FreeTurn::of(chain, metric, unknowns) } else { None };
        self.work.free_turn.is_some()
    }

    /// Whether the loads at `inputs` leave a turn free that is held, if any; else it is no longer held.
    pub(super) fn is_still_free(&mut self, inputs: &Inputs) -> bool {
        let free = self.work.free_turn.is_none() || self.is_symmetric(inputs);
        if !free {
            (self.work.free_turn, self.work.factorisation) = (None, None);
        }
        free
    }

    /// Whether device and loads are symmetric about the axis of the clamp.
    pub(super) fn is_symmetric(&mut self, inputs: &Inputs) -> bool {
        self.model.chain.axisymmetric
            && !self.work.friction.holds()
            && self.potential(inputs).terms.are_symmetric_about(&inputs.root())
    }
}

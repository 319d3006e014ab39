//! Stability of a solved shape, and its distance from a fold.

use super::evaluator::Evaluator;
use crate::equilibrium::model::{EVERY_DIRECTION, EigenSearch, Inputs, THOROUGH};
use crate::numerics::eigenvalue::Search as Effort;
use crate::numerics::trust_region::{Objective, spread};

/// Search effort for the stability margin after every solve: enough to see an approaching fold.
const GLANCE: Effort = Effort { vectors: 6, settled: 0.03 };

/// Margin up to which a shape counts as neutral: the uncertainty that the tolerance leaves.
const FREE: f64 = 1e-7;

/// Margin below which the shape is assessed again with its own Hessian.
const DOUBTFUL: f64 = 1e-4;

/// Stability at the last assessment, of all directions but a free turn.
pub(super) struct Stability<'a> {
    /// Stability margin, an upper bound; 0 where none was found.
    pub(super) margin: f64,
    /// The direction of least stiffness.
    pub(super) softest: Vec<f64>,
    pub(super) eigen: &'a mut EigenSearch,
}

impl Stability<'_> {
    /// Whether the shape assessed last is stable at the shape that is held now; `None` where no margin was found.
    pub(super) fn is_stable(&self, evaluator: &Evaluator<'_>) -> Option<bool> {
        (self.margin != 0.0).then(|| self.margin > FREE && evaluator.work.free_turn.is_none())
    }

    /// Assesses the shape `unknowns`, found by the last correction. Where it is the `first` of a branch, thoroughly: without the softest
    /// direction of an earlier shape, a short search may miss a softer one.
    pub(super) fn assess(
        &mut self,
        evaluator: &mut Evaluator<'_>,
        inputs: &Inputs,
        unknowns: &[f64],
        first: bool,
    ) -> Option<bool> {
        let effort = if first { THOROUGH } else { GLANCE };
        // A free turn has no stiffness but that of rounding; held, it leaves that of the other directions.
        let found = evaluator.work.free_turn.is_none() && evaluator.hold_turn(inputs, unknowns);
        let mut margin = if found { f64::NAN } else { self.margin_here(evaluator, inputs, effort) };
        if margin.is_nan() || margin < DOUBTFUL {
            // The Hessian is that of a shape one step earlier, whose error may hide an instability.
            let mut potential = evaluator.potential(inputs);
            let regular = potential.linearise(unknowns).is_some() && potential.factorise(0.0);
            margin = if regular { self.margin_here(evaluator, inputs, effort) } else { 0.0 };
        }
        if !margin.is_finite() {
            self.margin = 0.0;
            self.softest.fill(0.0);
            return None;
        }

        self.margin = margin;
        Some(margin > FREE && evaluator.work.free_turn.is_none())
    }

    /// Upper bound of the stability margin at the shape factorised last, computed once; NaN where none is found.
    fn margin_here(&mut self, evaluator: &mut Evaluator<'_>, inputs: &Inputs, effort: Effort) -> f64 {
        let Some(factorisation) = &mut evaluator.work.factorisation else { return f64::NAN };
        if !factorisation.origin().assessed {
            factorisation.set_assessed(true);
            // With a share of all directions, so that a mode orthogonal to the last one is not missed.
            spread(evaluator.model.metric, &mut self.softest, EVERY_DIRECTION);
            self.margin = evaluator.potential(inputs).margin(self.eigen, &mut self.softest, effort);
        }
        self.margin
    }
}

//! Assesses a solved shape: its stability, and its distance from a fold.

use super::history::History;
use super::inputs::Inputs;
use super::outcome::Outcome;
use super::potential::{EVERY_DIRECTION, THOROUGH};
use super::search::Search;
use crate::numerics::eigenvalue::Search as Effort;
use crate::numerics::trust_region::{Objective, spread};

/// Search effort for the stability margin after every solve: enough to see an approaching fold.
const GLANCE: Effort = Effort { vectors: 6, settled: 0.03 };

/// Margin up to which a shape counts as neutral: the uncertainty that the tolerance leaves.
const FREE: f64 = 1e-7;

/// Margin below which the shape is assessed again with its own Hessian.
const DOUBTFUL: f64 = 1e-4;

impl Search<'_> {
    /// Assesses the shape `found` at `target`: its outcome and stability margin, or why there is none.
    pub(super) fn assess(&mut self, found: Outcome, branch: &mut History, target: &Inputs) -> Outcome {
        let outcome = match found {
            Outcome::Solved if self.kept => {
                let stable = self.margin > FREE && self.work.free_turn.is_none();
                // Where no margin was found, it is not known.
                if self.margin == 0.0 { Outcome::Solved } else { self.report_stability(stable) }
            }
            Outcome::Solved => {
                // Without the softest direction of an earlier shape, the short search may miss a softer one.
                let effort = if branch.stable.is_some() { GLANCE } else { THOROUGH };
                self.verdict(target, &branch.unknowns, effort)
            }
            Outcome::Neutral => {
                // Factorisation and loads belong to a shape on the way, or on the way back.
                self.potential(target).slope(&branch.unknowns);
                self.work.factorisation = None;
                self.report.stable = Some(false);
                Outcome::Neutral
            }
            otherwise => {
                // A contact at the last trial shape may be the reason.
                let contact = self.model.contact(target, self.work).map(Outcome::Contact);
                let otherwise = self.spent().map_or(otherwise, Outcome::OutOfBudget);
                return contact.unwrap_or(otherwise);
            }
        };
        self.work.place(self.model.chain, target, &branch.unknowns);
        self.model.contact(target, self.work).map_or(outcome, Outcome::Contact)
    }

    /// Assesses the shape `unknowns`, found by the last correction, by an upper bound of its stability margin.
    fn verdict(&mut self, inputs: &Inputs, unknowns: &[f64], search: Effort) -> Outcome {
        // A free turn has no stiffness but that of rounding; held, it leaves that of the other directions.
        let found = self.work.free_turn.is_none() && self.hold_turn(inputs, unknowns);
        let mut margin = if found { f64::NAN } else { self.margin_here(inputs, search) };
        if margin.is_nan() || margin < DOUBTFUL {
            // The Hessian is that of a shape one step earlier, whose error may hide an instability.
            let mut potential = self.potential(inputs);
            let regular = potential.linearise(unknowns).is_some() && potential.factorise(0.0);
            margin = if regular { self.margin_here(inputs, search) } else { 0.0 };
        }
        if !margin.is_finite() {
            self.margin = 0.0;
            self.softest.fill(0.0);
            return Outcome::Solved;
        }

        self.margin = margin;
        self.report_stability(margin > FREE && self.work.free_turn.is_none())
    }

    /// Upper bound of the stability margin at the shape factorised last, computed once; NaN where none is found.
    fn margin_here(&mut self, inputs: &Inputs, search: Effort) -> f64 {
        let Some(factorisation) = &mut self.work.factorisation else { return f64::NAN };
        if !factorisation.origin().assessed {
            factorisation.set_assessed(true);
            self.margin = self.estimate_margin(inputs, search);
        }
        self.margin
    }

    /// Reports whether the shape is stable or neutral, with the margin of the former.
    fn report_stability(&mut self, stable: bool) -> Outcome {
        (self.report.margin, self.report.stable) = (if stable { self.margin } else { 0.0 }, Some(stable));
        if stable { Outcome::Solved } else { Outcome::Neutral }
    }

    fn estimate_margin(&mut self, inputs: &Inputs, search: Effort) -> f64 {
        let metric = self.model.metric;
        let mut softest = std::mem::take(&mut self.softest);
        // With a share of all directions, so that a mode orthogonal to the last one is not missed.
        spread(metric, &mut softest, EVERY_DIRECTION);
        let mut eigen = std::mem::take(&mut self.scratch.eigen);
        let margin = self.potential(inputs).margin(&mut eigen, &mut softest, search);
        (self.scratch.eigen, self.softest) = (eigen, softest);
        margin
    }
}

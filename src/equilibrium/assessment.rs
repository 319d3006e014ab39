//! Assesses a solved shape: its stability, and its distance from a fold.

use super::history::History;
use super::inputs::Inputs;
use super::outcome::Outcome;
use super::potential::{Potential, THOROUGH};
use super::search::Search;
use crate::numerics::eigenvalue::{Lanczos, Search as Effort};
use crate::numerics::trust_region::{Objective, spread};

/// Search effort for the stability margin after every solve: enough to see an approaching fold.
const GLANCE: Effort = Effort { vectors: 6, settled: 0.03 };

/// Weight of all directions that are mixed into the last softest direction before the next search.
const EVERY_DIRECTION: f64 = 0.3;

/// Margin up to which a shape counts as neutral: the uncertainty that the tolerance leaves.
const FREE: f64 = 1e-7;

/// Margin below which the shape is assessed again with its own Hessian.
const DOUBTFUL: f64 = 1e-4;

impl Search<'_> {
    /// Assesses the shape `found` at `target`: its outcome and stability margin, or why there is none.
    pub(super) fn assess(&mut self, found: Outcome, branch: &mut History, target: &Inputs) -> Outcome {
        let outcome = match found {
            Outcome::Solved if self.kept => {
                (self.report.margin, self.report.stable) = (branch.margin, branch.stable);
                if branch.stable == Some(false) { Outcome::Neutral } else { Outcome::Solved }
            }
            Outcome::Solved => {
                // Without the softest direction of an earlier shape, the short search may miss a softer one.
                let effort = if branch.stable.is_some() { GLANCE } else { THOROUGH };
                self.verdict(target, &branch.unknowns, &mut branch.softest, effort)
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
                let otherwise = if self.may_go_on() { otherwise } else { Outcome::OutOfBudget };
                return contact.unwrap_or(otherwise);
            }
        };
        self.work.place(self.model.chain, target, &branch.unknowns);
        self.model.contact(target, self.work).map_or(outcome, Outcome::Contact)
    }

    /// Assesses the shape `unknowns`, found by the last correction, by an upper bound of its stability margin.
    fn verdict(&mut self, inputs: &Inputs, unknowns: &[f64], softest: &mut [f64], search: Effort) -> Outcome {
        let mut margin = if self.work.factorisation.is_some() {
            self.estimate_margin(inputs, softest, search)
        } else {
            f64::NAN
        };
        if margin.is_nan() || margin < DOUBTFUL {
            // The Hessian is that of a shape one step earlier, whose error may hide an instability.
            let mut potential = self.potential(inputs);
            let regular = potential.linearise(unknowns).is_some() && potential.factorise(0.0);
            margin = if regular { self.estimate_margin(inputs, softest, search) } else { 0.0 };
        }
        if let Some(factorisation) = &mut self.work.factorisation {
            factorisation.set_assessed(true);
        }
        if margin.is_finite() {
            let held = margin > FREE;
            (self.report.margin, self.report.stable) = (if held { margin } else { 0.0 }, Some(held));
            if held { Outcome::Solved } else { Outcome::Neutral }
        } else {
            softest.fill(0.0);
            Outcome::Solved
        }
    }

    /// Upper bound of the stability margin at the shape factorised last; NaN where none is found.
    fn estimate_margin(&mut self, inputs: &Inputs, softest: &mut [f64], search: Effort) -> f64 {
        let metric = self.model.metric;
        // With a share of all directions, so that a mode orthogonal to the last one is not missed.
        spread(metric, softest, EVERY_DIRECTION);
        let mut lanczos = std::mem::take(&mut self.scratch.lanczos);
        let margin = self.potential(inputs).margin(&mut lanczos, softest, search);
        self.scratch.lanczos = lanczos;
        margin
    }
}

/// Stability margin at the shape and with the factorisation of `potential`, to about nine digits.
pub(super) fn measure(potential: &mut Potential<'_>) -> f64 {
    let mut softest = vec![0.0; potential.chain.freedoms()];
    spread(potential.metric, &mut softest, 1.0);
    potential.margin(&mut Lanczos::default(), &mut softest, THOROUGH)
}

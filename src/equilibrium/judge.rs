//! Whether a shape is stable, and how far from a fold.

use super::history::History;
use super::inputs::Inputs;
use super::outcome::Outcome;
use super::potential::{Potential, THOROUGH};
use super::search::Search;
use crate::numerics::eigenvalue::{Lanczos, Search as Effort};
use crate::numerics::trust_region::{Objective, spread};

/// The look at the margin after every solve: enough to see a fold come.
const GLANCE: Effort = Effort { vectors: 6, settled: 0.03 };

/// Part of every direction that is mixed into the last softest one before it is looked for again.
const EVERY_DIRECTION: f64 = 0.3;

/// Margin up to which nothing holds a shape: what the tolerance leaves open of it.
const FREE: f64 = 1e-7;

/// Margin below which a shape is looked at again with its own Hessian.
const DOUBTFUL: f64 = 1e-4;

impl Search<'_> {
    /// What the shape that was `found` at `target` is, with its margin, or why there is none.
    pub(super) fn judge(&mut self, found: Outcome, branch: &mut History, target: &Inputs) -> Outcome {
        let outcome = match found {
            Outcome::Solved if self.kept => {
                (self.report.margin, self.report.stable) = (branch.margin, branch.stable);
                if branch.stable == Some(false) { Outcome::Neutral } else { Outcome::Solved }
            }
            Outcome::Solved => {
                // Without a softest direction of a shape before, a glance may miss one that is softer.
                let effort = if branch.stable.is_some() { GLANCE } else { THOROUGH };
                self.verdict(target, &branch.unknowns, &mut branch.softest, effort)
            }
            Outcome::Neutral => {
                // Factorisation and loads are those of a shape on the way, or on the way back.
                self.potential(target).chord_slope(&branch.unknowns);
                self.work.factorisation = None;
                self.report.stable = Some(false);
                Outcome::Neutral
            }
            _ => {
                // The last shape that was tried may say why.
                let contact = self.model.contact(target, self.work).map(Outcome::Contact);
                let otherwise = if self.may_go_on() { Outcome::BranchEnds } else { Outcome::OutOfBudget };
                return contact.unwrap_or(otherwise);
            }
        };
        self.work.place(self.model.chain, &target.base, &branch.unknowns);
        self.model.contact(target, self.work).map_or(outcome, Outcome::Contact)
    }

    /// By an upper bound of the margin at the shape `unknowns`, which the last correction has found.
    fn verdict(&mut self, inputs: &Inputs, unknowns: &[f64], softest: &mut [f64], search: Effort) -> Outcome {
        let mut margin = if self.work.factorisation.is_some() {
            self.estimate_margin(inputs, softest, search)
        } else {
            f64::NAN
        };
        if margin.is_nan() || margin < DOUBTFUL {
            // The Hessian is that of a shape one step earlier, which may be held by what it was off.
            let mut potential = self.potential(inputs);
            let regular = potential.linearise(unknowns).is_some() && potential.factorise(0.0);
            margin = if regular { self.estimate_margin(inputs, softest, search) } else { 0.0 };
        }
        if let Some(factorisation) = &mut self.work.factorisation {
            factorisation.set_judged(true);
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

    /// An upper bound of the margin at the shape that was factorised last; not a number where none is found.
    fn estimate_margin(&mut self, inputs: &Inputs, softest: &mut [f64], search: Effort) -> f64 {
        let metric = &self.model.chain.metric;
        // A little of every direction, or a mode that the last one is orthogonal to would go unseen.
        spread(metric, softest, EVERY_DIRECTION);
        let mut lanczos = std::mem::take(&mut self.scratch.lanczos);
        let margin = self.potential(inputs).margin(&mut lanczos, softest, search);
        self.scratch.lanczos = lanczos;
        margin
    }
}

/// The margin at the shape and with the factorisation of `potential`, to about nine digits.
pub(super) fn measure(potential: &mut Potential<'_>) -> f64 {
    let mut softest = vec![0.0; potential.chain.freedoms()];
    spread(&potential.chain.metric, &mut softest, 1.0);
    potential.margin(&mut Lanczos::default(), &mut softest, THOROUGH)
}

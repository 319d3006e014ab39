//! Newton's equations of the whole chain, as used by the trust region and Newton's method.

use super::factorisation::{Hessian, Linearisation, SpanCoupling};
use super::potential::Potential;
use crate::numerics::trust_region::Objective;
use crate::rod::Order;

impl Objective for Potential<'_> {
    fn slope(&mut self, x: &[f64]) -> Option<f64> {
        let energy = self.load(x, Order::Gradient)?;
        let regular = self.backward(x, None);
        self.leave_out_turn(x);
        regular.then_some(energy)
    }

    fn linearise(&mut self, x: &[f64]) -> Option<f64> {
        let storage = self.work.take_linearisation();
        let mut made = storage.unwrap_or_else(|| Linearisation::new(self.chain, self.terms.spans.act()));
        let energy = self.load(x, Order::Hessian)?;
        let regular = self.backward(x, Some(&mut made.condensations));
        self.leave_out_turn(x);
        let turn = self.work.free_turn;
        made.note((x, &self.work.nodes), self.work.loads(), self.inputs, self.rules.chosen(), turn);
        self.work.linearisation = Some(made);
        regular.then_some(energy)
    }

    fn gradient(&self) -> &[f64] {
        &self.work.gradient
    }

    /// Returns whether the matrix is positive definite or, for non-conservative forces, regular.
    fn factorise(&mut self, shift: f64) -> bool {
        let Some(made) = self.work.take_linearisation() else { return false };
        let hessian = Hessian {
            chain: self.chain,
            metric: self.metric,
            nodes: &self.work.node_hessian,
            elements: &self.work.derivatives,
            mixed: &self.work.cross,
            held: self.work.free_turn.map(|turn| turn.hold(self.metric)),
            spans: match (self.terms.spans.act(), self.terms.spans.are_mutual()) {
                (false, _) => SpanCoupling::None,
                (true, false) => SpanCoupling::OneSided,
                (true, true) => SpanCoupling::Mutual,
            },
            symmetric: self.terms.have_potential(),
            reciprocal: !self.terms.pairs.one_sided(),
        };
        match made.factorise(&hessian, shift) {
            Ok(factorisation) => self.work.factorisation = Some(factorisation),
            Err(made) => self.work.linearisation = Some(made),
        }
        self.work.factorisation.is_some()
    }

    fn dissipates(&self) -> bool {
        let definite = self.work.factorisation.as_ref().is_some_and(|factorisation| factorisation.definite);
        definite || self.terms.pairs.one_sided()
    }

    fn solve(&mut self, x: &mut [f64]) {
        match &mut self.work.factorisation {
            Some(factorisation) => factorisation.solve(self.chain, x),
            None => x.fill(f64::NAN),
        }
    }

    fn metric(&self) -> &[f64] {
        self.metric
    }
}

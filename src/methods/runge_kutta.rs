//! The classical Runge-Kutta method along an element, and its exact derivative.

use super::line::{MaterialPoint, SpanIndex};
use super::strong_form::{Matrix12, State, Vector12, join, split};
use super::surroundings::Surroundings;
use super::trace::Trace;
use crate::design::SpanKind;

/// Nodes of the four stages in a step, also the coefficients of the preceding stage.
pub(super) const NODES: [f64; 4] = [0.0, 0.5, 0.5, 1.0];

/// Weights of the stages.
pub(super) const WEIGHTS: [f64; 4] = [1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0];

/// Ratio of the steps per core to those per disc, which carries some percent of the compliance.
const DISC_SHARE: usize = 4;

/// One step: its place, start and length.
pub(super) struct Step {
    pub(super) place: MaterialPoint,
    pub(super) start: State,
    pub(super) length: f64,
}

impl Surroundings<'_> {
    /// Number and length of the steps of a span, when a core has `steps`.
    pub(super) fn steps(&self, element: usize, piece: usize, steps: usize) -> (usize, f64) {
        let span = &self.line.spans[element][piece];
        let count = if span.kind == SpanKind::Disc { steps.div_ceil(DISC_SHARE) } else { steps };
        (count, span.length / count as f64)
    }

    /// Integrates `state` from the node at the start of `element` to the next node.
    ///
    /// `None` where the equations are not defined: inside a magnet, or beyond a full turn in one step.
    pub(super) fn cross(
        &self,
        element: usize,
        state: &State,
        steps: usize,
        mut trace: Option<&mut Trace>,
    ) -> Option<State> {
        let mut state = self.offset(element, state, trace.as_deref_mut());
        for piece in 0..self.line.spans[element].len() {
            let (count, length) = self.steps(element, piece, steps);

            // The windings of a closed core carry a part of its moment, so that its material carries less.
            let span = SpanIndex { element, piece };
            let relief = self.relief(span, &state, |state| self.span_linear(span, state, steps))?;
            state = state.relieved(&relief);

            for index in 0..count {
                let place = MaterialPoint { element, piece, s: index as f64 * length };
                let next = self.step(&Step { place, start: state, length })?;
                if let Some(trace) = trace.as_deref_mut() {
                    let end = MaterialPoint { s: place.s + length, ..place };
                    let ends = [self.rates(&place, &state)?, self.rates(&end, &next)?];
                    trace.add(&place, length, [&state.pose, &next.pose], &ends);
                }
                state = next;
            }

            state = state.relieved(&-relief);
        }
        state.is_finite().then_some(state)
    }

    /// Moves `state` over the rigid part of `element`.
    pub(super) fn offset(&self, element: usize, state: &State, trace: Option<&mut Trace>) -> State {
        let offset = self.line.chain.elements[element].offset;
        if let Some(trace) = trace {
            trace.add_rigid(offset, &state.pose);
        }
        state.advanced(offset)
    }

    fn step(&self, step: &Step) -> Option<State> {
        let (mut end, mut rate) = (Vector12::zeros(), Vector12::zeros());
        for (node, weight) in NODES.iter().zip(WEIGHTS) {
            let place = MaterialPoint { s: step.place.s + node * step.length, ..step.place };
            rate = self.local_rate(&place, &step.start, &(rate * (node * step.length)))?;
            end += rate * (weight * step.length);
        }
        Some(step.start.displaced(&end))
    }

    /// As [`Surroundings::cross`], with the derivative of the end with respect to displacement and wrench.
    pub(super) fn cross_linear(
        &self,
        element: usize,
        state: &State,
        steps: usize,
    ) -> Option<(State, Matrix12)> {
        let mut own = state.advance_derivative(self.line.chain.elements[element].offset);
        let mut state = self.offset(element, state, None);
        for piece in 0..self.line.spans[element].len() {
            let span = SpanIndex { element, piece };
            let crossed = self.crossed(span, &state, |state| self.span_linear(span, state, steps))?;
            (state, own) = (crossed.end, crossed.own * own);
        }
        state.is_finite().then_some((state, own))
    }

    /// Integrates `state` along one span, with the derivative with respect to displacement and wrench.
    fn span_linear(
        &self,
        SpanIndex { element, piece }: SpanIndex,
        state: &State,
        steps: usize,
    ) -> Option<(State, Matrix12)> {
        let (mut state, mut own) = (*state, Matrix12::identity());
        let (count, length) = self.steps(element, piece, steps);
        for index in 0..count {
            let place = MaterialPoint { element, piece, s: index as f64 * length };
            (state, own) = self.step_linear(&Step { place, start: state, length }, &own)?;
        }
        Some((state, own))
    }

    /// One step, which also maps the changes in the columns of `own` from its start to its end.
    fn step_linear(&self, step: &Step, own: &Matrix12) -> Option<(State, Matrix12)> {
        let (local, turned) = split(own);
        let (mut end, mut rate) = (Vector12::zeros(), Vector12::zeros());
        let (mut sum, mut rates) = (local, Matrix12::zeros());
        for (node, weight) in NODES.iter().zip(WEIGHTS) {
            let place = MaterialPoint { s: step.place.s + node * step.length, ..step.place };
            let here = local + rates * (node * step.length);
            let stage = self.stage(&place, &step.start, &(rate * (node * step.length)))?;
            (rate, rates) = (stage.rate, stage.by_local * here + stage.by_start * turned);
            end += rate * (weight * step.length);
            sum += rates * (weight * step.length);
        }
        Some((step.start.displaced(&end), join(&end, &sum, &turned)))
    }
}

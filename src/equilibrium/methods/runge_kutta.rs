//! The classical Runge-Kutta method along an element, and its exact derivative.

use nalgebra::{Matrix6, SMatrix};

use super::line::Place;
use super::strong_form::{Stage, State, Vector12};
use super::surroundings::Surroundings;
use super::trace::Trace;
use super::transfer::{Transfer, force, join, split};
use crate::design::SpanKind;
use crate::geometry::Pose;

/// Where the four stages lie in a step, and how much of the stage before they take.
pub(super) const NODES: [f64; 4] = [0.0, 0.5, 0.5, 1.0];

/// Weights of the stages.
pub(super) const WEIGHTS: [f64; 4] = [1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0];

/// Parts of a core's steps that a disc gets: it carries some percent of the compliance.
const DISC_SHARE: usize = 4;

/// One step: its place, start and length.
pub(super) struct Step {
    pub(super) place: Place,
    pub(super) start: State,
    pub(super) length: f64,
}

impl Surroundings<'_> {
    /// Steps of a span, when a core has `steps`.
    pub(super) fn steps(&self, element: usize, piece: usize, steps: usize) -> (usize, f64) {
        let span = &self.line.spans[element][piece];
        let count = if span.kind == SpanKind::Disc { steps.div_ceil(DISC_SHARE) } else { steps };
        (count, span.length / count as f64)
    }

    /// Carries `state` from the node at the start of `element` to the next; `nodes` are those up to the start. `None`
    /// where the equations are not defined: inside a magnet, or beyond a full turn in one step.
    pub(super) fn cross(
        &self,
        element: usize,
        state: &State,
        nodes: &[Pose],
        steps: usize,
        mut trace: Option<&mut Trace>,
    ) -> Option<State> {
        let mut state = self.offset(element, state, trace.as_deref_mut());
        for piece in 0..self.line.spans[element].len() {
            let (count, length) = self.steps(element, piece, steps);
            for index in 0..count {
                let place = Place { element, piece, s: index as f64 * length };
                let next = self.step(&Step { place, start: state, length }, nodes)?;
                if let Some(trace) = trace.as_deref_mut() {
                    let ends = [self.rates(&place, &state, nodes)?, {
                        let end = Place { s: place.s + length, ..place };
                        self.rates(&end, &next, nodes)?
                    }];
                    trace.add(&place, length, [&state.pose, &next.pose], &ends);
                }
                state = next;
            }
        }
        state.is_finite().then_some(state)
    }

    /// Carries `state` over the rigid part of `element`.
    pub(super) fn offset(&self, element: usize, state: &State, trace: Option<&mut Trace>) -> State {
        let offset = self.line.chain.elements[element].offset;
        if let Some(trace) = trace {
            trace.add_rigid(offset, &state.pose);
        }
        state.advanced(offset)
    }

    fn step(&self, step: &Step, nodes: &[Pose]) -> Option<State> {
        let (mut end, mut rate) = (Vector12::zeros(), Vector12::zeros());
        for (node, weight) in NODES.iter().zip(WEIGHTS) {
            let place = Place { s: step.place.s + node * step.length, ..step.place };
            rate = self.local_rate(&place, &step.start, &(rate * (node * step.length)), nodes)?;
            end += rate * (weight * step.length);
        }
        Some(step.start.displaced(&end))
    }

    /// The same as [`Surroundings::cross`], with the derivative of the end.
    pub(super) fn cross_linear(
        &self,
        element: usize,
        state: &State,
        nodes: &[Pose],
        steps: usize,
    ) -> Option<(State, Transfer)> {
        let one_sided = self.interaction == crate::equilibrium::Interaction::Preceding;
        let mut transfer = Transfer::identity(if one_sided { element } else { 0 });
        transfer.own = state.advance_derivative(self.line.chain.elements[element].offset);
        let mut state = self.offset(element, state, None);
        for piece in 0..self.line.spans[element].len() {
            let (count, length) = self.steps(element, piece, steps);
            for index in 0..count {
                let place = Place { element, piece, s: index as f64 * length };
                state = self.step_linear(&Step { place, start: state, length }, nodes, &mut transfer)?;
            }
        }
        state.is_finite().then_some((state, transfer))
    }

    fn step_linear(&self, step: &Step, nodes: &[Pose], transfer: &mut Transfer) -> Option<State> {
        let (mut end, mut rate) = (Vector12::zeros(), Vector12::zeros());
        let mut stages = Vec::with_capacity(NODES.len());
        for (node, weight) in NODES.iter().zip(WEIGHTS) {
            let place = Place { s: step.place.s + node * step.length, ..step.place };
            let stage = self.stage(&place, &step.start, &(rate * (node * step.length)), nodes)?;
            rate = stage.rate;
            end += rate * (weight * step.length);
            stages.push(stage);
        }
        transfer.own = columns(&transfer.own, step.length, &end, &stages, |_, _| {});
        for (number, ring) in transfer.rings.iter_mut().enumerate() {
            let acts = |rates: &mut SMatrix<f64, 12, 6>, stage: &Stage| {
                if let Some(mixed) = stage.mixed.get(number) {
                    let mixed: &Matrix6<f64> = mixed;
                    force(rates, mixed);
                }
            };
            *ring = columns(ring, step.length, &end, &stages, acts);
        }
        Some(step.start.displaced(&end))
    }
}

/// Carries columns of changes over a step whose end has the local coordinates `end`.
fn columns<const C: usize>(
    start: &SMatrix<f64, 12, C>,
    length: f64,
    end: &Vector12,
    stages: &[Stage],
    acts: impl Fn(&mut SMatrix<f64, 12, C>, &Stage),
) -> SMatrix<f64, 12, C> {
    let (local, turned) = split(start);
    let mut rates = SMatrix::<f64, 12, C>::zeros();
    let mut sum = local;
    for ((stage, node), weight) in stages.iter().zip(NODES).zip(WEIGHTS) {
        let here = local + rates * (node * length);
        rates = stage.by_local * here + stage.by_start * turned;
        acts(&mut rates, stage);
        sum += rates * (weight * length);
    }
    join(end, &sum, &turned)
}

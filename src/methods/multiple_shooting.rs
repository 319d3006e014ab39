//! Multiple shooting from node to node: short integrations, over which errors stay small, joined by Newton's method.

use super::node_shape::{Basis, NodeShape, couplings, flat, size};
use super::node_system::{Defects, Link, NodeSystem};
use super::strong_form::State;
use super::surroundings::Surroundings;
use super::trace::Trace;
use crate::numerics::levenberg_marquardt::Ending;
use crate::numerics::newton::{self, Equations};
use crate::rod::Order;
use nalgebra::Matrix6;

/// Integration over an element, in space or in a plane.
pub(super) trait Crossing<const D: usize> {
    /// The coordinates of nodes and wrenches.
    fn basis(&self) -> &Basis<D>;
    /// Maps the state at a node to the state just before the next node.
    fn cross(&self, element: usize, state: &State, trace: Option<&mut Trace>) -> Option<State>;
    /// Maps the state at a node to the state just before the next node, with the derivative; `next` is not set.
    fn cross_linear(&self, element: usize, state: &State) -> Option<(State, Link<D>)>;
}

/// Integration in space.
pub(super) struct Spatial<'a, 'b> {
    pub(super) around: &'a Surroundings<'b>,
    pub(super) basis: Basis<6>,
    pub(super) steps: usize,
}

impl<'a, 'b> Spatial<'a, 'b> {
    pub(super) fn new(around: &'a Surroundings<'b>, steps: usize) -> Self {
        Self { around, basis: Basis::new(around.line, &Matrix6::identity()), steps }
    }
}

impl Crossing<6> for Spatial<'_, '_> {
    fn basis(&self) -> &Basis<6> {
        &self.basis
    }

    fn cross(&self, element: usize, state: &State, trace: Option<&mut Trace>) -> Option<State> {
        self.around.cross(element, state, self.steps, trace)
    }

    fn cross_linear(&self, element: usize, state: &State) -> Option<(State, Link<6>)> {
        let (end, own) = self.around.cross_linear(element, state, self.steps)?;
        Some((end, self.basis.link(&own)))
    }
}

/// The matching conditions of one scene.
struct Joined<'a, 'b, C, const D: usize> {
    around: &'a Surroundings<'b>,
    crossing: &'a C,
    system: Option<NodeSystem<D>>,
    defects: Defects<D>,
}

impl<C: Crossing<D>, const D: usize> Equations for Joined<'_, '_, C, D> {
    type Point = NodeShape;

    fn evaluate(&mut self, at: &NodeShape) -> Option<f64> {
        let ends: Option<Vec<State>> =
            (0..at.wrenches.len()).map(|k| self.crossing.cross(k, &at.state(k), None)).collect();
        let (_, loads) = self.around.nodes(&at.nodes, Order::Gradient)?;
        self.defects = at.defects(self.crossing.basis(), &ends?, &loads);
        Some(size(&self.defects))
    }

    fn linearise(&mut self, at: &NodeShape) -> Option<f64> {
        let basis = self.crossing.basis();
        let (mut ends, mut links) = (Vec::new(), Vec::new());
        for k in 0..at.wrenches.len() {
            let (end, mut link) = self.crossing.cross_linear(k, &at.state(k))?;
            link.next = at.next(basis, k, &end);
            ends.push(end);
            links.push(link);
        }
        let (loads, totals) = self.around.nodes(&at.nodes, Order::Hessian)?;
        self.defects = at.defects(basis, &ends, &totals);
        self.system = NodeSystem::new(links, &couplings(basis, &loads));
        Some(size(&self.defects))
    }

    fn correction(&mut self) -> Option<Vec<f64>> {
        Some(flat(&self.system.as_ref()?.solve(&self.defects)?))
    }

    fn moved(&self, at: &NodeShape, step: &[f64], factor: f64) -> NodeShape {
        at.moved(self.crossing.basis(), step, factor)
    }
}

/// Solves from `shape`, which is replaced on success.
pub(super) fn solve<C: Crossing<D>, const D: usize>(
    around: &Surroundings<'_>,
    crossing: &C,
    shape: &mut NodeShape,
    tolerance: f64,
    iterations: u32,
) -> Ending {
    let defects = Defects { pose: Vec::new(), wrench: Vec::new() };
    let mut joined = Joined { around, crossing, system: None, defects };
    let mut trial = shape.clone();
    let end = newton::solve(&mut joined, &mut trial, tolerance, iterations);
    if end.converged {
        *shape = trial;
    }
    end
}

/// The centreline of a solved shape.
pub(super) fn trace<C: Crossing<D>, const D: usize>(
    around: &Surroundings<'_>,
    crossing: &C,
    shape: &NodeShape,
) -> Option<Trace> {
    let mut trace = Trace::default();
    let count = shape.wrenches.len();
    for k in 0..count {
        crossing.cross(k, &shape.state(k), Some(&mut trace))?;
    }
    trace.add_rigid(around.line.chain.tip_offset, &shape.nodes[count]);
    Some(trace)
}

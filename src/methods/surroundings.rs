//! Loads on the chain at given inputs, along the spans and at the nodes, with their derivatives.
//!
//! Derivatives are those of force and moment in fixed axes with respect to displacements `p + pi`, `exp(omega) R` of the
//! bodies: unlike second derivatives of an energy they are not symmetric where a moment acts.

use nalgebra::{Matrix3, Matrix6, Vector3, Vector6};

use super::line::{Line, MaterialPoint};
use crate::equilibrium::{Frame, Inputs, TermWrenches, Terms, blocks};
use crate::geometry::{Pose, hat};
use crate::magnetics::Sources;
use crate::rod::{Load, Order, SectionMaterial};

/// All quantities that determine the loads on a shape.
#[derive(Debug, Clone, Copy)]
pub(super) struct Surroundings<'a> {
    pub(super) line: &'a Line,
    pub(super) inputs: &'a Inputs,
    pub(super) sources: &'a Sources,
    pub(super) terms: Terms<'a>,
}

/// The load on a node: on its ring and, at the last node, on the tip.
#[derive(Debug, Clone)]
pub(super) struct NodeLoad {
    /// Energy including that of the pairs, J.
    pub(super) energy: f64,
    /// Derivative of the energy with respect to the node's displacement: minus force (N) and moment (N m).
    pub(super) gradient: Vector6<f64>,
    /// Derivative of `gradient` with respect to the node's own displacement.
    pub(super) own: Matrix6<f64>,
    /// Interactions with the preceding rings.
    pub(super) pairs: Vec<Pair>,
}

/// Interaction of the ring of a node with a preceding ring, and its reaction.
#[derive(Debug, Clone)]
pub(super) struct Pair {
    /// Node of the preceding ring.
    pub(super) node: usize,
    /// Derivative of the gradient of the later node with respect to the displacement of this one.
    pub(super) by_first: Matrix6<f64>,
    /// The reaction on the preceding ring, as a gradient.
    pub(super) reaction: Vector6<f64>,
    /// Derivatives of the reaction with respect to both nodes' displacements, the earlier node first.
    pub(super) reaction_by: [Matrix6<f64>; 2],
}

/// Force and moment of a load in one column.
pub(super) fn column(force: &Vector3<f64>, moment: &Vector3<f64>) -> Vector6<f64> {
    Vector6::new(force.x, force.y, force.z, moment.x, moment.y, moment.z)
}

/// Gradient of a load.
pub(super) fn gradient(load: &Load) -> Vector6<f64> {
    column(&load.force, &load.moment())
}

/// Derivative of a load's gradient with respect to the displacement of its frame.
pub(super) fn derivative(load: &Load) -> Matrix6<f64> {
    let n = &load.couple;
    let turned = load.rotation_rotation + n.transpose() - Matrix3::identity() * n.trace();
    blocks(&load.position_position, &load.position_rotation, &load.position_rotation.transpose(), &turned)
}

/// Difference between the derivative of a gradient with this moment and the symmetric second derivative.
fn turning_of(moment: &Vector3<f64>) -> Matrix6<f64> {
    let zero = Matrix3::zeros();
    blocks(&zero, &zero, &zero, &(hat(moment) * -0.5))
}

impl Surroundings<'_> {
    /// Whether rings interact.
    pub(super) fn has_pairs(&self) -> bool {
        self.terms.pairs.each().next().is_some()
    }

    /// Load per length in fixed axes on the section at a place with the pose `pose`.
    pub(super) fn along(&self, place: &MaterialPoint, pose: &Pose, order: Order) -> Option<Load> {
        let span = &self.line.spans[place.element][place.piece];
        self.external(&SectionMaterial::section(span, place.s), pose, order)
    }

    /// Total external load on section material.
    pub(super) fn external(&self, material: &SectionMaterial, pose: &Pose, order: Order) -> Option<Load> {
        self.on(&Frame::Section(material), pose, order, &mut TermWrenches::none())
    }

    /// Total external load on a frame, in fixed axes; adds each term's wrench about the base to `wrenches`.
    pub(super) fn on(
        &self,
        frame: &Frame<'_>,
        pose: &Pose,
        order: Order,
        wrenches: &mut TermWrenches,
    ) -> Option<Load> {
        self.terms.load(frame, pose, &Matrix3::identity(), order, (&self.inputs.base.position, wrenches))
    }

    /// External wrenches on the bodies carried by the nodes.
    pub(super) fn node_wrenches(&self, poses: &[Pose]) -> Option<TermWrenches> {
        let mut out = TermWrenches::none();
        for (node, frame) in Frame::at_nodes(&self.line.chain) {
            self.on(&frame, &poses[node], Order::Gradient, &mut out)?;
        }
        Some(out)
    }

    /// Load on node `node`; `poses` are those of the nodes up to it. `None` where bodies touch.
    pub(super) fn node(&self, node: usize, poses: &[Pose], order: Order) -> Option<NodeLoad> {
        let mut load = Load::zero();
        for (_, frame) in Frame::at_nodes(&self.line.chain).filter(|(own, _)| *own == node) {
            load += self.on(&frame, &poses[node], order, &mut TermWrenches::none())?;
        }
        let mut out = NodeLoad {
            energy: load.energy,
            gradient: gradient(&load),
            own: derivative(&load),
            pairs: Vec::new(),
        };
        let of = |ring: usize| self.line.chain.rings[ring].node;
        for pair in self.terms.pairs.each().filter(|[_, second]| of(*second) == node) {
            self.add_pair(&mut out, pair, poses, order)?;
        }
        Some(out)
    }

    /// Adds the interaction of a preceding ring with a later one.
    fn add_pair(&self, out: &mut NodeLoad, rings: [usize; 2], poses: &[Pose], order: Order) -> Option<()> {
        let [first, second] = rings.map(|ring| self.line.chain.rings[ring].node);
        let load = self.terms.pairs.load(rings, [&poses[first], &poses[second]], order)?;
        out.energy += load.on_second.energy;
        out.gradient += gradient(&load.on_second);
        let mut pair = Pair {
            node: first,
            by_first: Matrix6::zeros(),
            reaction: gradient(&load.on_first),
            reaction_by: [Matrix6::zeros(); 2],
        };
        if order == Order::Hessian {
            let second = load.hessian();
            out.own += second.second_second + turning_of(&load.on_second.moment());
            pair.by_first = second.first_second.transpose();
            let turned = turning_of(&load.on_first.moment());
            pair.reaction_by = [second.first_first + turned, second.first_second];
        }
        out.pairs.push(pair);
        Some(())
    }

    /// The loads on all nodes and their total, the reactions on earlier rings included.
    pub(super) fn nodes(&self, poses: &[Pose], order: Order) -> Option<(Vec<NodeLoad>, Vec<Vector6<f64>>)> {
        let loads: Option<Vec<NodeLoad>> =
            (0..poses.len()).map(|node| self.node(node, poses, order)).collect();
        let loads = loads?;
        let mut total: Vec<Vector6<f64>> = loads.iter().map(|load| load.gradient).collect();
        for pair in loads.iter().flat_map(|load| &load.pairs) {
            total[pair.node] += pair.reaction;
        }
        Some((loads, total))
    }
}

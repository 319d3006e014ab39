//! What acts on the chain at given inputs: loads along the spans and on the nodes, with their derivatives.
//!
//! Derivatives are those of force and moment in fixed axes by displacements `p + pi`, `exp(omega) R` of the bodies: other
//! than second derivatives of an energy they are not symmetric where a moment acts.

use nalgebra::{Matrix3, Matrix6, Vector3, Vector6};

use super::line::{Line, Place};
use crate::equilibrium::{Inputs, Interaction, PairLoad, PairRules, Source, blocks, overlap, weight};
use crate::geometry::{Pose, hat};
use crate::rod::{Load, Matter, Order};

/// Everything that the loads on a shape depend on.
#[derive(Debug, Clone, Copy)]
pub(super) struct Surroundings<'a> {
    pub(super) line: &'a Line,
    pub(super) interaction: Interaction,
    pub(super) inputs: &'a Inputs,
    pub(super) field: Source<'a>,
    pub(super) rules: &'a PairRules,
}

/// What acts on a node: the ring there and, at the last one, the tip.
#[derive(Debug, Clone)]
pub(super) struct NodeLoad {
    /// Energy, that of the pairs included, J.
    pub(super) energy: f64,
    /// Derivative of the energy by the node's displacement: minus force (N) and moment (N m).
    pub(super) gradient: Vector6<f64>,
    /// Derivative of `gradient` by the node's own displacement.
    pub(super) own: Matrix6<f64>,
    /// The rings before it that act on it.
    pub(super) pairs: Vec<Pair>,
    /// External magnetic part of the gradient.
    pub(super) magnetic: Vector6<f64>,
}

/// How a ring before acts on the ring of a node, and that back on it.
#[derive(Debug, Clone)]
pub(super) struct Pair {
    /// Node of the ring before.
    pub(super) node: usize,
    /// Derivative of the gradient of the later node by this one's displacement.
    pub(super) by_first: Matrix6<f64>,
    /// The reaction on the ring before, as a gradient.
    pub(super) reaction: Vector6<f64>,
    /// Derivative of the reaction by both nodes' displacements, the earlier first.
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

/// Derivative of a load's gradient by the displacement of its frame.
pub(super) fn derivative(load: &Load) -> Matrix6<f64> {
    let n = &load.couple;
    let turned = load.rotation_rotation + n.transpose() - Matrix3::identity() * n.trace();
    blocks(&load.position_position, &load.position_rotation, &load.position_rotation.transpose(), &turned)
}

/// What a symmetric second derivative lacks to the derivative of a gradient with this moment.
fn turning_of(moment: &Vector3<f64>) -> Matrix6<f64> {
    let zero = Matrix3::zeros();
    blocks(&zero, &zero, &zero, &(hat(moment) * -0.5))
}

impl Surroundings<'_> {
    /// Whether an external magnet acts.
    pub(super) fn has_magnet(&self) -> bool {
        self.field.has_magnet()
    }

    /// Load per length at a place with the pose `pose`, in fixed axes.
    pub(super) fn along(&self, place: &Place, pose: &Pose, order: Order) -> Option<Load> {
        let span = &self.line.spans[place.element][place.piece];
        self.external(&Matter::section(span, place.s), pose, order)
    }

    /// Load of the external field and of gravity on some material.
    pub(super) fn external(&self, matter: &Matter, pose: &Pose, order: Order) -> Option<Load> {
        let mut load = self.magnetic(matter, pose, order)?;
        if self.inputs.gravity != Vector3::zeros() {
            load += weight(matter, pose, &self.inputs.gravity);
        }
        Some(load)
    }

    /// Load of the external field alone.
    pub(super) fn magnetic(&self, matter: &Matter, pose: &Pose, order: Order) -> Option<Load> {
        Some(self.field.on_matter(matter, pose, order)?.in_axes(&self.field.axes().transpose()))
    }

    /// Load of the external field on a ring whose node is at `pose`.
    pub(super) fn on_ring(&self, index: usize, pose: &Pose, order: Order) -> Option<Load> {
        let body = &self.line.chain.rings[index];
        let centre = body.centre(pose).position;
        self.field.on_ring(body, pose, self.rules.external(index, self.field.distance(&centre)), order)
    }

    /// Load on node `node`; `poses` are those of the nodes up to it. `None` where bodies touch.
    pub(super) fn node(&self, node: usize, poses: &[Pose], order: Order) -> Option<NodeLoad> {
        let chain = &self.line.chain;
        let pose = &poses[node];
        let mut load = Load::zero();
        let mut magnetic = Vector6::zeros();
        let index = chain.rings.iter().position(|body| body.node == node);
        if let Some(index) = index {
            load = self.on_ring(index, pose, order)?;
            magnetic = gradient(&load);
            let body = &chain.rings[index];
            let arm = pose.axis() * body.half_length();
            let dead = self.inputs.ring_forces[index] + self.inputs.gravity * body.ring.mass;
            load += Load::dead_force(&dead, &pose.position, &arm);
        }
        let is_tip = node == self.line.count();
        if is_tip {
            let arm = pose.axis() * chain.tip_offset;
            load += Load::dead_force(&self.inputs.tip_force, &pose.position, &arm);
        }
        let mut out = NodeLoad {
            energy: load.energy,
            gradient: gradient(&load),
            own: derivative(&load),
            pairs: Vec::new(),
            magnetic,
        };
        if is_tip {
            // Dead in space: no derivative, and no energy.
            out.gradient -= column(&Vector3::zeros(), &self.inputs.tip_moment);
        }
        if let Some(index) = index.filter(|_| self.interaction != Interaction::None) {
            for earlier in 0..index {
                self.add_pair(&mut out, [earlier, index], poses, order)?;
            }
        }
        Some(out)
    }

    /// Adds the load of an earlier ring on a later one.
    fn add_pair(&self, out: &mut NodeLoad, rings: [usize; 2], poses: &[Pose], order: Order) -> Option<()> {
        let [first, second] = rings.map(|index| &self.line.chain.rings[index]);
        let (from, to) = (&poses[first.node], &poses[second.node]);
        if overlap(first, from, second, to) > 0.0 {
            return None;
        }
        let rule = self.rules.between(rings[0], rings[1]);
        let load = PairLoad::new(&Source::ring(first, from, false), [from, to], second, rule, order)?;
        out.energy += load.on_second.energy;
        out.gradient += gradient(&load.on_second);
        let mut pair = Pair {
            node: first.node,
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

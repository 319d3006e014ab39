//! Interaction of rings with one another.

use super::super::chain::Chain;
use super::super::pair_quadrature::PairQuadrature;
use super::super::ring_body::RingBody;
use super::super::ring_field::RingField;
use super::super::settings::Interaction;
use super::super::span_quadrature::MULTIPOLE_SHARE;
use super::pair::PairLoad;
use crate::geometry::Pose;
use crate::magnetics::{FieldAccuracy, PairRule, depth};
use crate::rod::{Load, Order};

/// All pairs of interacting rings.
#[derive(Debug, Clone, Copy)]
pub(crate) struct RingPairs<'a> {
    chain: &'a Chain,
    interaction: Interaction,
    rules: &'a PairQuadrature,
}

impl<'a> RingPairs<'a> {
    pub(crate) fn new(chain: &'a Chain, interaction: Interaction, rules: &'a PairQuadrature) -> Self {
        Self { chain, interaction, rules }
    }

    /// The numbers of the two rings of each pair that is not welded together, the proximal one first.
    pub(crate) fn each(&self) -> impl Iterator<Item = [usize; 2]> + use<'a> {
        let chain = self.chain;
        let rings = if self.interaction == Interaction::None { 0 } else { chain.rings.len() };
        let pairs = (0..rings).flat_map(move |first| (first + 1..rings).map(move |second| [first, second]));
        pairs.filter(|[first, second]| chain.rings[*first].node != chain.rings[*second].node)
    }

    /// Whether the distal ring acts back on the proximal one.
    pub(crate) fn are_mutual(&self) -> bool {
        self.interaction != Interaction::Preceding
    }

    /// Whether any ring that is not on the clamped base acts on distal bodies without reaction: such forces are not
    /// conservative.
    pub(crate) fn one_sided(&self) -> bool {
        let free = 1..self.chain.elements.len();
        !self.are_mutual() && self.chain.rings.iter().any(|body| free.contains(&body.node))
    }

    /// The energy of two rings with nodes at `nodes`, as loads on both; `None` where they overlap.
    pub(crate) fn load(&self, pair: [usize; 2], nodes: [&Pose; 2], order: Order) -> Option<PairLoad> {
        let [first, second] = pair.map(|number| &self.chain.rings[number]);
        if overlap(first, nodes[0], second, nodes[1]) > 0.0 {
            return None;
        }
        let between = nodes[1].position - nodes[0].position;
        if first.magnetisation == 0.0 || second.magnetisation == 0.0 {
            return Some(PairLoad::reciprocal(&Load::zero(), between));
        }
        let source = RingField::new(first, nodes[0]);
        let load = match self.rules.between(pair[0], pair[1]) {
            PairRule::Axis(rule, distance) => {
                let ratio = first.extent() / (distance + first.half_length());
                let allowed = MULTIPOLE_SHARE * self.rules.accuracy();
                let accuracy = FieldAccuracy::far(ratio * ratio, allowed).unwrap_or(FieldAccuracy::Exact);
                source.on_axis(second, nodes[1], rule, accuracy, order)?
            }
            PairRule::Faces(faces) => source.on_surface(second, nodes[1], (faces, None), order)?,
            PairRule::Surface(faces, wall) => {
                source.on_surface(second, nodes[1], (faces, Some(wall)), order)?
            }
        };
        // The energy depends on the relative pose alone, so that forces and torques of the pair balance up to rounding.
        let load = load.in_axes(&source.axes().transpose());
        Some(PairLoad::reciprocal(&load, between))
    }
}

/// Penetration depth of two rings, m; 0 where they do not overlap. Bores count as filled.
pub(crate) fn overlap(first: &RingBody, first_node: &Pose, second: &RingBody, second_node: &Pose) -> f64 {
    let (from, to) = (first.centre(first_node), second.centre(second_node));
    if (to.position - from.position).norm() > first.extent() + second.extent() {
        return 0.0;
    }
    depth(&first.outline(), &second.outline(), &to.seen_from(&from))
}

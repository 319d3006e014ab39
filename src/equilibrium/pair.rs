//! The mutual energy of two rings, with its derivatives by the poses of both.

use nalgebra::{Matrix3, Matrix6, Vector3};

use super::chain::RingBody;
use super::source::Source;
use crate::geometry::{Pose, hat};
use crate::magnetics::{PairRule, depth};
use crate::rod::{Load, Order, turning};

/// The energy of a pair as loads on its two nodes.
#[derive(Debug, Clone)]
pub(crate) struct PairLoad {
    /// On the second body's node.
    pub(crate) on_second: Load,
    /// On the first body's node: force and couple only.
    pub(crate) on_first: Load,
    /// From the first node to the second, m.
    between: Vector3<f64>,
}

/// Second derivatives of a pair's energy by the displacements (position, rotation) of its two nodes.
#[derive(Debug, Clone)]
pub(crate) struct PairHessian {
    /// By the first node.
    pub(crate) first_first: Matrix6<f64>,
    /// Mixed, rows of the first node.
    pub(crate) first_second: Matrix6<f64>,
    /// By the second node.
    pub(crate) second_second: Matrix6<f64>,
}

/// The mixed second derivative of a ring's and a station's energy: rows of the ring's node, columns of the
/// station, in fixed axes.
#[derive(Debug, Clone)]
pub(crate) struct Mixed {
    pub(crate) station: usize,
    pub(crate) node: usize,
    pub(crate) matrix: Matrix6<f64>,
}

/// How deep two rings are inside one another, m; 0 where they share no volume. Nothing fits into their bores.
pub(crate) fn overlap(first: &RingBody, first_node: &Pose, second: &RingBody, second_node: &Pose) -> f64 {
    let (from, to) = (first.centre(first_node), second.centre(second_node));
    let extent = |body: &RingBody| body.ring.outer_radius.hypot(body.half_length());
    if (to.position - from.position).norm() > extent(first) + extent(second) {
        return 0.0;
    }
    depth(&first.outline(), &second.outline(), &to.seen_from(&from))
}

impl PairLoad {
    /// Energy of `second` in the field of `first`, whose nodes are at `nodes`; `None` where that is singular.
    ///
    /// The energy depends on the relative pose alone, so that forces and torques cancel to rounding.
    pub(crate) fn new(
        first: &Source<'_>,
        nodes: [&Pose; 2],
        second: &RingBody,
        rule: PairRule<'_>,
        order: Order,
    ) -> Option<Self> {
        let load = match rule {
            PairRule::Axis(rule) => first.on_ring(second, nodes[1], rule, order)?,
            PairRule::Faces(rules) => first.on_faces(second, nodes[1], rules, order)?,
        };
        Some(Self::reciprocal(&load, nodes[1].position - nodes[0].position))
    }

    /// Completes a load on the second body of a pair by the reaction on the first, `between` nodes apart (m).
    pub(crate) fn reciprocal(on_second: &Load, between: Vector3<f64>) -> Self {
        let whole = on_second.couple + on_second.force * between.transpose();
        let on_first = Load { force: -on_second.force, couple: -whole, ..Load::zero() };
        Self { on_second: *on_second, on_first, between }
    }

    /// The second derivatives.
    pub(crate) fn hessian(&self) -> PairHessian {
        let load = &self.on_second;
        let zero = Matrix3::zeros();
        let own = blocks(
            &load.position_position,
            &load.position_rotation,
            &load.position_rotation.transpose(),
            &load.rotation_rotation,
        );
        // A displacement of the first node acts like the opposite displacement of the second.
        let carry = blocks(&-Matrix3::identity(), &hat(&self.between), &zero, &-Matrix3::identity());
        let pull = hat(&load.force);
        let swing = Matrix3::identity() * load.couple.trace() - load.couple.transpose();
        let carried = carry.transpose() * own;
        PairHessian {
            first_first: carried * carry + blocks(&zero, &pull, &-pull, &turning(&-self.on_first.couple)),
            first_second: carried + blocks(&zero, &zero, &pull, &swing),
            second_second: own + blocks(&zero, &zero, &zero, &turning(&load.couple)),
        }
    }
}

/// A 6 x 6 matrix from its four blocks.
pub(crate) fn blocks(a: &Matrix3<f64>, b: &Matrix3<f64>, c: &Matrix3<f64>, d: &Matrix3<f64>) -> Matrix6<f64> {
    let mut out = Matrix6::zeros();
    out.fixed_view_mut::<3, 3>(0, 0).copy_from(a);
    out.fixed_view_mut::<3, 3>(0, 3).copy_from(b);
    out.fixed_view_mut::<3, 3>(3, 0).copy_from(c);
    out.fixed_view_mut::<3, 3>(3, 3).copy_from(d);
    out
}

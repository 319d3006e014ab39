//! Mutual energy of two bodies, with its derivatives with respect to both poses.

use nalgebra::{Matrix3, Matrix6, Vector3};

use crate::geometry::hat;
use crate::rod::{Load, turning};

/// The energy of a pair as loads on its two nodes.
#[derive(Debug, Clone)]
pub(crate) struct PairLoad {
    /// Load on the second body's node.
    pub(crate) on_second: Load,
    /// Load on the first body's node: force and couple only.
    pub(crate) on_first: Load,
    /// Vector from the first node to the second, m.
    between: Vector3<f64>,
}

/// Second derivatives of a pair's energy with respect to the displacements (position, rotation) of its two nodes.
#[derive(Debug, Clone)]
pub(crate) struct PairHessian {
    /// With respect to the first node.
    pub(crate) first_first: Matrix6<f64>,
    /// Mixed derivatives, with the rows of the first node.
    pub(crate) first_second: Matrix6<f64>,
    /// With respect to the second node.
    pub(crate) second_second: Matrix6<f64>,
}

impl PairLoad {
    /// Adds the reaction on the first body to a load on the second body of a pair; `between` is the vector between the
    /// nodes (m).
    pub(crate) fn reciprocal(on_second: &Load, between: Vector3<f64>) -> Self {
        let whole = on_second.couple + on_second.force * between.transpose();
        let on_first = Load { force: -on_second.force, couple: -whole, ..Load::zero() };
        Self { on_second: *on_second, on_first, between }
    }

    /// Second derivatives of the pair's energy.
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

//! How a change at an element's start, or of the rings that act on it, arrives at its end.

use nalgebra::{Matrix6, SMatrix};

use super::node_shape::Basis;
use super::node_system::Link;

use super::strong_form::{Matrix12, Vector12};
use crate::geometry::RotationVector;

/// Columns by the displacement of one ring.
pub(super) type RingColumns = SMatrix<f64, 12, 6>;

/// Derivative of an element's end (displacement, wrench).
#[derive(Debug, Clone)]
pub(super) struct Transfer {
    /// By its start.
    pub(super) own: Matrix12,
    /// By the nodes after the base whose rings act on it without reaction.
    pub(super) rings: Vec<RingColumns>,
}

impl Transfer {
    /// Nothing crossed yet, with so many rings.
    pub(super) fn identity(rings: usize) -> Self {
        Self { own: Matrix12::identity(), rings: vec![RingColumns::zeros(); rings] }
    }
}

/// Splits the columns of a state's change into local coordinates, in which the rotation vector starts at zero, and the
/// rotation of the start.
pub(super) fn split<const C: usize>(columns: &SMatrix<f64, 12, C>) -> (SMatrix<f64, 12, C>, SMatrix<f64, 3, C>) {
    let mut local = *columns;
    let turned = columns.fixed_view::<3, C>(3, 0).into_owned();
    local.fixed_view_mut::<3, C>(3, 0).fill(0.0);
    (local, turned)
}

/// Joins them again at the end of an interval, where the local coordinates are `end`.
pub(super) fn join<const C: usize>(
    end: &Vector12,
    local: &SMatrix<f64, 12, C>,
    turned: &SMatrix<f64, 3, C>,
) -> SMatrix<f64, 12, C> {
    let theta = RotationVector::new(end.fixed_rows::<3>(3).into_owned());
    let whole = theta.left_jacobian() * local.fixed_view::<3, C>(3, 0) + theta.matrix() * turned;
    let mut out = *local;
    out.fixed_view_mut::<3, C>(3, 0).copy_from(&whole);
    out
}

/// Adds to the rates' columns what the displacement of a ring does directly.
pub(super) fn force(rates: &mut RingColumns, mixed: &Matrix6<f64>) {
    let mut target = rates.fixed_view_mut::<6, 6>(6, 0);
    target += mixed;
}

impl Transfer {
    /// The same in the coordinates of nodes and wrenches.
    pub(super) fn link(&self, basis: &Basis<6>) -> Link<6> {
        let own = |row: usize, column: usize| self.own.fixed_view::<6, 6>(row, column).into_owned();
        let ring = |columns: &RingColumns| {
            [
                basis.pose_part * columns.fixed_view::<6, 6>(0, 0) * basis.pose,
                basis.wrench_part * columns.fixed_view::<6, 6>(6, 0) * basis.pose,
            ]
        };
        Link::new(
            [basis.pose_part * own(0, 0) * basis.pose, basis.pose_part * own(0, 6) * basis.wrench],
            [basis.wrench_part * own(6, 0) * basis.pose, basis.wrench_part * own(6, 6) * basis.wrench],
            self.rings.iter().map(ring).collect(),
        )
    }
}

//! Poses and wrenches at the nodes: the unknowns of multiple shooting and the matching conditions between them.

use nalgebra::{Matrix6, SMatrix, SVector, Vector6};

use super::line::Line;
use super::node_system::{Block, Coupling, Defects, Link, Solution};
use super::strong_form::{Matrix12, State};
use super::surroundings::{NodeLoad, column};
use super::trace::Trace;
use crate::geometry::{Pose, RotationVector, rotation_log};

/// Admissible displacements and wrenches, in nondimensional coordinates.
#[derive(Debug, Clone)]
pub(super) struct Basis<const D: usize> {
    /// Maps from coordinates to displacement (m, rad) and wrench (N, N m).
    pub(super) pose: SMatrix<f64, 6, D>,
    pub(super) wrench: SMatrix<f64, 6, D>,
    /// Maps from displacement and wrench to coordinates.
    pub(super) pose_part: SMatrix<f64, D, 6>,
    pub(super) wrench_part: SMatrix<f64, D, 6>,
}

impl<const D: usize> Basis<D> {
    /// Displacements along the orthonormal columns of `axes`, in the units of a line.
    pub(super) fn new(line: &Line, axes: &SMatrix<f64, 6, D>) -> Self {
        let scaled = |units: [f64; 6]| {
            let by = Vector6::from(units);
            let mut up = *axes;
            let mut down = axes.transpose();
            for j in 0..D {
                up.column_mut(j).component_mul_assign(&by);
                down.row_mut(j).component_div_assign(&by.transpose());
            }
            (up, down)
        };
        let ((pose, pose_part), (wrench, wrench_part)) =
            (scaled(line.pose_units()), scaled(line.wrench_units()));
        Self { pose, wrench, pose_part, wrench_part }
    }

    /// The linearised element of the transition matrix `own` (by displacement and wrench); `next` is left at identity.
    pub(super) fn link(&self, own: &Matrix12) -> Link<D> {
        let own = |row: usize, column: usize| own.fixed_view::<6, 6>(row, column).into_owned();
        Link {
            pose: [self.pose_part * own(0, 0) * self.pose, self.pose_part * own(0, 6) * self.wrench],
            wrench: [self.wrench_part * own(6, 0) * self.pose, self.wrench_part * own(6, 6) * self.wrench],
            next: Block::identity(),
        }
    }

    /// Derivative of a wrench with respect to a displacement.
    pub(super) fn stiffness(&self, matrix: &Matrix6<f64>) -> Block<D> {
        self.wrench_part * matrix * self.pose
    }
}

/// Poses of all nodes, and the wrench at the start of each element.
#[derive(Debug, Clone)]
pub(super) struct NodeShape {
    pub(super) nodes: Vec<Pose>,
    pub(super) wrenches: Vec<Vector6<f64>>,
}

impl NodeShape {
    /// The straight shape without wrenches.
    pub(super) fn straight(line: &Line) -> Self {
        Self { wrenches: vec![Vector6::zeros(); line.count()], nodes: Trace::straight(line).1 }
    }

    /// The shape moved rigidly so that its base is at `base`.
    pub(super) fn carried(&self, base: &Pose) -> Self {
        let old = self.nodes[0];
        let turn = base.rotation * old.rotation.transpose();
        let pose = |node: &Pose| Pose {
            position: base.position + turn * (node.position - old.position),
            rotation: turn * node.rotation,
        };
        let mut nodes: Vec<Pose> = self.nodes.iter().map(pose).collect();
        nodes[0] = *base;
        let wrench =
            |w: &Vector6<f64>| column(&(turn * w.fixed_rows::<3>(0)), &(turn * w.fixed_rows::<3>(3)));
        Self { nodes, wrenches: self.wrenches.iter().map(wrench).collect() }
    }

    /// State at the start of an element.
    pub(super) fn state(&self, element: usize) -> State {
        State { pose: self.nodes[element], wrench: self.wrenches[element] }
    }

    /// Defects between the ends of the elements, with these nodal loads, and the states that follow.
    pub(super) fn defects<const D: usize>(
        &self,
        basis: &Basis<D>,
        ends: &[State],
        loads: &[Vector6<f64>],
    ) -> Defects<D> {
        let mut out = Defects { pose: Vec::new(), wrench: Vec::new() };
        for (k, end) in ends.iter().enumerate() {
            let node = &self.nodes[k + 1];
            let turn = rotation_log(&(end.pose.rotation * node.rotation.transpose()));
            out.pose.push(basis.pose_part * column(&(end.pose.position - node.position), &turn));
            let after = self.wrenches.get(k + 1).copied().unwrap_or_default();
            out.wrench.push(basis.wrench_part * (end.wrench + loads[k + 1] - after));
        }
        out
    }

    /// Transformation of the displacement of the node after element `k` to the axes of the defect: the derivative of the
    /// logarithm, without the factor that both sides share.
    pub(super) fn next<const D: usize>(&self, basis: &Basis<D>, k: usize, end: &State) -> Block<D> {
        let mut turn = Matrix6::identity();
        let across = end.pose.rotation * self.nodes[k + 1].rotation.transpose();
        turn.fixed_view_mut::<3, 3>(3, 3).copy_from(&across);
        basis.pose_part * turn * basis.pose
    }

    /// The shape moved by the fraction `factor` of a step in the order of [`flat`].
    pub(super) fn moved<const D: usize>(&self, basis: &Basis<D>, step: &[f64], factor: f64) -> Self {
        let part = |number: usize| {
            SVector::<f64, D>::from_column_slice(&step[D * number..D * (number + 1)]) * factor
        };
        let count = self.wrenches.len();
        let mut out = self.clone();
        for (k, node) in out.nodes[1..].iter_mut().enumerate() {
            let moved = basis.pose * part(k);
            node.position += moved.fixed_rows::<3>(0);
            let turn = RotationVector::new(moved.fixed_rows::<3>(3).into_owned());
            node.rotation = turn.matrix() * node.rotation;
        }
        for (k, wrench) in out.wrenches.iter_mut().enumerate() {
            *wrench += basis.wrench * part(count + k);
        }
        out
    }
}

/// A solution as one list: node displacements, then wrenches.
pub(super) fn flat<const D: usize>(solution: &Solution<D>) -> Vec<f64> {
    solution.poses.iter().chain(&solution.wrenches).flat_map(|part| part.iter().copied()).collect()
}

/// Euclidean norm of all defects.
pub(super) fn size<const D: usize>(defects: &Defects<D>) -> f64 {
    let squares = defects.pose.iter().chain(&defects.wrench).map(SVector::norm_squared);
    squares.sum::<f64>().sqrt()
}

/// Derivatives of the nodal balances with respect to the nodal displacements, without the clamped base.
pub(super) fn couplings<const D: usize>(basis: &Basis<D>, loads: &[NodeLoad]) -> Vec<Coupling<D>> {
    let mut out = Vec::new();
    let mut add = |node: usize, by: usize, matrix: &Matrix6<f64>| {
        if node > 0 && by > 0 {
            out.push(Coupling { node, by, block: basis.stiffness(matrix) });
        }
    };
    for (node, load) in loads.iter().enumerate() {
        add(node, node, &load.own);
        for pair in &load.pairs {
            add(node, pair.node, &pair.by_first);
            add(pair.node, pair.node, &pair.reaction_by[0]);
            add(pair.node, node, &pair.reaction_by[1]);
        }
    }
    out
}

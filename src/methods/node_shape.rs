//! Poses and wrenches at the nodes: the unknowns of shooting from node to node, and the equations between them.

use nalgebra::{Matrix6, SMatrix, SVector, Vector6};

use super::line::Line;
use super::node_system::{Block, Coupling, Defects, Link, Solution};
use super::strong_form::{Matrix12, State};
use super::surroundings::{NodeLoad, column};
use super::trace::Trace;
use crate::geometry::{Pose, RotationVector, rotation_log};

/// Which displacements and wrenches there are, in coordinates of one size.
#[derive(Debug, Clone)]
pub(super) struct Basis<const D: usize> {
    /// Displacement (m, rad) and wrench (N, N m) by their coordinates.
    pub(super) pose: SMatrix<f64, 6, D>,
    pub(super) wrench: SMatrix<f64, 6, D>,
    /// Coordinates by displacement and wrench.
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

    /// What leads from the start of an element to its end, `next` left at one, from its derivative by displacement and
    /// wrench.
    pub(super) fn link(&self, own: &Matrix12) -> Link<D> {
        let own = |row: usize, column: usize| own.fixed_view::<6, 6>(row, column).into_owned();
        Link {
            pose: [self.pose_part * own(0, 0) * self.pose, self.pose_part * own(0, 6) * self.wrench],
            wrench: [self.wrench_part * own(6, 0) * self.pose, self.wrench_part * own(6, 6) * self.wrench],
            next: Block::identity(),
        }
    }

    /// Derivative of a wrench by a displacement.
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
    /// Straight and without wrenches.
    pub(super) fn straight(line: &Line) -> Self {
        Self { wrenches: vec![Vector6::zeros(); line.count()], nodes: Trace::straight(line).1 }
    }

    /// The same shape with its base at `base`.
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

    /// What the ends of the elements, under these loads on the nodes, lack to the states that follow.
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

    /// What turns the displacement of the node after element `k` into the defect's axes: the derivative of the logarithm,
    /// less what both sides share.
    pub(super) fn next<const D: usize>(&self, basis: &Basis<D>, k: usize, end: &State) -> Block<D> {
        let mut turn = Matrix6::identity();
        let across = end.pose.rotation * self.nodes[k + 1].rotation.transpose();
        turn.fixed_view_mut::<3, 3>(3, 3).copy_from(&across);
        basis.pose_part * turn * basis.pose
    }

    /// Moved by the part `factor` of a step in the order of [`flat`].
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

/// A solution as one list: node poses, then wrenches.
pub(super) fn flat<const D: usize>(solution: &Solution<D>) -> Vec<f64> {
    solution.poses.iter().chain(&solution.wrenches).flat_map(|part| part.iter().copied()).collect()
}

/// Norm of all defects.
pub(super) fn size<const D: usize>(defects: &Defects<D>) -> f64 {
    let squares = defects.pose.iter().chain(&defects.wrench).map(SVector::norm_squared);
    squares.sum::<f64>().sqrt()
}

/// Derivatives of the nodes' balances by the displacements of nodes, the clamped base left out.
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

//! Static condensation (Schur complement) of one element: its Hessian in terms of its two end nodes, with the mode
//! amplitudes eliminated.
//!
//! The first mode of each strain component is expressed by the displacements of the end nodes (linearised kinematics),
//! the others are eliminated by a Cholesky factorisation. A congruence preserves the inertia, so that the condensed chain
//! is positive definite exactly when the whole Hessian is.

use nalgebra::{Matrix3, Matrix6, Vector3};

use crate::numerics::cholesky;
use crate::rod::{Configuration, ElementDerivatives, START};

use super::terms::blocks;

/// Number of columns of the two end nodes.
const NODES: usize = 12;

/// Number of amplitudes that the end nodes determine.
const END: usize = 6;

/// The static condensation (Schur complement) of one element.
#[derive(Debug, Clone)]
pub(super) struct Condensation {
    inner: usize,
    by_start: Matrix6<f64>,
    by_end: Matrix6<f64>,
    /// Derivatives of the first amplitudes with respect to the inner ones, six rows of `inner`.
    by_inner: Vec<f64>,
    /// Hessian in terms of (start, end, inner), row by row.
    whole: Vec<f64>,
    /// Columns of the first six amplitudes, and products with them.
    product: Vec<f64>,
    /// Cholesky factor of the inner block.
    factor: Vec<f64>,
    /// `L^-1` times the coupling of inner amplitudes to nodes, by node column.
    coupling: Vec<f64>,
    /// `L^-1` times the coupling of inner amplitudes to the rings' nodes, by column; empty without coupling.
    outer: Vec<f64>,
    /// Condensed coupling of the two nodes (axes of the start node) to the rings' nodes, twelve rows.
    pub(super) condensed_outer: Vec<f64>,
    /// Condensed Hessian of the two nodes, in the axes of the start node.
    pub(super) condensed: [[f64; NODES]; NODES],
}

impl Condensation {
    /// Allocates storage for an element with this number of amplitudes, coupled to `columns` displacements of rings.
    pub(super) fn new(freedoms: usize, columns: usize) -> Self {
        let inner = freedoms - END;
        let size = NODES + inner;
        Self {
            inner,
            by_start: Matrix6::zeros(),
            by_end: Matrix6::zeros(),
            by_inner: vec![0.0; END * inner],
            whole: vec![0.0; size * size],
            product: vec![0.0; (START + freedoms) * size],
            factor: vec![0.0; inner * inner],
            coupling: vec![0.0; NODES * inner],
            outer: vec![0.0; inner * columns],
            condensed_outer: vec![0.0; NODES * columns],
            condensed: [[0.0; NODES]; NODES],
        }
    }

    /// Linearises the kinematics; `false` where the end pose does not determine the first amplitudes.
    pub(super) fn linearise(&mut self, configuration: &Configuration, tangent: &ElementDerivatives) -> bool {
        let Some(turn) = configuration.end_theta.left_jacobian_inverse() else { return false };
        let column = |i: usize| tangent.end_position[i];
        let stretch = Matrix3::from_columns(&[column(3), column(4), column(5)]);
        let Some(unstretch) = stretch.try_inverse() else { return false };
        let swing = Matrix3::from_columns(&[column(0), column(1), column(2)]) * turn;
        let lever = crate::geometry::hat(&configuration.end.position);
        let zero = Matrix3::zeros();
        self.by_end = blocks(&zero, &turn, &unstretch, &(-unstretch * swing));
        self.by_start = blocks(&zero, &-turn, &-unstretch, &(unstretch * (lever + swing)));
        for i in 0..self.inner {
            let strain = -unstretch * column(END + i);
            for c in 0..3 {
                self.by_inner[c * self.inner + i] = 0.0;
                self.by_inner[(3 + c) * self.inner + i] = strain[c];
            }
        }
        true
    }

    /// Condenses `hessian + shift metric`; `false` if the inner block is not positive definite.
    pub(super) fn condense(&mut self, tangent: &ElementDerivatives, metric: &[f64], shift: f64) -> bool {
        self.transform(tangent, metric, shift);
        let (inner, size) = (self.inner, NODES + self.inner);
        for i in 0..inner {
            let row = &self.whole[(NODES + i) * size..][..size];
            self.factor[i * inner..=i * inner + i].copy_from_slice(&row[NODES..=NODES + i]);
            for (column, value) in row[..NODES].iter().enumerate() {
                self.coupling[column * inner + i] = *value;
            }
        }
        if !cholesky::factorise(&mut self.factor, inner) {
            return false;
        }
        for column in self.coupling.chunks_exact_mut(inner.max(1)) {
            cholesky::forward(&self.factor, inner, column);
        }
        for i in 0..NODES {
            for j in 0..=i {
                let (a, b) = (&self.coupling[i * inner..][..inner], &self.coupling[j * inner..][..inner]);
                let value = self.whole[i * size + j] - cholesky::dot(a, b);
                self.condensed[i][j] = value;
                self.condensed[j][i] = value;
            }
        }
        true
    }

    /// Condenses the coupling of (start, amplitudes) to the rings' nodes, one row for each of their displacements; call
    /// it after [`Self::condense`].
    pub(super) fn condense_outer(&mut self, cross: &[f64], columns: usize) {
        let inner = self.inner;
        for (column, entries) in cross.chunks_exact(START + END + inner).enumerate() {
            let (nodes, amplitudes) = entries.split_at(START);
            let (ends, rest) = amplitudes.split_at(END);
            let own = &mut self.outer[column * inner..][..inner];
            own.copy_from_slice(rest);
            for (end, by_inner) in ends.iter().zip(self.by_inner.chunks_exact(inner.max(1))) {
                own.iter_mut().zip(by_inner).for_each(|(entry, x)| *entry += end * x);
            }
            cholesky::forward(&self.factor, inner, own);
            for (k, node) in nodes.iter().enumerate() {
                let (mut start, mut end) = (*node, 0.0);
                for (c, value) in ends.iter().enumerate() {
                    start += value * self.by_start[(c, k)];
                    end += value * self.by_end[(c, k)];
                }
                let along = |row: usize| cholesky::dot(&self.coupling[row * inner..][..inner], own);
                self.condensed_outer[k * columns + column] = start - along(k);
                self.condensed_outer[(START + k) * columns + column] = end - along(START + k);
            }
        }
    }

    /// `L^-1` times the coupling to one displacement of a ring.
    pub(super) fn outer(&self, column: usize) -> &[f64] {
        &self.outer[column * self.inner..][..self.inner]
    }

    /// Subtracts the contribution of the eliminated amplitudes (see [`Self::eliminate`]) from the right-hand side of the
    /// rings' nodes.
    pub(super) fn eliminate_outer(&self, rhs: &[f64], rings: &mut [f64]) {
        for (column, entry) in rings.iter_mut().enumerate() {
            *entry -= cholesky::dot(self.outer(column), &rhs[END..]);
        }
    }

    /// Subtracts the contribution of the rings' node displacements from the eliminated amplitudes, before these are
    /// recovered.
    pub(super) fn recover_outer(&self, rings: &[f64], rhs: &mut [f64]) {
        for (column, value) in rings.iter().enumerate() {
            for (entry, x) in rhs[END..].iter_mut().zip(self.outer(column)) {
                *entry -= value * x;
            }
        }
    }

    /// Transforms the Hessian to (start, end, inner amplitudes) by substituting the first amplitudes.
    fn transform(&mut self, tangent: &ElementDerivatives, metric: &[f64], shift: f64) {
        let (inner, size) = (self.inner, NODES + self.inner);
        let rows = tangent.size;
        let first = START..START + END;
        for r in 0..rows {
            let row = &tangent.hessian[r * rows..][..rows];
            let mut ends = [0.0; END];
            ends.copy_from_slice(&row[first.clone()]);
            let out = &mut self.product[r * size..][..size];
            out.fill(0.0);
            out[..START].copy_from_slice(&row[..START]);
            out[NODES..].copy_from_slice(&row[START + END..]);
            if r >= START {
                let shifted = shift * metric[r - START];
                if r < START + END {
                    ends[r - START] += shifted;
                } else {
                    out[NODES + r - START - END] += shifted;
                }
            }
            for (c, value) in ends.iter().enumerate() {
                for k in 0..6 {
                    out[k] += value * self.by_start[(c, k)];
                    out[START + k] += value * self.by_end[(c, k)];
                }
                let by_inner = &self.by_inner[c * inner..][..inner];
                out[NODES..].iter_mut().zip(by_inner).for_each(|(entry, x)| *entry += value * x);
            }
        }
        let (product, whole) = (&self.product, &mut self.whole);
        whole[..START * size].copy_from_slice(&product[..START * size]);
        whole[START * size..NODES * size].fill(0.0);
        whole[NODES * size..].copy_from_slice(&product[(START + END) * size..rows * size]);
        for c in 0..END {
            let source = &product[(START + c) * size..][..size];
            let mut add = |row: usize, factor: f64| {
                let target = &mut whole[row * size..][..size];
                target.iter_mut().zip(source).for_each(|(entry, x)| *entry += factor * x);
            };
            for k in 0..6 {
                add(k, self.by_start[(c, k)]);
                add(START + k, self.by_end[(c, k)]);
            }
            for i in 0..inner {
                add(NODES + i, self.by_inner[c * inner + i]);
            }
        }
    }

    /// Eliminates the amplitudes from a right-hand side: returns the part of the two nodes and keeps the rest in `rhs`.
    pub(super) fn eliminate(&self, rhs: &mut [f64]) -> [f64; NODES] {
        let mut nodes = [0.0; NODES];
        let (ends, inner) = rhs.split_at_mut(END);
        for (c, value) in ends.iter().enumerate() {
            for k in 0..6 {
                nodes[k] += value * self.by_start[(c, k)];
                nodes[START + k] += value * self.by_end[(c, k)];
            }
            let by_inner = &self.by_inner[c * self.inner..][..self.inner];
            inner.iter_mut().zip(by_inner).for_each(|(entry, x)| *entry += value * x);
        }
        cholesky::forward(&self.factor, self.inner, inner);
        for (node, column) in nodes.iter_mut().zip(self.coupling.chunks_exact(self.inner.max(1))) {
            *node -= cholesky::dot(column, inner);
        }
        nodes
    }

    /// Recovers the amplitudes in `rhs` from the displacements of the two nodes.
    pub(super) fn recover(&self, nodes: &[f64; NODES], rhs: &mut [f64]) {
        let (ends, inner) = rhs.split_at_mut(END);
        for (node, column) in nodes.iter().zip(self.coupling.chunks_exact(self.inner.max(1))) {
            inner.iter_mut().zip(column).for_each(|(entry, x)| *entry -= node * x);
        }
        cholesky::backward(&self.factor, self.inner, inner);
        for (c, end) in ends.iter_mut().enumerate() {
            *end = cholesky::dot(&self.by_inner[c * self.inner..][..self.inner], inner);
            for k in 0..6 {
                *end += self.by_start[(c, k)] * nodes[k] + self.by_end[(c, k)] * nodes[START + k];
            }
        }
    }
}

/// Rotates the four vectors of two nodes from the axes of a frame to fixed axes (or back, with its transpose).
pub(super) fn turn_nodes(rotation: &Matrix3<f64>, nodes: &mut [f64; NODES]) {
    for part in nodes.chunks_exact_mut(3) {
        let turned = rotation * Vector3::new(part[0], part[1], part[2]);
        part.copy_from_slice(turned.as_slice());
    }
}

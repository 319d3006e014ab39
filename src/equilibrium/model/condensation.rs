//! Static condensation (Schur complement) of one element: its Hessian in terms of its two end nodes, with the mode
//! amplitudes eliminated.
//!
//! The first mode of each strain component is expressed by the displacements of the end nodes (linearised kinematics),
//! the others are eliminated by a Cholesky factorisation. A congruence preserves the inertia, so that the condensed chain
//! is positive definite exactly when the whole Hessian is.

use nalgebra::{Matrix3, Matrix6, Vector3};

use crate::numerics::{cholesky, dense};
use crate::rod::{Configuration, ElementDerivatives, START};

use super::terms::blocks;

/// Number of columns of the two end nodes.
const NODES: usize = 12;

/// Number of amplitudes that the end nodes determine.
const END: usize = 6;

/// The static condensation (Schur complement) of one element.
///
/// All matrices are stored row by row.
#[derive(Debug, Clone)]
pub(crate) struct Condensation {
    inner: usize,
    /// Number of rows and columns of the element: its two nodes and the inner amplitudes.
    size: usize,
    /// Number of columns that are coupled to the inner amplitudes: its two nodes and the rings' nodes.
    columns: usize,
    /// Derivatives of the first amplitudes with respect to (start, end, inner), six rows.
    first: Vec<f64>,
    /// Hessian in terms of (start, end, inner), whose upper triangle counts; below it a row for each displacement of a ring.
    whole: Vec<f64>,
    /// Columns of the first amplitudes of these rows.
    ends: Vec<f64>,
    /// Cholesky factor `L` of the inner block.
    factor: Vec<f64>,
    /// `L^-1` times the coupling of the inner amplitudes to the columns.
    coupling: Vec<f64>,
    /// What the elimination of the inner amplitudes takes from the Hessian of the columns: the upper triangle.
    eliminated: Vec<f64>,
}

/// What is added to the diagonal of an element's Hessian.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Added<'a> {
    /// Factor on the elastic stiffness, and that of each amplitude.
    pub(crate) shift: f64,
    pub(crate) metric: &'a [f64],
    /// An amplitude and the stiffness that holds it, 0 where none is held.
    pub(crate) held: (usize, f64),
}

impl Condensation {
    /// Allocates storage for an element with this number of amplitudes, coupled to `rings` displacements of rings.
    pub(crate) fn new(freedoms: usize, rings: usize) -> Self {
        let (inner, size, columns) = (freedoms - END, START + freedoms, NODES + rings);
        Self {
            inner,
            size,
            columns,
            first: vec![0.0; END * size],
            whole: vec![0.0; (size + rings) * size],
            ends: vec![0.0; (size + rings) * END],
            factor: vec![0.0; inner * inner],
            coupling: vec![0.0; inner * columns],
            eliminated: vec![0.0; columns * columns],
        }
    }

    /// Linearises the kinematics; `false` where the end pose does not determine the first amplitudes.
    pub(crate) fn linearise(&mut self, configuration: &Configuration, tangent: &ElementDerivatives) -> bool {
        let Some(turn) = configuration.end_theta.left_jacobian_inverse() else { return false };
        let column = |i: usize| tangent.end_position[i];
        let stretch = Matrix3::from_columns(&[column(3), column(4), column(5)]);
        let Some(unstretch) = stretch.try_inverse() else { return false };
        let swing = Matrix3::from_columns(&[column(0), column(1), column(2)]) * turn;
        let lever = crate::geometry::hat(&configuration.end.position);
        let zero = Matrix3::zeros();
        let by_start: Matrix6<f64> = blocks(&zero, &-turn, &-unstretch, &(unstretch * (lever + swing)));
        let by_end: Matrix6<f64> = blocks(&zero, &turn, &unstretch, &(-unstretch * swing));
        for (c, row) in self.first.chunks_exact_mut(self.size).enumerate() {
            for k in 0..START {
                (row[k], row[START + k]) = (by_start[(c, k)], by_end[(c, k)]);
            }
        }
        for i in 0..self.inner {
            let strain = -unstretch * column(END + i);
            for c in 0..3 {
                self.first[(3 + c) * self.size + NODES + i] = strain[c];
            }
        }
        true
    }

    /// Condenses the Hessian with what is `added` to its diagonal, and the coupling `cross` of (start, amplitudes) to the rings'
    /// nodes, one row for each of their displacements; `false` if the inner block is not positive definite.
    pub(crate) fn condense(
        &mut self,
        tangent: &ElementDerivatives,
        added: &Added<'_>,
        cross: &[f64],
    ) -> bool {
        self.transform(&tangent.hessian, added, cross);
        let (inner, size, columns) = (self.inner, self.size, self.columns);
        let (own, rings) = self.whole.split_at(size * size);
        let (nodes, rest) = own.split_at(NODES * size);

        for i in 0..inner {
            for j in 0..=i {
                self.factor[i * inner + j] = rest[j * size + NODES + i];
            }
            let coupled = nodes.chunks_exact(size).chain(rings.chunks_exact(size));
            for (entry, row) in self.coupling[i * columns..][..columns].iter_mut().zip(coupled) {
                *entry = row[NODES + i];
            }
        }
        if !cholesky::factorise(&mut self.factor, inner) {
            return false;
        }

        dense::forward_rows(&self.factor, inner, columns, &mut self.coupling);
        self.eliminated.fill(0.0);
        dense::add_upper(&self.coupling, &self.coupling, columns, &mut self.eliminated);
        true
    }

    /// Expresses the first amplitudes by (start, end, inner).
    fn transform(&mut self, hessian: &[f64], added: &Added<'_>, cross: &[f64]) {
        let size = self.size;
        let sources = hessian.chunks_exact(size).chain(cross.chunks_exact(size));
        let rows = self.whole.chunks_exact_mut(size).zip(self.ends.chunks_exact_mut(END));
        for (number, (source, (row, ends))) in sources.zip(rows).enumerate() {
            row.copy_from_slice(source);
            if let Some(amplitude) = number.checked_sub(START).filter(|_| number < size) {
                row[number] += added.shift * added.metric[amplitude];
                row[number] += if added.held.0 == amplitude { added.held.1 } else { 0.0 };
            }
            ends.copy_from_slice(&row[START..NODES]);
            row[START..NODES].fill(0.0);
        }
        dense::add_product(&self.ends, &self.first, END, size, &mut self.whole);
        // The rows of the first amplitudes make room for those of the end node.
        let (own, _) = self.whole.split_at_mut(size * size);
        let by_first = &mut self.ends[..END * size];
        by_first.copy_from_slice(&own[START * size..NODES * size]);
        own[START * size..NODES * size].fill(0.0);
        dense::add_upper(&self.first, by_first, size, own);
    }

    /// Condensed Hessian of displacements `i` and `j` of the two nodes, in the axes of the start node.
    pub(crate) fn of_nodes(&self, i: usize, j: usize) -> f64 {
        let (i, j) = (i.min(j), i.max(j));
        self.whole[i * self.size + j] - self.eliminated[i * self.columns + j]
    }

    /// Condensed coupling of the two nodes, in the axes of the start node, to one displacement of a ring.
    pub(crate) fn to_ring(&self, ring: usize) -> [f64; NODES] {
        let row = &self.whole[(self.size + ring) * self.size..][..NODES];
        core::array::from_fn(|i| row[i] - self.eliminated[i * self.columns + NODES + ring])
    }

    /// What the elimination takes from the Hessian of displacement `ring` of a ring and those from there on.
    pub(crate) fn of_rings(&self, ring: usize) -> &[f64] {
        &self.eliminated[(NODES + ring) * self.columns..][..self.columns][NODES + ring..]
    }

    /// Eliminates the amplitudes from a right-hand side: returns the part of the two nodes and keeps the rest in `rhs`.
    pub(crate) fn eliminate(&self, rhs: &mut [f64]) -> [f64; NODES] {
        let mut nodes = [0.0; NODES];
        let (ends, inner) = rhs.split_at_mut(END);
        for (value, first) in ends.iter().zip(self.first.chunks_exact(self.size)) {
            let columns = nodes.iter_mut().chain(&mut *inner).zip(first);
            columns.for_each(|(entry, x)| *entry += value * x);
        }
        cholesky::forward(&self.factor, self.inner, inner);
        for (value, row) in inner.iter().zip(self.coupling.chunks_exact(self.columns)) {
            nodes.iter_mut().zip(row).for_each(|(node, x)| *node -= value * x);
        }
        nodes
    }

    /// Subtracts the contribution of the eliminated amplitudes (see [`Self::eliminate`]) from the right-hand side of the
    /// rings' nodes.
    pub(crate) fn eliminate_rings(&self, rhs: &[f64], rings: &mut [f64]) {
        for (value, row) in rhs[END..].iter().zip(self.coupling.chunks_exact(self.columns)) {
            rings.iter_mut().zip(&row[NODES..]).for_each(|(ring, x)| *ring -= value * x);
        }
    }

    /// Subtracts the contribution of the rings' node displacements from the eliminated amplitudes, before these are
    /// recovered.
    pub(crate) fn recover_rings(&self, rings: &[f64], rhs: &mut [f64]) {
        for (entry, row) in rhs[END..].iter_mut().zip(self.coupling.chunks_exact(self.columns)) {
            *entry -= cholesky::dot(&row[NODES..], rings);
        }
    }

    /// Recovers the amplitudes in `rhs` from the displacements of the two nodes.
    pub(crate) fn recover(&self, nodes: &[f64; NODES], rhs: &mut [f64]) {
        let (ends, inner) = rhs.split_at_mut(END);
        for (entry, row) in inner.iter_mut().zip(self.coupling.chunks_exact(self.columns)) {
            *entry -= cholesky::dot(&row[..NODES], nodes);
        }
        cholesky::backward(&self.factor, self.inner, inner);
        for (end, first) in ends.iter_mut().zip(self.first.chunks_exact(self.size)) {
            *end = cholesky::dot(&first[..NODES], nodes) + cholesky::dot(&first[NODES..], inner);
        }
    }
}

/// Rotates the four vectors of two nodes from the axes of a frame to fixed axes (or back, with its transpose).
pub(crate) fn turn_nodes(rotation: &Matrix3<f64>, nodes: &mut [f64; NODES]) {
    for part in nodes.chunks_exact_mut(3) {
        let turned = rotation * Vector3::new(part[0], part[1], part[2]);
        part.copy_from_slice(turned.as_slice());
    }
}

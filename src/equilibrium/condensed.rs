//! Newton's equations of the whole chain, condensed to its nodes.

use nalgebra::{DMatrix, DVectorViewMut, Matrix3};

use super::potential::Potential;
use super::reduction::turn_nodes;
use crate::numerics::cholesky;
use crate::numerics::trust_region::Objective;
use crate::rod::Order;

impl Objective for Potential<'_> {
    fn slope(&mut self, x: &[f64]) -> Option<f64> {
        let energy = self.load(x, Order::Gradient)?;
        self.backward(x, Order::Gradient).then_some(energy)
    }

    fn linearise(&mut self, x: &[f64]) -> Option<f64> {
        self.work.factored = false;
        let energy = self.load(x, Order::Hessian)?;
        let regular = self.backward(x, Order::Hessian);
        // The Hessian is factorised and solved with in the axes in which it was made, wherever the chain moves afterwards.
        for (axes, node) in self.work.axes.iter_mut().zip(&self.work.nodes) {
            *axes = node.rotation;
        }
        self.note_origin(x);
        regular.then_some(energy)
    }

    fn gradient(&self) -> &[f64] {
        &self.work.gradient
    }

    /// Where the forces have no potential, whether the matrix is regular.
    fn factorise(&mut self, shift: f64) -> bool {
        let size = 6 * self.chain.elements.len();
        (self.work.factored, self.work.reference.origin.judged) = (false, false);
        self.work.factor.copy_from_slice(&self.work.node_hessian);
        for k in 0..self.chain.elements.len() {
            if !self.condense(k, shift) {
                return false;
            }
        }
        self.work.lu = None;
        let conservative = self.terms.have_potential();
        if !conservative {
            let matrix = DMatrix::from_row_slice(size, size, &self.work.factor);
            // What is left in `factor` is the symmetric part.
            self.work.factor.copy_from_slice(((&matrix + matrix.transpose()) * 0.5).as_slice());
            self.work.lu = Some(matrix.lu());
        }
        self.work.definite =
            !self.terms.pairs.one_sided() && cholesky::factorise(&mut self.work.factor, size);
        let regular = self.work.lu.as_ref().is_some_and(nalgebra::LU::is_invertible);
        self.work.factored = if conservative { self.work.definite } else { regular };
        self.work.factored
    }

    fn dissipates(&self) -> bool {
        self.work.definite || self.terms.pairs.one_sided()
    }

    fn solve(&mut self, x: &mut [f64]) {
        let spans = self.terms.spans.act();
        let mutual = self.terms.spans.are_mutual();
        let work = &mut *self.work;
        work.rhs.fill(0.0);
        for (k, reduction) in work.reductions.iter().enumerate() {
            let part = &mut x[self.chain.first[k]..self.chain.first[k + 1]];
            let mut nodes = reduction.eliminate(part);
            turn_nodes(&work.axes[k], &mut nodes);
            for (i, value) in nodes.iter().enumerate() {
                if let Some(row) = free(6 * k + i) {
                    work.rhs[row] += value;
                }
            }
            if mutual {
                reduction.eliminate_outer(part, &mut work.rhs);
            }
        }
        match &work.lu {
            Some(lu) => {
                let size = work.rhs.len();
                lu.solve_mut(&mut DVectorViewMut::from_slice(&mut work.rhs, size));
            }
            None => cholesky::solve(&work.factor, work.rhs.len(), &mut work.rhs),
        }
        for (k, reduction) in work.reductions.iter().enumerate() {
            let part = &mut x[self.chain.first[k]..self.chain.first[k + 1]];
            let mut nodes = core::array::from_fn(|i| free(6 * k + i).map_or(0.0, |row| work.rhs[row]));
            turn_nodes(&work.axes[k].transpose(), &mut nodes);
            if spans {
                reduction.recover_outer(&work.rhs, part);
            }
            reduction.recover(&nodes, part);
        }
    }

    fn metric(&self) -> &[f64] {
        &self.chain.metric
    }
}

impl Potential<'_> {
    /// Condenses element `k` and adds it to the matrix of the nodes.
    fn condense(&mut self, k: usize, shift: f64) -> bool {
        let work = &mut *self.work;
        let size = 6 * self.chain.elements.len();
        let reduction = &mut work.reductions[k];
        if !reduction.condense(&work.tangents[k], &self.chain.elements[k].metric, shift) {
            return false;
        }
        let axes = work.axes[k];
        for i in 0..4 {
            for j in 0..4 {
                // The first six rows are the base's where the element starts there.
                let (Some(row), Some(column)) = (free(6 * k + 3 * i), free(6 * k + 3 * j)) else { continue };
                let part = Matrix3::from_fn(|a, b| reduction.condensed[3 * i + a][3 * j + b]);
                let turned = axes * part * axes.transpose();
                for a in 0..3 {
                    for b in 0..3 {
                        work.factor[(row + a) * size + column + b] += turned[(a, b)];
                    }
                }
            }
        }
        if !self.terms.spans.act() {
            return true;
        }
        reduction.condense_outer(&work.cross[k], size);
        let mutual = self.terms.spans.are_mutual();
        for column in 0..size {
            let mut nodes = core::array::from_fn(|i| reduction.condensed_outer[i * size + column]);
            turn_nodes(&axes, &mut nodes);
            for (i, value) in nodes.iter().enumerate() {
                let Some(row) = free(6 * k + i) else { continue };
                work.factor[row * size + column] += value;
                if mutual {
                    work.factor[column * size + row] += value;
                }
            }
            if mutual {
                for row in 0..=column {
                    let value = cholesky::dot(reduction.outer(row), reduction.outer(column));
                    work.factor[row * size + column] -= value;
                    if row != column {
                        work.factor[column * size + row] -= value;
                    }
                }
            }
        }
        true
    }
}

/// The row of a node's displacement in the matrix of the nodes, from which the base is left out.
fn free(row: usize) -> Option<usize> {
    row.checked_sub(6)
}

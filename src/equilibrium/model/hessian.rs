//! The full Hessian with respect to the unknowns, definite or not, for studies of unstable shapes.
//!
//! The solver does not form it: it factorises the matrix condensed to the nodes, see [`super::condensation`].

use nalgebra::{DMatrix, DMatrixView};

use super::potential::Potential;

impl Potential<'_> {
    /// The matrix at the shape linearised last, where all forces are conservative.
    pub(crate) fn hessian(&mut self) -> DMatrix<f64> {
        let (size, rows) = (self.chain.freedoms(), 6 * self.chain.elements.len());
        let motion = self.motion(&DMatrix::identity(size, size));
        let mut nodes = DMatrix::zeros(rows, size);
        for (k, node) in motion.nodes.iter().skip(1).enumerate() {
            nodes.rows_mut(6 * k, 6).copy_from(node);
        }
        // It is stored row by row, and symmetric.
        let mut out = nodes.tr_mul(&(DMatrixView::from_slice(&self.work.node_hessian, rows, rows) * &nodes));
        for (k, moved) in motion.elements.iter().enumerate() {
            let size = moved.nrows();
            out += moved
                .tr_mul(&(DMatrixView::from_slice(&self.work.derivatives[k].hessian, size, size) * moved));
            if self.terms.spans.act() {
                let cross = DMatrixView::from_slice(&self.work.cross[k], size, rows);
                let mixed = moved.tr_mul(&(cross * &nodes));
                out += mixed.transpose() + mixed;
            }
        }
        out
    }
}

//! The elastic norm of a change of shape, in which stability is measured.
//!
//! The eigenvalues of `H x = lambda K x` with this `K` do not depend on the unknowns that describe the shape, unlike those with the
//! stiffness of the straight shape.

use nalgebra::{Cholesky, DMatrix};

use super::chain::Chain;
use crate::numerics::eigenvalue::Weight;
use crate::rod::{Configuration, StrainNorm};

/// `K` at one shape, one block for each element, as no strain depends on the unknowns of another element.
#[derive(Debug, Clone, Default)]
pub(crate) struct ElasticNorm {
    blocks: Vec<StrainNorm>,
    /// First unknown of each element, then the number of unknowns.
    first: Vec<usize>,
}

impl ElasticNorm {
    /// Computes the norm at the shape of these `configurations`, in the storage of the last one.
    pub(crate) fn update(&mut self, chain: &Chain, configurations: &[Configuration]) {
        self.first.clone_from(&chain.first);
        self.blocks.resize_with(chain.elements.len(), StrainNorm::default);
        for ((block, element), configuration) in
            self.blocks.iter_mut().zip(&chain.elements).zip(configurations)
        {
            block.update(configuration, element);
        }
    }

    /// Smallest eigenvalue of `H x = lambda K x` for the whole Hessian, definite or not; NaN where it is not finite.
    pub(crate) fn smallest(&self, hessian: &DMatrix<f64>) -> f64 {
        let Some(factor) = Cholesky::new(self.to_dense()) else { return f64::NAN };
        let lower = factor.l();
        let Some(half) = lower.solve_lower_triangular(hessian) else { return f64::NAN };
        let Some(scaled) = lower.solve_lower_triangular(&half.transpose()) else { return f64::NAN };

        if scaled.iter().all(|entry| entry.is_finite()) {
            scaled.symmetric_eigenvalues().min()
        } else {
            f64::NAN
        }
    }

    pub(crate) fn to_dense(&self) -> DMatrix<f64> {
        let size = self.first.last().copied().unwrap_or(0);
        let mut out = DMatrix::zeros(size, size);
        for (block, first) in self.blocks.iter().zip(&self.first) {
            block.add_to(&mut out, *first);
        }
        out
    }
}

impl Weight for ElasticNorm {
    fn apply(&self, x: &[f64], out: &mut [f64]) {
        for (block, range) in self.blocks.iter().zip(self.first.windows(2)) {
            block.apply(&x[range[0]..range[1]], &mut out[range[0]..range[1]]);
        }
    }
}

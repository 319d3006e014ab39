//! Elastic norm of a variation of the strains at a deformed element.
//!
//! The variations `du` of the curvature and `dv` of the stretch at the present shape, weighted by the section stiffness,
//!
//! ```text
//! x^T K x = integral of du^T K_bt du + dv^T K_se dv
//! ```
//!
//! measure a change of shape whatever coordinates describe it. `K` is the elastic Hessian without the part that comes
//! from the curvature of the coordinates.

use nalgebra::DMatrix;

use super::bending::CurvatureDerivatives;
use super::curvature_stiffness::curvature_stiffness;
use super::element::Element;
use super::kinematics::Configuration;
use super::row::ROTATIONS;
use crate::numerics::dense;

/// `K` with respect to the amplitudes of one element, J per squared unit of the amplitudes.
#[derive(Debug, Clone, Default)]
pub struct StrainNorm {
    /// The amplitudes of the curvature, which couple with one another alone.
    bent: Vec<usize>,
    /// Their entries, row by row.
    block: Vec<f64>,
    /// Diagonal entries of the other amplitudes, and 0 of these.
    diagonal: Vec<f64>,
    /// Working storage: three rows of derivatives and three of their products with the stiffness.
    rows: Vec<f64>,
}

impl StrainNorm {
    /// Computes the norm at a deformed element.
    pub fn update(&mut self, configuration: &Configuration, element: &Element) {
        let Self { bent, block, diagonal, rows } = self;
        let components = element.component.iter().enumerate();
        bent.clear();
        bent.extend(components.filter(|(_, c)| **c < ROTATIONS).map(|(i, _)| i));
        let count = bent.len();
        block.clear();
        block.resize(count * count, 0.0);

        for (state, station) in configuration.stations.iter().zip(&element.stations) {
            let weight = station.weight / configuration.growth;
            let stiffness = curvature_stiffness(&station.stiffness.lined(state.lining), weight);
            let CurvatureDerivatives { by_vector, by_rate } = CurvatureDerivatives::of(state);
            rows.clear();
            rows.resize(2 * ROTATIONS * count, 0.0);
            let (variations, moments) = rows.split_at_mut(ROTATIONS * count);

            for (place, i) in bent.iter().enumerate() {
                let (c, phi, psi) = (element.component[*i], station.row.integral[*i], station.row.rate[*i]);
                for k in 0..ROTATIONS {
                    let variation = by_vector[(k, c)] * phi + by_rate[(k, c)] * psi;
                    variations[k * count + place] = variation;
                    moments[k * count + place] = stiffness[k] * variation;
                }
            }
            dense::add_upper(variations, moments, count, block);
        }
        for i in 0..count {
            for j in i + 1..count {
                block[j * count + i] = block[i * count + j];
            }
        }

        // Shear and extension are linear in their amplitudes, and the modes are orthogonal.
        diagonal.clear();
        diagonal.extend(element.metric.iter().map(|k| k / configuration.growth));
        for i in bent.iter() {
            diagonal[*i] = 0.0;
        }
    }

    /// Writes `K x` to `out`.
    pub fn apply(&self, x: &[f64], out: &mut [f64]) {
        out.iter_mut().zip(&self.diagonal).zip(x).for_each(|((entry, k), x)| *entry = k * x);
        if self.bent.is_empty() {
            return;
        }
        for (i, row) in self.bent.iter().zip(self.block.chunks_exact(self.bent.len())) {
            out[*i] = row.iter().zip(&self.bent).map(|(k, j)| k * x[*j]).sum();
        }
    }

    /// Adds the entries to a matrix, from the first amplitude at row and column `first`.
    pub fn add_to(&self, matrix: &mut DMatrix<f64>, first: usize) {
        for (i, k) in self.diagonal.iter().enumerate() {
            matrix[(first + i, first + i)] += k;
        }
        for (number, entry) in self.block.iter().enumerate() {
            let (row, column) = (number / self.bent.len(), number % self.bent.len());
            matrix[(first + self.bent[row], first + self.bent[column])] += entry;
        }
    }
}

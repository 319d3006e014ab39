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

use super::bending::{CurvatureDerivatives, curvature_stiffness};
use super::element::Element;
use super::kinematics::Configuration;
use super::row::ROTATIONS;
use crate::numerics::dense;

impl Configuration {
    /// Writes `K` with respect to the amplitudes of `element` to `norm`: J per squared unit of the amplitudes, row by row,
    /// square in [`Element::freedoms`].
    ///
    /// `rows` is working storage for three rows of derivatives and three of their products with the stiffness.
    pub fn strain_norm(&self, element: &Element, rows: &mut Vec<f64>, norm: &mut [f64]) {
        let freedoms = element.freedoms();
        norm.fill(0.0);

        for (state, station) in self.stations.iter().zip(&element.stations) {
            let stiffness =
                curvature_stiffness(&station.stiffness.lined(state.lining), station.weight / self.growth);
            let CurvatureDerivatives { by_vector, by_rate } = CurvatureDerivatives::of(state);
            rows.clear();
            rows.resize(2 * ROTATIONS * freedoms, 0.0);
            let (variations, moments) = rows.split_at_mut(ROTATIONS * freedoms);

            let modes = station.row.integral.iter().zip(&station.row.rate);
            for ((i, c), (phi, psi)) in element.component.iter().enumerate().zip(modes) {
                if *c >= ROTATIONS {
                    continue;
                }
                for k in 0..ROTATIONS {
                    let variation = by_vector[(k, *c)] * phi + by_rate[(k, *c)] * psi;
                    variations[k * freedoms + i] = variation;
                    moments[k * freedoms + i] = stiffness[k] * variation;
                }
            }
            dense::add_upper(variations, moments, freedoms, norm);
        }

        // Shear and extension are linear in their amplitudes, and the modes are orthogonal.
        for (i, _) in element.component.iter().enumerate().filter(|(_, c)| **c >= ROTATIONS) {
            norm[i * freedoms + i] = element.metric[i] / self.growth;
        }
        for i in 0..freedoms {
            for j in i + 1..freedoms {
                norm[j * freedoms + i] = norm[i * freedoms + j];
            }
        }
    }
}

//! Strain modes of an element: the stress resultant is a polynomial in arc length, the strain that polynomial
//! times the local compliance.
//!
//! One element spans a whole segment, stiff discs and soft core alike. Legendre polynomials generalised to the
//! compliance as weight make the modes orthogonal in the elastic energy, and all but the first leave the
//! element's ends where they are.

use crate::numerics::quadrature::gauss_legendre;

/// A piecewise constant compliance along an element.
#[derive(Debug, Clone)]
pub(super) struct Compliance {
    /// Length (m) and compliance of each piece.
    pub(super) pieces: Vec<(f64, f64)>,
}

/// Orthogonal modes `psi_j(s) = compliance(s) pi_j(s) / integral of the compliance`.
///
/// `pi_0 = 1`, so the integral of `psi_0` is one and that of every other mode zero.
#[derive(Debug, Clone)]
pub(super) struct Modes {
    compliance: Compliance,
    total: f64,
    length: f64,
    /// `pi_{j+1} = (x - shift_j) pi_j - ratio_j pi_{j-1}` in `x = 2 s / length - 1`, then scaled by `scale_j`.
    shift: Vec<f64>,
    ratio: Vec<f64>,
    scale: Vec<f64>,
    /// Stiffness of each mode: the integral of `psi_j^2 / compliance`.
    pub(super) stiffness: Vec<f64>,
}

impl Modes {
    /// The first `count` modes (Stieltjes' procedure with exact quadrature).
    pub(super) fn new(compliance: Compliance, count: usize) -> Self {
        let length: f64 = compliance.pieces.iter().map(|(piece, _)| piece).sum();
        let (nodes, weights) = gauss_legendre(count + 1);
        let mut points = Vec::new();
        let mut start = 0.0;
        for &(piece, value) in &compliance.pieces {
            for (node, weight) in nodes.iter().zip(&weights) {
                let s = start + 0.5 * piece * (1.0 + node);
                points.push((2.0 * s / length - 1.0, 0.5 * piece * weight * value));
            }
            start += piece;
        }
        let total: f64 = points.iter().map(|(_, weight)| weight).sum();
        let (mut shift, mut ratio, mut norms) = (Vec::new(), Vec::new(), Vec::new());
        let mut previous = vec![0.0; points.len()];
        let mut current = vec![1.0; points.len()];
        for j in 0..count {
            let norm: f64 = points.iter().zip(&current).map(|((_, w), p)| w * p * p).sum();
            let mean: f64 = points.iter().zip(&current).map(|((x, w), p)| w * x * p * p).sum();
            shift.push(mean / norm);
            ratio.push(if j == 0 { 0.0 } else { norm / norms[j - 1] });
            norms.push(norm);
            for ((x, _), (before, now)) in points.iter().zip(previous.iter_mut().zip(&mut current)) {
                let next = (x - shift[j]) * *now - ratio[j] * *before;
                *before = *now;
                *now = next;
            }
        }
        // Scaled like Legendre polynomials, whose squared norm is 1/(2j+1) of the weight's integral.
        let scale: Vec<f64> =
            norms.iter().enumerate().map(|(j, norm)| (total / ((2 * j + 1) as f64 * norm)).sqrt()).collect();
        let stiffness = (0..count).map(|j| 1.0 / ((2 * j + 1) as f64 * total)).collect();
        Self { compliance, total, length, shift, ratio, scale, stiffness }
    }

    /// Values of all modes at arc length `s` in piece `piece`, 1/m.
    pub(super) fn values(&self, piece: usize, s: f64) -> Vec<f64> {
        let x = 2.0 * s / self.length - 1.0;
        let factor = self.compliance.pieces[piece].1 / self.total;
        let (mut before, mut now) = (0.0, 1.0);
        (0..self.scale.len())
            .map(|j| {
                let value = factor * self.scale[j] * now;
                (before, now) = (now, (x - self.shift[j]) * now - self.ratio[j] * before);
                value
            })
            .collect()
    }

    /// Integrals of all modes from 0 to `s` in piece `piece`.
    pub(super) fn integrals(&self, piece: usize, s: f64) -> Vec<f64> {
        let (nodes, weights) = gauss_legendre(self.scale.len() + 1);
        let mut sum = vec![0.0; self.scale.len()];
        let mut start = 0.0;
        for (index, &(length, _)) in self.compliance.pieces.iter().enumerate().take(piece + 1) {
            let reach = if index == piece { s - start } else { length };
            for (node, weight) in nodes.iter().zip(&weights) {
                let values = self.values(index, start + 0.5 * reach * (1.0 + node));
                for (total, value) in sum.iter_mut().zip(values) {
                    *total += 0.5 * reach * weight * value;
                }
            }
            start += length;
        }
        sum
    }
}

//! Fine quadrature rule that resolves the windings of a spiral.

use crate::numerics::{lagrange, quadrature::gauss_legendre};

/// Number of points that resolve the windings of the spiral.
const SPIRAL_POINTS: usize = 48;

/// A point of the fine rule on `[-1, 1]`, its weight, and the Lagrange polynomials of the nodes there.
pub(super) type Fine = (f64, f64, Vec<f64>);

/// All points of the fine rule.
pub(super) fn fine_points(nodes: &[f64]) -> impl Iterator<Item = Fine> {
    let (points, weights) = gauss_legendre(SPIRAL_POINTS);
    points.into_iter().zip(weights).map(|(x, weight)| (x, weight, lagrange::values(nodes, x)))
}

//! The rule that resolves the turns of a spiral.

use crate::numerics::{lagrange, quadrature::gauss_legendre};

/// Points that resolve the turns of the spiral when it is integrated.
const SPIRAL_POINTS: usize = 48;

/// A point of the rule that resolves the spiral, on `[-1, 1]`, its weight, and the Lagrange polynomials of the nodes there.
pub(super) type Fine = (f64, f64, Vec<f64>);

/// All points of that rule.
pub(super) fn fine_points(nodes: &[f64]) -> impl Iterator<Item = Fine> {
    let (points, weights) = gauss_legendre(SPIRAL_POINTS);
    points.into_iter().zip(weights).map(|(x, weight)| (x, weight, lagrange::values(nodes, x)))
}

//! Lagrange polynomials through given nodes.

use super::quadrature::gauss_legendre;

/// Values at `x` of the Lagrange polynomials through `nodes` (distinct).
#[must_use]
pub fn values(nodes: &[f64], x: f64) -> Vec<f64> {
    nodes
        .iter()
        .enumerate()
        .map(|(i, own)| {
            nodes
                .iter()
                .enumerate()
                .filter(|(j, _)| *j != i)
                .map(|(_, other)| (x - other) / (own - other))
                .product()
        })
        .collect()
}

/// Integrals of the Lagrange polynomials through `nodes` from `-1` to `x`.
///
/// ```
/// use mcm::numerics::{lagrange, quadrature::gauss_legendre};
/// let (nodes, weights) = gauss_legendre(4);
/// for (integral, weight) in lagrange::integrals(&nodes, 1.0).iter().zip(&weights) {
///     assert!((integral - weight).abs() < 1e-15);
/// }
/// ```
#[must_use]
pub fn integrals(nodes: &[f64], x: f64) -> Vec<f64> {
    let (points, weights) = gauss_legendre(nodes.len().div_ceil(2).max(1));
    let mut sum = vec![0.0; nodes.len()];
    for (point, weight) in points.iter().zip(&weights) {
        let at = -1.0 + 0.5 * (x + 1.0) * (1.0 + point);
        for (total, value) in sum.iter_mut().zip(values(nodes, at)) {
            *total += 0.5 * (x + 1.0) * weight * value;
        }
    }
    sum
}

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

/// Derivatives at `x` of the Lagrange polynomials through `nodes` (distinct).
///
/// ```
/// use mcm::numerics::lagrange;
/// // The parabola through (-1, 1), (0, 0), (2, 4) is x^2.
/// let slopes = lagrange::slopes(&[-1.0, 0.0, 2.0], 1.5);
/// assert!((slopes[0] + 4.0 * slopes[2] - 3.0).abs() < 1e-14);
/// ```
#[must_use]
pub fn slopes(nodes: &[f64], x: f64) -> Vec<f64> {
    let others = |i: usize| nodes.iter().enumerate().filter(move |(j, _)| *j != i);
    let slope = |(i, own): (usize, &f64)| -> f64 {
        others(i)
            .map(|(m, first)| {
                let rest = others(i).filter(|(j, _)| *j != m);
                rest.map(|(_, other)| (x - other) / (own - other)).product::<f64>() / (own - first)
            })
            .sum()
    };
    nodes.iter().enumerate().map(slope).collect()
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

//! Lagrange polynomials and their integrals.

use mcm::numerics::lagrange::{integrals, values};
use mcm::numerics::quadrature::gauss_legendre;

use crate::tolerance::IDENTITY;

#[test]
fn lagrange_polynomials_reproduce_every_polynomial_of_their_degree() {
    for count in 1..=12 {
        let (nodes, _) = gauss_legendre(count);
        for degree in 0..count as i32 {
            for x in [-1.0, -0.3, 0.0, 0.77, 1.0] {
                let sum: f64 = values(&nodes, x).iter().zip(&nodes).map(|(l, n)| l * n.powi(degree)).sum();
                assert!((sum - x.powi(degree)).abs() <= IDENTITY, "{count} nodes, x^{degree} at {x}: {sum}");
                let sum: f64 = integrals(&nodes, x).iter().zip(&nodes).map(|(l, n)| l * n.powi(degree)).sum();
                let exact = (x.powi(degree + 1) - (-1.0_f64).powi(degree + 1)) / f64::from(degree + 1);
                assert!(
                    (sum - exact).abs() <= IDENTITY,
                    "{count} nodes, integral of x^{degree} to {x}: {sum}"
                );
            }
        }
    }
}

#[test]
fn a_lagrange_polynomial_is_one_at_its_node_and_zero_at_the_others() {
    let (nodes, _) = gauss_legendre(7);
    for (i, node) in nodes.iter().enumerate() {
        for (j, value) in values(&nodes, *node).iter().enumerate() {
            let expected = if i == j { 1.0 } else { 0.0 };
            assert!((value - expected).abs() <= IDENTITY, "polynomial {j} at node {i}: {value}");
        }
    }
}

//! Gauss-Legendre quadrature.

use core::f64::consts::PI;
use std::sync::OnceLock;

/// Number of points up to which rules are kept once they have been computed.
const KEPT: usize = 64;

/// Nodes and weights of the Gauss-Legendre rule with `points` points on `[-1, 1]`, nodes ascending.
///
/// ```text
/// sum_i w_i f(x_i) = integral of f over [-1, 1]      for polynomials f of degree <= 2 points - 1
/// ```
///
/// The nodes are the zeros of the Legendre polynomial `P_n`, found by Newton's method from
/// `cos(pi (i + 3/4) / (n + 1/2))`; the weights are `2 / ((1 - x^2) P_n'(x)^2)`. Both are good to a few
/// rounding errors up to some hundred points. `points = 0` gives an empty rule.
///
/// ```
/// use mcm::numerics::quadrature::gauss_legendre;
/// let (nodes, weights) = gauss_legendre(3);
/// let integral: f64 = nodes.iter().zip(&weights).map(|(x, w)| w * x.powi(4)).sum();
/// assert!((integral - 0.4).abs() < 1e-15);
/// ```
///
/// Source: Abramowitz and Stegun, Handbook of Mathematical Functions, 25.4.29 and 22.16.6.
#[must_use]
pub fn gauss_legendre(points: usize) -> (Vec<f64>, Vec<f64>) {
    // Without heap, which would be lost where a host unloads the library.
    static RULES: [OnceLock<[[f64; KEPT]; 2]>; KEPT + 1] = [const { OnceLock::new() }; KEPT + 1];
    if let Some(kept) = RULES.get(points) {
        let [nodes, weights] = kept.get_or_init(|| {
            let [mut nodes, mut weights] = [[0.0; KEPT]; 2];
            compute(&mut nodes[..points], &mut weights[..points]);
            [nodes, weights]
        });
        return (nodes[..points].to_vec(), weights[..points].to_vec());
    }
    let [mut nodes, mut weights] = [vec![0.0; points], vec![0.0; points]];
    compute(&mut nodes, &mut weights);
    (nodes, weights)
}

/// Computes the rule with as many points as there are nodes and weights.
fn compute(nodes: &mut [f64], weights: &mut [f64]) {
    let points = nodes.len();
    for i in 0..points.div_ceil(2) {
        let centre = 2 * i + 1 == points;
        let guess = (PI * (i as f64 + 0.75) / (points as f64 + 0.5)).cos();
        let (x, slope) = legendre_zero(points, if centre { 0.0 } else { guess });
        let weight = 2.0 / ((1.0 - x * x) * slope * slope);
        nodes[i] = -x;
        weights[i] = weight;
        nodes[points - 1 - i] = x;
        weights[points - 1 - i] = weight;
    }
}

/// The zero of `P_n` closest to `guess`, and the slope of `P_n` there.
fn legendre_zero(n: usize, guess: f64) -> (f64, f64) {
    let mut x = guess;
    let mut slope = legendre(n, x).1;
    for _ in 0..20 {
        let (value, _) = legendre(n, x);
        let step = value / slope;
        x -= step;
        slope = legendre(n, x).1;
        if step.abs() <= 4.0 * f64::EPSILON {
            break;
        }
    }
    (x, slope)
}

/// `P_n` and its derivative at `x`, `|x| < 1`, by the three-term recurrence.
fn legendre(n: usize, x: f64) -> (f64, f64) {
    let (mut previous, mut value) = (0.0, 1.0);
    for k in 0..n {
        let k = k as f64;
        (previous, value) = (value, ((2.0 * k + 1.0) * x * value - k * previous) / (k + 1.0));
    }
    (value, n as f64 * (x * value - previous) / (x * x - 1.0))
}

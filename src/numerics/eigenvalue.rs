//! The smallest eigenvalue of `H x = lambda K x`, for a diagonal `K` and a solver for `H + shift K`.

use nalgebra::{DMatrix, SymmetricEigen};

/// How hard the eigenvalue is looked for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Search {
    /// Lanczos vectors at most.
    pub vectors: usize,
    /// Residual of the eigenvector, relative to its eigenvalue, at which the search ends; the eigenvalue's
    /// error is of second order in it.
    pub settled: f64,
}

/// The smallest `lambda`, and its vector (`x^T K x = 1`) in `vector`, which is also the first guess.
///
/// `solve` replaces its argument by `(H + shift K)^-1` times it and must belong to a positive definite matrix;
/// the method is Lanczos' on `(H + shift K)^-1 K` in the inner product of `K`, with full orthogonalisation
/// (Golub and Van Loan, Matrix Computations, 10.1), which finds the eigenvalues nearest to `-shift` first. A
/// search that ends early answers an upper bound. NaN for a vector or a solver that is not finite.
pub fn smallest(
    metric: &[f64],
    shift: f64,
    vector: &mut [f64],
    search: Search,
    mut solve: impl FnMut(&mut [f64]),
) -> f64 {
    let size = vector.len();
    let inner =
        |a: &[f64], b: &[f64]| -> f64 { metric.iter().zip(a).zip(b).map(|((k, x), y)| k * x * y).sum() };
    let mut basis: Vec<Vec<f64>> = Vec::new();
    let (mut diagonal, mut beside): (Vec<f64>, Vec<f64>) = (Vec::new(), Vec::new());
    let mut next = vector.to_vec();
    loop {
        let norm = inner(&next, &next).sqrt();
        if !(norm.is_finite() && norm > 0.0) {
            return f64::NAN;
        }
        for entry in &mut next {
            *entry /= norm;
        }
        let mut image: Vec<f64> = next.iter().zip(metric).map(|(x, k)| x * k).collect();
        solve(&mut image);
        diagonal.push(inner(&next, &image));
        basis.push(next);
        // Once more against rounding.
        for earlier in basis.iter().chain(&basis) {
            let along = inner(earlier, &image);
            for (entry, e) in image.iter_mut().zip(earlier) {
                *entry -= along * e;
            }
        }
        let (value, weights) = largest(&diagonal, &beside);
        let rest = inner(&image, &image).sqrt();
        let last = weights.last().copied().unwrap_or(0.0).abs();
        // One vector alone is its own guess: it is confirmed by a second.
        let settled = basis.len() > 1 && rest * last <= search.settled * value;
        if settled || basis.len() == search.vectors.min(size) || rest <= f64::EPSILON * value {
            vector.fill(0.0);
            for (weight, direction) in weights.iter().zip(&basis) {
                for (entry, d) in vector.iter_mut().zip(direction) {
                    *entry += weight * d;
                }
            }
            return 1.0 / value - shift;
        }
        beside.push(rest);
        next = image;
    }
}

/// Largest eigenvalue of a symmetric tridiagonal matrix, with its vector.
fn largest(diagonal: &[f64], beside: &[f64]) -> (f64, Vec<f64>) {
    let size = diagonal.len();
    let matrix = DMatrix::from_fn(size, size, |i, j| match i.abs_diff(j) {
        0 => diagonal[i],
        1 => beside[i.min(j)],
        _ => 0.0,
    });
    let eigen = SymmetricEigen::new(matrix);
    let top = eigen.eigenvalues.imax();
    (eigen.eigenvalues[top], eigen.eigenvectors.column(top).iter().copied().collect())
}

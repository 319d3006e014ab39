//! The smallest eigenvalue of `H x = lambda K x`, for a diagonal `K` and a solver for `H + shift K`.

use nalgebra::{DMatrix, SymmetricEigen};

/// Lanczos vectors of one sweep.
const SWEEP: usize = 10;

/// Sweeps, each restarted from the best vector so far.
const SWEEPS: usize = 6;

/// Relative change of `lambda + shift` between sweeps at which the value is taken.
const SETTLED: f64 = 1e-6;

/// The smallest `lambda`, and its vector (`x^T K x = 1`) in `vector`, which is also the first guess.
///
/// `solve` replaces its argument by `(H + shift K)^-1` times it and must belong to a positive definite matrix;
/// the method is Lanczos' on `(H + shift K)^-1 K` in the inner product of `K` (Golub and Van Loan, Matrix
/// Computations, 10.1), which first finds the eigenvalues nearest to `-shift`.
pub fn smallest(metric: &[f64], shift: f64, vector: &mut [f64], mut solve: impl FnMut(&mut [f64])) -> f64 {
    let size = vector.len();
    let inner =
        |a: &[f64], b: &[f64]| -> f64 { metric.iter().zip(a).zip(b).map(|((k, x), y)| k * x * y).sum() };
    let mut value = f64::INFINITY;
    for _ in 0..SWEEPS {
        let mut basis: Vec<Vec<f64>> = Vec::with_capacity(SWEEP);
        let (mut diagonal, mut beside) = (Vec::new(), Vec::new());
        let mut next = vector.to_vec();
        while basis.len() < SWEEP.min(size) {
            let norm = inner(&next, &next).sqrt();
            if basis.is_empty() {
                if norm.is_nan() || norm <= 0.0 {
                    return f64::NAN;
                }
            } else if norm <= 1e-12 * f64::abs(diagonal[0]) {
                break;
            } else {
                beside.push(norm);
            }
            next.iter_mut().for_each(|entry| *entry /= norm);
            let mut image: Vec<f64> = next.iter().zip(metric).map(|(x, k)| x * k).collect();
            solve(&mut image);
            diagonal.push(inner(&next, &image));
            basis.push(next);
            for _ in 0..2 {
                for earlier in &basis {
                    let along = inner(earlier, &image);
                    image.iter_mut().zip(earlier).for_each(|(entry, e)| *entry -= along * e);
                }
            }
            next = image;
        }
        let steps = basis.len();
        let mut projected = DMatrix::zeros(steps, steps);
        for i in 0..steps {
            projected[(i, i)] = diagonal[i];
            if i + 1 < steps {
                projected[(i, i + 1)] = beside[i];
                projected[(i + 1, i)] = beside[i];
            }
        }
        let eigen = SymmetricEigen::new(projected);
        let top = eigen.eigenvalues.imax();
        vector.fill(0.0);
        for (weight, direction) in eigen.eigenvectors.column(top).iter().zip(&basis) {
            vector.iter_mut().zip(direction).for_each(|(entry, d)| *entry += weight * d);
        }
        let shifted = 1.0 / eigen.eigenvalues[top];
        let settled = (shifted - (value + shift)).abs() <= SETTLED * shifted.abs();
        value = shifted - shift;
        if settled || steps == size {
            break;
        }
    }
    value
}

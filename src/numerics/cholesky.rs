//! Cholesky factorisation in place, without allocation: linear solver and test of positive definiteness.

/// Interleaved sums of [`dot`].
const LANES: usize = 4;

/// Factorises a symmetric matrix in place into its lower Cholesky factor.
///
/// `matrix` holds `size` rows of `size` entries; only its lower triangle is read, and overwritten by `L` with
/// `L L^T = matrix`. Returns whether the matrix is positive definite; if not, the content is unusable. Zeros at the beginning of
/// a row stay zero and cost nothing.
///
/// ```
/// use mcm::numerics::cholesky::{factorise, solve};
/// let mut matrix = [4.0, 0.0, 2.0, 3.0];
/// assert!(factorise(&mut matrix, 2));
/// let mut x = [2.0, 5.0];
/// solve(&matrix, 2, &mut x);
/// assert!((4.0 * x[0] + 2.0 * x[1] - 2.0).abs() < 1e-15);
/// ```
#[must_use]
pub fn factorise(matrix: &mut [f64], size: usize) -> bool {
    for j in 0..size {
        let (above, current) = matrix.split_at_mut(j * size);
        let row = &mut current[..=j];
        // In whole groups of [`dot`], so that sums are added in the same order.
        let first = row.iter().position(|entry| *entry != 0.0).unwrap_or(j) / LANES * LANES;
        for k in first..j {
            let other = &above[k * size..=k * size + k];
            let sum = dot(&row[first..k], &other[first..k]);
            row[k] = (row[k] - sum) / other[k];
        }
        let pivot = row[j] - dot(&row[first..j], &row[first..j]);
        if pivot.is_nan() || pivot <= 0.0 {
            return false;
        }
        row[j] = pivot.sqrt();
    }
    true
}

/// Replaces `x` by the solution of `L L^T y = x`.
pub fn solve(factor: &[f64], size: usize, x: &mut [f64]) {
    forward(factor, size, x);
    backward(factor, size, x);
}

/// Replaces `x` by the solution of `L y = x`.
pub fn forward(factor: &[f64], size: usize, x: &mut [f64]) {
    for i in 0..size {
        let row = &factor[i * size..=i * size + i];
        x[i] = (x[i] - dot(&row[..i], &x[..i])) / row[i];
    }
}

/// Replaces `x` by the solution of `L^T y = x`.
pub fn backward(factor: &[f64], size: usize, x: &mut [f64]) {
    for i in (0..size).rev() {
        let row = &factor[i * size..=i * size + i];
        let value = x[i] / row[i];
        x[i] = value;
        for (entry, coefficient) in x[..i].iter_mut().zip(row) {
            *entry -= coefficient * value;
        }
    }
}

/// Inner product, in four interleaved sums so that the compiler can use vector instructions.
#[must_use]
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut sums = [0.0; LANES];
    let (left, right) = (a.chunks_exact(LANES), b.chunks_exact(LANES));
    let rest: f64 = left.remainder().iter().zip(right.remainder()).map(|(x, y)| x * y).sum();
    for (x, y) in left.zip(right) {
        for (sum, (p, q)) in sums.iter_mut().zip(x.iter().zip(y)) {
            *sum += p * q;
        }
    }
    (sums[0] + sums[1]) + (sums[2] + sums[3]) + rest
}

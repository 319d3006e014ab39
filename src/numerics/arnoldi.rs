//! The eigenvalue with the smallest real part of `H x = lambda K x`, where `H` is not symmetric.

use nalgebra::{DMatrix, Schur};

use super::cholesky::dot;
use super::eigenvalue::Weight;

/// Largest number of sweeps of the QR algorithm, per row.
const SWEEPS: usize = 100;

/// Relative sizes below which a subdiagonal entry counts as zero, tried in turn: clusters of nearly defective
/// eigenvalues cannot be separated to machine precision.
const NEGLIGIBLE: [f64; 3] = [1e-13, 1e-11, 1e-9];

/// Relative norm below which an orthogonalised vector consists of rounding errors only.
const ROUNDING: f64 = 1e-13;

/// Smallest real part of the eigenvalues, from at most `vectors` Arnoldi vectors starting with `start`.
///
/// `solve` replaces its argument by `H^-1` times it. The method is Arnoldi's on `H^-1 K` in the inner product of `K`,
/// orthogonalised twice (Golub and Van Loan, Matrix Computations, 10.5). The eigenvalues nearest to zero
/// and those of negative real part lie at the boundary of that operator's spectrum, which is found first; with as many
/// vectors as rows all are found. Returns `None` if a value is not finite or the QR algorithm does not converge.
pub fn smallest_real_part(
    weight: &(impl Weight + ?Sized),
    start: &[f64],
    vectors: usize,
    mut solve: impl FnMut(&mut [f64]),
) -> Option<f64> {
    let most = vectors.min(start.len());
    // The orthonormal vectors, each with its product with `K`.
    let mut basis: Vec<[Vec<f64>; 2]> = Vec::with_capacity(most);
    let mut projected = DMatrix::zeros(most, most);
    let mut next = start.to_vec();
    for column in 0..most {
        let mut product = vec![0.0; next.len()];
        weight.apply(&next, &mut product);
        let norm = dot(&next, &product).sqrt();
        if column > 0 && norm <= ROUNDING * projected.column(column - 1).amax() {
            // The vectors span an invariant subspace: no other eigenvalues can be found from this start vector.
            projected = projected.view((0, 0), (column, column)).into_owned();
            break;
        }
        if !(norm.is_finite() && norm > 0.0) {
            return None;
        }
        if column > 0 {
            projected[(column, column - 1)] = norm;
        }

        next.iter_mut().chain(&mut product).for_each(|entry| *entry /= norm);
        basis.push([next.clone(), product.clone()]);
        next = product;
        solve(&mut next);

        for _ in 0..2 {
            for (row, [vector, product]) in basis.iter().enumerate() {
                let along = dot(product, &next);
                projected[(row, column)] += along;
                next.iter_mut().zip(vector).for_each(|(entry, v)| *entry -= along * v);
            }
        }
    }

    if !projected.iter().all(|entry| entry.is_finite()) {
        return None;
    }
    let rows = projected.nrows();
    let schur = NEGLIGIBLE.iter().find_map(|eps| Schur::try_new(projected.clone(), *eps, SWEEPS * rows))?;
    let eigenvalues = schur.complex_eigenvalues();
    eigenvalues.iter().map(|mu| mu.re / mu.norm_sqr()).filter(|part| part.is_finite()).min_by(f64::total_cmp)
}

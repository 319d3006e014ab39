//! What rows tell of combinations of parameters.

use nalgebra::{DMatrix, DVector};

/// Singular values and right singular vectors (rows), as many as there are parameters.
pub(super) fn spectrum(rates: &DMatrix<f64>) -> (DVector<f64>, DMatrix<f64>) {
    let normal = rates.tr_mul(rates).symmetric_eigen();
    (normal.eigenvalues.map(|value| value.max(0.0).sqrt()), normal.eigenvectors.transpose())
}

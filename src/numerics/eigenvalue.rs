//! The smallest eigenvalue of `H x = lambda K x`, for a diagonal `K` and a solver for `H + shift K`.

use nalgebra::{DMatrix, SMatrix, SymmetricEigen};

/// Number of vectors up to which the tridiagonal matrix needs no heap storage.
const FEW: usize = 8;

/// Limits of the eigenvalue search.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Search {
    /// Largest number of Lanczos vectors.
    pub vectors: usize,
    /// Residual of the eigenvector, relative to its eigenvalue, at which the search ends; the eigenvalue's
    /// error is of second order in it.
    pub settled: f64,
}

/// Inner product of two vectors in a diagonal metric.
#[must_use]
pub fn inner(metric: &[f64], a: &[f64], b: &[f64]) -> f64 {
    metric.iter().zip(a).zip(b).map(|((k, x), y)| k * x * y).sum()
}

/// Lanczos solver with reusable storage, so that later searches do not allocate.
#[derive(Debug, Clone, Default)]
pub struct Lanczos {
    basis: Vec<Vec<f64>>,
    image: Vec<f64>,
    diagonal: Vec<f64>,
    beside: Vec<f64>,
    /// Coordinates of the two leading eigenvectors in the basis.
    weights: [Vec<f64>; 2],
}

impl Lanczos {
    /// The smallest `lambda`; its eigenvector (`x^T K x = 1`) replaces the initial guess in `vector`.
    ///
    /// `solve` replaces its argument by `(H + shift K)^-1` times it, for a positive definite matrix. The method is
    /// Lanczos' on `(H + shift K)^-1 K` in the inner product of `K`, with full orthogonalisation (Golub and Van Loan,
    /// Matrix Computations, 10.1), which finds the eigenvalues nearest to `-shift` first. A search that ends early
    /// returns an upper bound. Returns NaN if the vector or a solution is not finite.
    pub fn smallest(
        &mut self,
        metric: &[f64],
        shift: f64,
        vector: &mut [f64],
        search: Search,
        mut solve: impl FnMut(&mut [f64]),
    ) -> f64 {
        let size = vector.len();
        let inner = |a: &[f64], b: &[f64]| inner(metric, a, b);
        let Self { basis, image, diagonal, beside, weights } = self;
        let most = search.vectors.min(size);
        if basis.len() < most || image.len() != size {
            basis.resize(most, Vec::new());
            for vector in basis.iter_mut() {
                vector.resize(size, 0.0);
            }
            image.resize(size, 0.0);
        }
        image.copy_from_slice(vector);
        diagonal.clear();
        beside.clear();
        loop {
            let count = diagonal.len() + 1;
            let norm = inner(image, image).sqrt();
            if !(norm.is_finite() && norm > 0.0) {
                return f64::NAN;
            }
            if count > 1 {
                beside.push(norm);
            }
            let next = &mut basis[count - 1];
            for ((x, entry), k) in next.iter_mut().zip(image.iter_mut()).zip(metric) {
                *x = *entry / norm;
                *entry = *x * k;
            }
            solve(image);
            diagonal.push(inner(&basis[count - 1], image));
            // Orthogonalised twice against rounding.
            for earlier in basis[..count].iter().chain(&basis[..count]) {
                let along = inner(earlier, image);
                for (entry, e) in image.iter_mut().zip(earlier) {
                    *entry -= along * e;
                }
            }
            let value = largest(diagonal, beside, weights);
            let rest = inner(image, image).sqrt();
            let last = weights[0].last().copied().unwrap_or(0.0).abs();
            // A single vector cannot check the initial guess: a second one must confirm it.
            let settled = count > 1 && rest * last <= search.settled * value;
            if settled || count == most || rest <= f64::EPSILON * value {
                vector.fill(0.0);
                self.add_eigenvector(0, 1.0, vector);
                return 1.0 / value - shift;
            }
        }
    }

    /// Adds to `vector` the approximation that the last search found of the second eigenvector, multiplied by `factor`.
    pub fn add_second(&self, factor: f64, vector: &mut [f64]) {
        self.add_eigenvector(1, factor, vector);
    }

    fn add_eigenvector(&self, number: usize, factor: f64, vector: &mut [f64]) {
        for (weight, direction) in self.weights[number].iter().zip(&self.basis) {
            for (entry, d) in vector.iter_mut().zip(direction) {
                *entry += factor * weight * d;
            }
        }
    }
}

/// Largest eigenvalue of a symmetric tridiagonal matrix, with the eigenvectors of the two largest in `weights`.
fn largest(diagonal: &[f64], beside: &[f64], weights: &mut [Vec<f64>; 2]) -> f64 {
    let size = diagonal.len();
    let entry = |i: usize, j: usize| match i.abs_diff(j) {
        _ if i.max(j) >= size => 0.0,
        0 => diagonal[i],
        1 => beside[i.min(j)],
        _ => 0.0,
    };
    weights.iter_mut().for_each(Vec::clear);
    if size <= FEW {
        // Padding with zeros is harmless: the largest eigenvalue is positive.
        let eigen = SymmetricEigen::new(SMatrix::<f64, FEW, FEW>::from_fn(entry));
        let numbers = leading(eigen.eigenvalues.as_slice());
        for (own, number) in weights.iter_mut().zip(numbers) {
            own.extend(eigen.eigenvectors.column(number).iter().take(size));
        }
        eigen.eigenvalues[numbers[0]]
    } else {
        let eigen = SymmetricEigen::new(DMatrix::from_fn(size, size, entry));
        let numbers = leading(eigen.eigenvalues.as_slice());
        for (own, number) in weights.iter_mut().zip(numbers) {
            own.extend(eigen.eigenvectors.column(number).iter());
        }
        eigen.eigenvalues[numbers[0]]
    }
}

/// Indices of the two largest of at least two values.
fn leading(values: &[f64]) -> [usize; 2] {
    let mut out = if values[0] >= values[1] { [0, 1] } else { [1, 0] };
    for (index, value) in values.iter().enumerate().skip(2) {
        if *value > values[out[0]] {
            out = [index, out[0]];
        } else if *value > values[out[1]] {
            out[1] = index;
        }
    }
    out
}

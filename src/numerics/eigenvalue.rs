//! The smallest eigenvalue of `H x = lambda K x`, for a positive definite `K` and a solver for `H + shift K`.

use nalgebra::allocator::Allocator;
use nalgebra::{DMatrix, DefaultAllocator, Dim, DimDiff, DimSub, SMatrix, SymmetricEigen, U1};

use super::cholesky::dot;

/// Numbers of vectors up to which the tridiagonal matrix needs no heap storage: most searches check a few small ones first.
const FEWEST: usize = 4;
const FEW: usize = 8;

/// A symmetric positive definite matrix `K`, known by its products with vectors.
pub trait Weight {
    /// Writes `K x` to `out`, both of the matrix' size.
    fn apply(&self, x: &[f64], out: &mut [f64]);
}

/// A diagonal matrix by its diagonal.
impl Weight for [f64] {
    fn apply(&self, x: &[f64], out: &mut [f64]) {
        out.iter_mut().zip(self).zip(x).for_each(|((entry, k), x)| *entry = k * x);
    }
}

/// A vector to which all others are made orthogonal in the inner product of `K`, such as a known eigenvector.
#[derive(Debug, Clone)]
pub struct Deflation {
    vector: Vec<f64>,
    weighted: Vec<f64>,
    square: f64,
}

impl Deflation {
    /// For a vector other than zero.
    #[must_use]
    pub fn new(weight: &(impl Weight + ?Sized), vector: Vec<f64>) -> Self {
        let mut weighted = vec![0.0; vector.len()];
        weight.apply(&vector, &mut weighted);
        let square = dot(&vector, &weighted);
        Self { vector, weighted, square }
    }

    /// Removes the part of `x` along the vector.
    pub fn apply(&self, x: &mut [f64]) {
        let along = dot(&self.weighted, x) / self.square;
        x.iter_mut().zip(&self.vector).for_each(|(entry, own)| *entry -= along * own);
    }
}

/// Limits of the eigenvalue search.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Search {
    /// Largest number of Lanczos vectors.
    pub vectors: usize,
    /// Residual of the eigenvector, relative to its eigenvalue, at which the search ends. The eigenvalue's relative error is at most
    /// its square over the relative distance from the second eigenvalue (Parlett, The Symmetric Eigenvalue Problem,
    /// doi:10.1137/1.9781611971163).
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
    /// The products of `K` with the vectors of the basis.
    weighted: Vec<Vec<f64>>,
    /// The next vector before its normalisation, and its product with `K`.
    image: Vec<f64>,
    product: Vec<f64>,
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
        weight: &(impl Weight + ?Sized),
        shift: f64,
        vector: &mut [f64],
        search: Search,
        mut solve: impl FnMut(&mut [f64]),
    ) -> f64 {
        let most = self.begin(vector, search);
        let Self { basis, weighted, image, product, diagonal, beside, weights } = self;

        weight.apply(image, product);
        loop {
            let count = diagonal.len() + 1;
            let norm = dot(image, product).sqrt();
            if !(norm.is_finite() && norm > 0.0) {
                return f64::NAN;
            }
            if count > 1 {
                beside.push(norm);
            }

            // The next vector of the basis, and its image under the operator.
            if basis.len() < count {
                basis.push(vec![0.0; image.len()]);
                weighted.push(vec![0.0; image.len()]);
            }
            let (next, next_weighted) = (&mut basis[count - 1], &mut weighted[count - 1]);
            next.iter_mut().zip(&*image).for_each(|(x, entry)| *x = entry / norm);
            next_weighted.iter_mut().zip(&*product).for_each(|(x, entry)| *x = entry / norm);
            image.copy_from_slice(next_weighted);
            solve(image);
            diagonal.push(dot(next_weighted, image));

            // Orthogonalised twice against rounding.
            for number in (0..count).chain(0..count) {
                let along = dot(&weighted[number], image);
                image.iter_mut().zip(&basis[number]).for_each(|(entry, e)| *entry -= along * e);
            }

            weight.apply(image, product);
            let rest = dot(image, product).sqrt();
            let value = largest(diagonal, beside, weights);
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

    /// Makes room for a search from `vector` and returns its largest number of vectors.
    fn begin(&mut self, vector: &[f64], search: Search) -> usize {
        let size = vector.len();
        let most = search.vectors.min(size);
        // Few searches need more vectors than these.
        let few = most.min(FEW);
        if self.basis.len() < few || self.image.len() != size {
            for vectors in [&mut self.basis, &mut self.weighted] {
                vectors.resize(few, Vec::new());
                for vector in vectors.iter_mut() {
                    vector.resize(size, 0.0);
                }
            }
            self.image.resize(size, 0.0);
            self.product.resize(size, 0.0);
        }

        self.image.copy_from_slice(vector);
        self.diagonal.clear();
        self.beside.clear();
        most
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
    // Padding with zeros is harmless: the largest eigenvalue is positive.
    if size <= FEWEST {
        leading_of(size, &SymmetricEigen::new(SMatrix::<f64, FEWEST, FEWEST>::from_fn(entry)), weights)
    } else if size <= FEW {
        leading_of(size, &SymmetricEigen::new(SMatrix::<f64, FEW, FEW>::from_fn(entry)), weights)
    } else {
        leading_of(size, &SymmetricEigen::new(DMatrix::from_fn(size, size, entry)), weights)
    }
}

/// Largest eigenvalue, with the first `size` entries of the eigenvectors of the two largest in `weights`.
fn leading_of<D: Dim + DimSub<U1>>(
    size: usize,
    eigen: &SymmetricEigen<f64, D>,
    weights: &mut [Vec<f64>; 2],
) -> f64
where
    DefaultAllocator: Allocator<D, D> + Allocator<D> + Allocator<DimDiff<D, U1>>,
{
    let numbers = leading(eigen.eigenvalues.as_slice());
    for (own, number) in weights.iter_mut().zip(numbers) {
        own.extend(eigen.eigenvectors.column(number).iter().take(size));
    }
    eigen.eigenvalues[numbers[0]]
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

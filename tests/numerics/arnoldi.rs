//! The smallest real part of eigenvalues beside all of them by another method.

use mcm::numerics::arnoldi::smallest_real_part;
use nalgebra::{DMatrix, DVector};
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};

use crate::tolerance::{REAL_PART, REAL_PART_OF_FEW};

const SEED: u64 = 11;

/// A random matrix without symmetry, shifted so that about half of them are stable, and a random metric.
fn random(random: &mut StdRng, size: usize) -> (DMatrix<f64>, Vec<f64>) {
    let metric: Vec<f64> = (0..size).map(|_| 10_f64.powf(random.random_range(-3.0..3.0))).collect();
    let shift = random.random_range(0.5..1.5) * (size as f64 / 3.0).sqrt();
    let roots = DVector::from_iterator(size, metric.iter().map(|k| k.sqrt()));
    let plain = DMatrix::from_fn(size, size, |i, j| {
        random.random_range(-1.0..1.0) + if i == j { shift } else { 0.0 }
    });
    (DMatrix::from_fn(size, size, |i, j| roots[i] * plain[(i, j)] * roots[j]), metric)
}

/// All real parts of `H x = lambda K x`, by the QR algorithm on `K^-1 H`.
fn real_parts(matrix: &DMatrix<f64>, metric: &[f64]) -> Vec<f64> {
    let divided = DMatrix::from_fn(matrix.nrows(), matrix.ncols(), |i, j| {
        matrix[(i, j)] / (metric[i] * metric[j]).sqrt()
    });
    divided.complex_eigenvalues().iter().map(|value| value.re).collect()
}

fn found(matrix: &DMatrix<f64>, metric: &[f64], start: &[f64], vectors: usize) -> Option<f64> {
    let lu = matrix.clone().lu();
    smallest_real_part(metric, start, vectors, |x| {
        let solution = lu.solve(&DVector::from_row_slice(x)).expect("a regular matrix");
        x.copy_from_slice(solution.as_slice());
    })
}

#[test]
fn with_as_many_vectors_as_rows_it_is_the_smallest_of_all() {
    let mut rng = StdRng::seed_from_u64(SEED);
    let mut unstable = 0;
    for case in 0..60 {
        let size = rng.random_range(1..=40);
        let (matrix, metric) = random(&mut rng, size);
        let start: Vec<f64> = metric.iter().map(|k| rng.random_range(0.5..1.0) / k.sqrt()).collect();
        let expected = real_parts(&matrix, &metric).into_iter().fold(f64::INFINITY, f64::min);
        let got = found(&matrix, &metric, &start, size).expect("a finite answer");
        let error = (got - expected).abs() / (matrix.nrows() as f64).sqrt();
        assert!(error < REAL_PART, "seed {SEED}, case {case}: {got}, expected {expected}");
        unstable += u32::from(expected < 0.0);
    }
    assert!((10..50).contains(&unstable), "{unstable} of 60 are unstable");
}

/// A chain of stiff springs whose end is turned by a follower force: the eigenvalue near zero is found by few vectors.
#[test]
fn few_vectors_find_the_one_next_to_zero() {
    let size = 120;
    for follower in [-1.2, -0.9, 0.4] {
        let mut matrix = DMatrix::from_fn(size, size, |i, j| {
            let stiffness = 1.0 + i as f64;
            if i == j {
                stiffness
            } else if j == i + 1 {
                0.3
            } else if i == j + 1 {
                -0.3
            } else {
                0.0
            }
        });
        matrix[(0, 0)] += follower;
        let metric = vec![1.0; size];
        let start: Vec<f64> = (0..size).map(|i| 0.5 + (0.618 * (i + 1) as f64).fract()).collect();
        let expected = real_parts(&matrix, &metric).into_iter().fold(f64::INFINITY, f64::min);
        let got = found(&matrix, &metric, &start, 64).expect("a finite answer");
        assert!((got - expected).abs() < REAL_PART_OF_FEW, "{follower}: {got}, expected {expected}");
    }
}

#[test]
fn what_is_not_finite_has_no_answer() {
    assert_eq!(smallest_real_part([1.0, 1.0].as_slice(), &[1.0, 1.0], 2, |x| x.fill(f64::NAN)), None);
    assert_eq!(smallest_real_part([1.0, 1.0].as_slice(), &[0.0, 0.0], 2, |_| ()), None);
    assert_eq!(smallest_real_part([1.0, 1.0].as_slice(), &[f64::INFINITY, 0.0], 2, |_| ()), None);
}

/// Where the matrix is symmetric to rounding or to some noise, the QR algorithm ends, too.
#[test]
fn nearly_symmetric_matrices_have_an_answer() {
    let mut rng = StdRng::seed_from_u64(SEED);
    for case in 0..400 {
        let size = rng.random_range(6..=64);
        let (matrix, _) = random(&mut rng, size);
        let noise = 10_f64.powf(rng.random_range(-16.0..-6.0));
        let skew = DMatrix::from_fn(size, size, |_, _| rng.random_range(-noise..noise));
        let metric = vec![1.0; size];
        let start: Vec<f64> = (0..size).map(|_| rng.random_range(0.5..1.0)).collect();
        let got = found(&((&matrix + matrix.transpose()) * 0.5 + skew), &metric, &start, size);
        assert!(got.is_some(), "seed {SEED}, case {case}: no answer with {size} rows, noise {noise:e}");
    }
}

/// From a start within an invariant space that space is all it can tell; it ends there instead of dividing by zero.
#[test]
fn an_invariant_start_ends_early() {
    let matrix = DMatrix::from_diagonal(&DVector::from_vec(vec![3.0, -1.0, 2.0]));
    let got = found(&matrix, &[1.0; 3], &[1.0, 0.0, 0.0], 3).expect("a finite answer");
    assert!((got - 3.0).abs() < REAL_PART, "{got}");
    let both = found(&matrix, &[1.0; 3], &[1.0, 1.0, 0.0], 3).expect("a finite answer");
    assert!((both + 1.0).abs() < REAL_PART, "{both}");
}

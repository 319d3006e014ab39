//! Cholesky factorisation and smallest eigenvalue, against nalgebra's.

use mcm::numerics::cholesky::{backward, dot, factorise, forward, solve};
use mcm::numerics::eigenvalue::{Lanczos, Search};
use nalgebra::{Cholesky, DMatrix, DVector, SymmetricEigen};

use crate::tolerance::{EIGENVALUE, LAW, assert_close};

/// A fixed number between -1 and 1.
pub(super) fn pseudo(seed: usize, i: usize) -> f64 {
    (12.9898 * (i as f64 + 1.0) + 78.233 * seed as f64).sin()
}

/// A symmetric matrix with the eigenvalues 1 and more, or with the smallest moved to `lowest`.
pub(super) fn symmetric(size: usize, seed: usize, lowest: f64) -> DMatrix<f64> {
    let basis = DMatrix::from_fn(size, size, |i, j| pseudo(seed, i * size + j)).qr().q();
    let values = DVector::from_fn(size, |i, _| if i == 0 { lowest } else { 1.0 + i as f64 });
    let matrix = &basis * DMatrix::from_diagonal(&values) * basis.transpose();
    (&matrix + matrix.transpose()) * 0.5
}

#[test]
fn cholesky_solves_as_nalgebra_does() {
    for size in [1, 2, 3, 4, 5, 8, 13, 30, 54] {
        let matrix = symmetric(size, size, 0.1);
        let expected = Cholesky::new(matrix.clone()).expect("positive definite");
        let mut factor = matrix.as_slice().to_vec();
        assert!(factorise(&mut factor, size), "size {size}");
        let lower: Vec<f64> =
            (0..size).flat_map(|i| (0..=i).map(move |j| (i, j))).map(|(i, j)| factor[i * size + j]).collect();
        let l = expected.l();
        let right: Vec<f64> =
            (0..size).flat_map(|i| (0..=i).map(move |j| (i, j))).map(|(i, j)| l[(i, j)]).collect();
        assert_close(("factor", size), &lower, &right, LAW);
        let rhs = DVector::from_fn(size, |i, _| pseudo(7, i));
        let mut x = rhs.as_slice().to_vec();
        solve(&factor, size, &mut x);
        assert_close(("solution", size), &x, expected.solve(&rhs).as_slice(), LAW);
        let mut halves = rhs.as_slice().to_vec();
        forward(&factor, size, &mut halves);
        backward(&factor, size, &mut halves);
        assert_close(("halves", size), &halves, &x, LAW);
        let (a, b): (Vec<f64>, Vec<f64>) = (0..size).map(|i| (pseudo(1, i), pseudo(2, i))).unzip();
        let sum: f64 = a.iter().zip(&b).map(|(x, y)| x * y).sum();
        assert!((dot(&a, &b) - sum).abs() <= 1e-14, "dot, size {size}");
    }
}

#[test]
fn cholesky_refuses_what_is_not_positive_definite() {
    for size in [1, 2, 5, 17] {
        for lowest in [-1e-6, -1.0, f64::NAN] {
            let mut matrix = symmetric(size, 3, lowest).as_slice().to_vec();
            assert!(!factorise(&mut matrix, size), "size {size}, eigenvalue {lowest}");
        }
    }
}

#[test]
fn smallest_eigenvalue_is_the_dense_ones() {
    for size in [1, 2, 6, 24, 60] {
        for lowest in [0.5, 1e-3, -0.3] {
            // H x = lambda K x with a K of widely different sizes, as of rotations and strains.
            let metric: Vec<f64> = (0..size).map(|i| 10.0_f64.powi(i as i32 % 7 - 3)).collect();
            let scaled = symmetric(size, 5, lowest);
            let matrix = DMatrix::from_fn(size, size, |i, j| scaled[(i, j)] * (metric[i] * metric[j]).sqrt());
            let shift = 0.4;
            let shifted = &matrix + DMatrix::from_diagonal(&DVector::from_vec(metric.clone())) * shift;
            let factor = Cholesky::new(shifted).expect("positive definite");
            let expected = SymmetricEigen::new(scaled).eigenvalues.min();
            let mut vector: Vec<f64> =
                metric.iter().enumerate().map(|(i, k)| (1.5 + pseudo(9, i)) / k.sqrt()).collect();
            let search = Search { vectors: 60, settled: 1e-7 };
            let found = Lanczos::default().smallest(metric.as_slice(), shift, &mut vector, search, |x| {
                let solution = factor.solve(&DVector::from_row_slice(x));
                x.copy_from_slice(solution.as_slice());
            });
            assert!((found - expected).abs() <= EIGENVALUE, "size {size}: got {found}, expected {expected}");
            // The vector belongs to it: H x = lambda K x, x K x = 1.
            let x = DVector::from_vec(vector.clone());
            let kx = DVector::from_fn(size, |i, _| metric[i] * vector[i]);
            let rest =
                (&matrix * &x - &kx * found).component_div(&DVector::from_fn(size, |i, _| metric[i].sqrt()));
            assert!(rest.norm() <= 1e-4 && (x.dot(&kx) - 1.0).abs() <= LAW, "size {size}: {}", rest.norm());
        }
    }
}

#[test]
fn the_next_search_knows_the_second_softest_direction() {
    let (size, split) = (30, 1.2);
    let own = SymmetricEigen::new(symmetric(size, 2, 0.5));
    let vector = |number: usize| own.eigenvectors.column(number).into_owned();
    let mut order: Vec<usize> = (0..size).collect();
    order.sort_by(|a, b| own.eigenvalues[*a].total_cmp(&own.eigenvalues[*b]));
    // Two soft modes, the others a hundred times as stiff; then they change places.
    let matrix = |first: f64, second: f64| {
        let values = order.iter().enumerate().map(|(rank, _)| match rank {
            0 => first,
            1 => second,
            _ => 100.0,
        });
        let modes = order.iter().zip(values);
        modes.fold(DMatrix::zeros(size, size), |sum, (number, value)| {
            sum + vector(*number) * vector(*number).transpose() * value
        })
    };
    let metric = vec![1.0; size];
    let mut lanczos = Lanczos::default();
    let mut search = |matrix: DMatrix<f64>, guess: &mut [f64], vectors: usize| {
        let factor = Cholesky::new(matrix).expect("positive definite");
        let found = lanczos.smallest(metric.as_slice(), 0.0, guess, Search { vectors, settled: 1e-9 }, |x| {
            x.copy_from_slice(factor.solve(&DVector::from_row_slice(x)).as_slice());
        });
        let mut second = vec![0.0; size];
        lanczos.add_second(1.0, &mut second);
        (found, second)
    };
    let mut guess: Vec<f64> = (0..size).map(|i| 1.5 + pseudo(4, i)).collect();
    let (found, second) = search(matrix(1.0, split), &mut guess, 10);
    assert!((found - 1.0).abs() <= EIGENVALUE, "{found}");
    let along = DVector::from_row_slice(&second).dot(&vector(order[1])).abs();
    assert!((along - 1.0).abs() <= EIGENVALUE, "{along} of the second mode");
    guess.iter_mut().zip(&second).for_each(|(entry, s)| *entry += 0.5 * s);
    let (found, _) = search(matrix(split, 1.0), &mut guess, 3);
    assert!((found - 1.0).abs() <= EIGENVALUE, "after the modes have changed places: {found}");
}

#[test]
fn an_early_end_of_the_search_is_an_upper_bound() {
    let size = 30;
    let matrix = symmetric(size, 2, 0.05);
    let factor = Cholesky::new(matrix).expect("positive definite");
    let metric = vec![1.0; size];
    for vectors in 1..6 {
        let mut vector: Vec<f64> = (0..size).map(|i| 1.5 + pseudo(4, i)).collect();
        let found = Lanczos::default().smallest(
            metric.as_slice(),
            0.0,
            &mut vector,
            Search { vectors, settled: 1e-12 },
            |x| {
                let solution = factor.solve(&DVector::from_row_slice(x));
                x.copy_from_slice(solution.as_slice());
            },
        );
        assert!(found >= 0.05 * (1.0 - LAW), "{vectors} vectors: {found}");
    }
    let mut broken = vec![f64::NAN; size];
    assert!(
        Lanczos::default()
            .smallest(metric.as_slice(), 0.0, &mut broken, Search { vectors: 5, settled: 0.1 }, |_| {})
            .is_nan()
    );
}

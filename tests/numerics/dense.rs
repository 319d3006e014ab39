//! Products of small dense matrices, against nalgebra's.

use mcm::numerics::{cholesky, dense};
use nalgebra::DMatrix;

use super::linear::{pseudo, symmetric};
use crate::instructions::with_instructions;
use crate::tolerance::{LAW, assert_close};

/// Sizes below, at and beyond those of the blocks.
const SIZES: [usize; 9] = [0, 1, 2, 3, 7, 8, 11, 40, 66];

/// A matrix of fixed numbers between -1 and 1.
fn matrix(rows: usize, columns: usize, seed: usize) -> DMatrix<f64> {
    DMatrix::from_fn(rows, columns, |i, j| pseudo(seed, i * columns + j))
}

/// Its entries row by row.
fn by_rows(matrix: &DMatrix<f64>) -> Vec<f64> {
    matrix.transpose().as_slice().to_vec()
}

#[test]
fn products_are_those_of_nalgebra() {
    for (rows, columns) in SIZES.into_iter().flat_map(|rows| SIZES.map(|columns| (rows, columns))) {
        for inner in [0, 1, 6, 13] {
            let (left, right, before) =
                (matrix(rows, inner, 1), matrix(inner, columns, 2), matrix(rows, columns, 3));
            let mut out = by_rows(&before);
            dense::add_product(&by_rows(&left), &by_rows(&right), inner, columns, &mut out);
            assert_close((rows, inner, columns), &out, &by_rows(&(before + left * right)), LAW);
        }
    }
}

#[test]
fn upper_triangles_are_those_of_nalgebra() {
    for (size, inner) in SIZES.into_iter().flat_map(|size| [0, 1, 6, 13].map(|inner| (size, inner))) {
        let (left, right, before) = (matrix(inner, size, 1), matrix(inner, size, 2), matrix(size, size, 3));
        let mut out = by_rows(&before);
        dense::add_upper(&by_rows(&left), &by_rows(&right), size, &mut out);
        let expected = by_rows(&(before + left.transpose() * right));
        for row in 0..size {
            let upper = row * size + row..(row + 1) * size;
            assert_close((size, inner, row), &out[upper.clone()], &expected[upper], LAW);
        }
    }
}

#[test]
fn rows_are_solved_as_each_column_alone() {
    for (size, columns) in [1, 2, 13, 52].into_iter().flat_map(|size| SIZES.map(|columns| (size, columns))) {
        let mut factor = by_rows(&symmetric(size, size, 0.1));
        assert!(cholesky::factorise(&mut factor, size), "size {size}");
        let right = matrix(size, columns, 4);
        let mut x = by_rows(&right);
        dense::forward_rows(&factor, size, columns, &mut x);
        let solved = DMatrix::from_row_slice(size, columns, &x);
        for (number, column) in right.column_iter().enumerate() {
            let mut alone = column.as_slice().to_vec();
            cholesky::forward(&factor, size, &mut alone);
            assert_close((size, columns, number), solved.column(number).as_slice(), &alone, LAW);
        }
    }
}

#[test]
fn every_processor_gives_the_same_bits() {
    let all = |portable| {
        with_instructions(portable, || {
            let (left, right) = (by_rows(&matrix(66, 13, 1)), by_rows(&matrix(13, 66, 2)));
            let mut out = vec![0.0; 66 * 66];
            dense::add_product(&left, &right, 13, 66, &mut out);
            dense::add_upper(&right, &right, 66, &mut out);
            let mut factor = by_rows(&symmetric(66, 5, 0.1));
            assert!(cholesky::factorise(&mut factor, 66));
            dense::forward_rows(&factor, 66, 66, &mut out);
            out.iter().map(|entry| entry.to_bits()).collect::<Vec<_>>()
        })
    };
    assert_eq!(all(true), all(false));
}

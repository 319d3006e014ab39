//! Products of small dense matrices, row by row, by the widest vectors of the processor; no allocation.
//!
//! No product is fused with a sum and the order of the sums is fixed, so that all processors give the same bits.

#![expect(clippy::inline_always, reason = "these functions are compiled for several processors")]

use super::processor::for_each_processor;

/// Rows and columns of the blocks whose sums stay in registers.
const ROWS: usize = 3;
const COLUMNS: usize = 8;

/// Columns of such a block with one row.
const WIDE: usize = 32;

for_each_processor! {
    /// Adds the product of `left` and `right` to `out`, which has rows of `columns` entries as `right` has; `left` has rows
    /// of `inner` entries.
    ///
    /// ```
    /// let mut out = [1.0; 4];
    /// mcm::numerics::dense::add_product(&[1.0, 2.0, 3.0, 4.0], &[1.0, 0.0, 0.0, 1.0], 2, 2, &mut out);
    /// assert_eq!(out, [2.0, 3.0, 4.0, 5.0]);
    /// ```
    pub fn add_product(left: &[f64], right: &[f64], inner: usize, columns: usize, out: &mut [f64]) {
        let mut blocks = out.chunks_exact_mut(ROWS * columns.max(1));
        let mut factors = left.chunks_exact(ROWS * inner.max(1));
        for (block, own) in (&mut blocks).zip(&mut factors) {
            add_rows::<ROWS>(|row, k| own[row * inner + k], right, columns, 0, block);
        }
        let rest = blocks.into_remainder().chunks_exact_mut(columns.max(1));
        for (row, own) in rest.zip(factors.remainder().chunks_exact(inner.max(1))) {
            add_rows::<1>(|_, k| own[k], right, columns, 0, row);
        }
    }
}

for_each_processor! {
    /// Adds the upper triangle of `left^T right` to `out`, all with rows of `size` entries; what is below the diagonal of
    /// `out` is left undetermined.
    ///
    /// ```
    /// let mut out = [0.0; 4];
    /// mcm::numerics::dense::add_upper(&[1.0, 2.0], &[1.0, 2.0], 2, &mut out);
    /// assert_eq!([out[0], out[1], out[3]], [1.0, 2.0, 4.0]);
    /// ```
    pub fn add_upper(left: &[f64], right: &[f64], size: usize, out: &mut [f64]) {
        let mut blocks = out.chunks_exact_mut(ROWS * size.max(1));
        let mut first = 0;
        for block in &mut blocks {
            add_rows::<ROWS>(|row, k| left[k * size + first + row], right, size, first, block);
            first += ROWS;
        }
        for row in blocks.into_remainder().chunks_exact_mut(size.max(1)) {
            add_rows::<1>(|_, k| left[k * size + first], right, size, first, row);
            first += 1;
        }
    }
}

for_each_processor! {
    /// Replaces `x`, which has `size` rows of `columns` entries, by the solution of `L y = x` with a Cholesky factor `L`; see
    /// [`super::cholesky::factorise`].
    pub fn forward_rows(factor: &[f64], size: usize, columns: usize, x: &mut [f64]) {
        for i in 0..size {
            let (solved, rest) = x.split_at_mut(i * columns);
            let (row, own) = (&mut rest[..columns], &factor[i * size..=i * size + i]);
            let wide = columns - columns % WIDE;
            add_blocks::<1, WIDE>(|_, k| -own[k], solved, columns, 0..wide, row);
            add_rows::<1>(|_, k| -own[k], solved, columns, wide, row);
            for entry in row {
                *entry /= own[i];
            }
        }
    }
}

/// Adds `sum_k factor(r, k) right[k]` to each of `R` rows, from the column `first` on.
#[inline(always)]
fn add_rows<const R: usize>(
    factor: impl Fn(usize, usize) -> f64,
    right: &[f64],
    columns: usize,
    first: usize,
    rows: &mut [f64],
) {
    let narrow = columns - (columns - first) % COLUMNS;
    add_blocks::<R, COLUMNS>(&factor, right, columns, first..narrow, rows);
    add_blocks::<R, 1>(&factor, right, columns, narrow..columns, rows);
}

/// Adds the product for a range of columns, a multiple of `C`.
#[inline(always)]
fn add_blocks<const R: usize, const C: usize>(
    factor: impl Fn(usize, usize) -> f64,
    right: &[f64],
    columns: usize,
    range: core::ops::Range<usize>,
    rows: &mut [f64],
) {
    for start in range.step_by(C) {
        let mut sums = [[0.0; C]; R];
        for (row, sums) in sums.iter_mut().enumerate() {
            sums.copy_from_slice(&rows[row * columns + start..][..C]);
        }

        // The block's sums stay in registers while the inner index runs.
        for (k, values) in right.chunks_exact(columns).enumerate() {
            let values = &values[start..start + C];
            for (row, sums) in sums.iter_mut().enumerate() {
                let factor = factor(row, k);
                for (sum, value) in sums.iter_mut().zip(values) {
                    *sum += factor * value;
                }
            }
        }

        for (row, sums) in sums.iter().enumerate() {
            rows[row * columns + start..][..C].copy_from_slice(sums);
        }
    }
}

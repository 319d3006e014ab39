//! What the rows tell of the parameters: covariance, and directions in which they tell nothing.

use super::constants::{FLAT, MEMBER, TOUCHED, UNKNOWN};
use nalgebra::{DMatrix, DVector};

/// Parameters that the rows cannot tell apart: a change of all of them together, in these proportions, is not seen.
#[derive(Debug, Clone, PartialEq)]
pub struct Direction {
    /// The parameters.
    pub keys: Vec<String>,
    /// By how much each changes, relative to its value.
    pub changes: Vec<f64>,
    /// By how many standard deviations all rows together change for a relative change of length 1.
    pub strength: f64,
}

impl Direction {
    /// In words.
    #[must_use]
    pub fn words(&self) -> String {
        let names: Vec<String> = self.keys.iter().map(|key| format!("`{key}`")).collect();
        let Some((last, others)) = names.split_last() else { return String::new() };
        if others.is_empty() {
            return format!("{last} is hardly determined by these rows");
        }
        format!("{} and {last} cannot be distinguished by these rows", others.join(", "))
    }
}

/// What follows from the Jacobian.
#[derive(Debug)]
pub(super) struct Told {
    /// Covariance of the parameters for residuals of variance 1.
    pub(super) covariance: DMatrix<f64>,
    /// Parameters whose deviation is known.
    pub(super) known: Vec<bool>,
    pub(super) directions: Vec<Direction>,
}

/// Unit of a parameter in which changes count as relative.
pub(super) fn units(parameters: &DVector<f64>) -> DVector<f64> {
    parameters.map(|value| if value == 0.0 { 1.0 } else { value.abs() })
}

impl Told {
    /// Of weighted derivatives of residuals whose standard deviation is `scale`.
    pub(super) fn of(
        jacobian: &DMatrix<f64>,
        parameters: &DVector<f64>,
        keys: &[String],
        scale: f64,
    ) -> Self {
        let count = parameters.len();
        let units = units(parameters);
        let mut known = vec![true; count];
        let mut covariance = DMatrix::zeros(count, count);
        let mut directions = Vec::new();
        let lengths = DVector::from_iterator(count, jacobian.column_iter().map(|column| column.norm()));
        let (values, vectors) = singular(jacobian, &lengths);
        let largest = values.max();
        let direction = |vector: DVector<f64>, strength: f64| {
            let size = vector.amax();
            let members: Vec<usize> = (0..count).filter(|&i| vector[i].abs() > MEMBER * size).collect();
            Direction {
                keys: members.iter().map(|&i| keys[i].clone()).collect(),
                changes: members.iter().map(|&i| vector[i]).collect(),
                strength,
            }
        };
        for (index, value) in values.iter().enumerate() {
            let vector = vectors.column(index);
            if *value <= FLAT * largest || largest == 0.0 {
                let touched = |i: &usize| vector[*i].abs() > TOUCHED;
                (0..count).filter(touched).for_each(|i| known[i] = false);
                // In relative changes of the parameters.
                let change = DVector::from_fn(count, |i, _| {
                    vector[i] / if lengths[i] > 0.0 { lengths[i] * units[i] } else { 1.0 }
                });
                let size = change.norm();
                directions.push(direction(change / size, 0.0));
            } else {
                let scaled = DVector::from_fn(count, |i, _| {
                    if lengths[i] > 0.0 { vector[i] / (lengths[i] * value) } else { 0.0 }
                });
                covariance += &scaled * scaled.transpose();
            }
        }
        if directions.is_empty() && scale > 0.0 {
            let (values, vectors) = singular(jacobian, &units.map(|unit| 1.0 / unit));
            let weak = |index: &usize| values[*index] < scale / UNKNOWN;
            let weak = (0..values.len()).filter(weak);
            directions.extend(weak.map(|i| direction(vectors.column(i).into_owned(), values[i] / scale)));
        }
        Self { covariance, known, directions }
    }
}

/// Singular values and right vectors of the Jacobian with columns divided by these lengths.
fn singular(jacobian: &DMatrix<f64>, lengths: &DVector<f64>) -> (DVector<f64>, DMatrix<f64>) {
    let mut scaled = jacobian.clone();
    for (mut column, length) in scaled.column_iter_mut().zip(lengths) {
        if *length > 0.0 {
            column /= *length;
        }
    }
    // Of the triangular factor, which has the same: rows need not be as many as columns there.
    let count = scaled.ncols();
    let mut square = DMatrix::zeros(count.max(scaled.nrows()), count);
    square.rows_mut(0, scaled.nrows()).copy_from(&scaled);
    let found = square.svd(false, true);
    let vectors = found.v_t.map_or_else(|| DMatrix::identity(count, count), |rows| rows.transpose());
    (found.singular_values, vectors)
}

/// Smallest singular value of derivatives by relative changes of the parameters.
pub(super) fn weakest(jacobian: &DMatrix<f64>, parameters: &DVector<f64>) -> f64 {
    singular(jacobian, &units(parameters).map(|unit| 1.0 / unit)).0.min()
}

//! Derivatives of the load on one frame with respect to the inputs.

use nalgebra::{DMatrix, Matrix3, Vector3};

use super::super::layout::{Counts, Input};

/// Number of inputs of the background field: three of the uniform field, five of its gradient.
pub(crate) const BACKGROUND_INPUTS: usize = Input::UniformField.width() + Input::FieldGradient.width();

/// Derivative of the field (T) and of its gradient (T/m) with respect to one input.
pub(crate) type FieldRate = (Vector3<f64>, Matrix3<f64>);

/// Derivatives of the load's energy with respect to position and rotation of its frame (six rows, world axes), with one
/// column for each input.
#[derive(Debug, Clone)]
pub(crate) struct LoadDerivatives {
    pub(crate) matrix: DMatrix<f64>,
    pub(crate) counts: Counts,
}

impl LoadDerivatives {
    /// Zero derivatives, for no load.
    pub(crate) fn none(counts: &Counts) -> Self {
        Self { matrix: DMatrix::zeros(6, counts.inputs()), counts: *counts }
    }

    /// Adds a force and a moment to one column.
    pub(crate) fn add(&mut self, column: usize, force: &Vector3<f64>, moment: &Vector3<f64>) {
        for axis in 0..3 {
            self.matrix[(axis, column)] += force[axis];
            self.matrix[(3 + axis, column)] += moment[axis];
        }
    }

    /// Adds a dipole (A m2) at `arm` (m) from the frame's origin to the columns from `first` on.
    pub(crate) fn add_dipole(
        &mut self,
        first: usize,
        moment: &Vector3<f64>,
        arm: &Vector3<f64>,
        rates: &[FieldRate],
    ) {
        for (column, (field, gradient)) in rates.iter().enumerate() {
            let force = -gradient * moment;
            self.add(first + column, &force, &(arm.cross(&force) - moment.cross(field)));
        }
    }
}

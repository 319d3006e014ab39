//! First-order response of the shape to the inputs.

use nalgebra::DMatrix;

use super::input_derivatives::InputDerivatives;
use crate::equilibrium::model::{Counts, Input};
use crate::error::Error;

/// First-order response of the shape, one column for each input; the base's columns are relative to the base.
#[derive(Debug)]
pub(crate) struct Response {
    pub(crate) counts: Counts,
    /// Whether magnets and coils that are switched off could be switched on.
    pub(crate) with_idle: bool,
    /// Rates of the inputs when the world moves about the base: see [`super::input_derivatives::base_transport`].
    pub(crate) by_base: DMatrix<f64>,
    /// Mixed derivatives.
    pub(crate) columns: InputDerivatives,
    /// Rates of the unknowns; by the inserted length with what moves the shape as the growing shaft does.
    pub(crate) unknowns: DMatrix<f64>,
    /// Rates of the push that holds the shaft.
    pub(crate) push: DMatrix<f64>,
    pub(crate) motion: Motion,
    /// Rates of the clamp's wrench.
    pub(crate) clamp: DMatrix<f64>,
}

/// Displacements (m) and rotations (rad) of the nodes, and rates of the variables of each element's derivatives.
#[derive(Debug)]
pub(crate) struct Motion {
    pub(crate) nodes: Vec<DMatrix<f64>>,
    pub(crate) elements: Vec<DMatrix<f64>>,
}

/// The error for a point where the field is not defined.
pub(crate) fn inside() -> Error {
    Error::NoDerivatives("a part lies inside or on an edge of a magnet or coil".into())
}

/// Fills the base's columns, relative to the base: what surrounds the chain moves the opposite way.
pub(crate) fn transport_base(rates: &mut DMatrix<f64>, by_base: &DMatrix<f64>) {
    let columns = -&*rates * by_base;
    rates.columns_mut(Input::BasePosition.columns().start, 6).copy_from(&columns);
}

//! Rows that were not measured and would tell more.

use nalgebra::{DMatrix, Vector3};

use super::descent::{Minimum, Weighted};
use super::spectrum::spectrum;
use crate::error::Error;
use crate::manipulator::Inputs;

/// An experiment beside the first row: its name, and what changes.
type Experiment = (&'static str, fn(&mut Inputs));

/// What a laboratory can add without another device.
const EXPERIMENTS: [Experiment; 5] = [
    ("gravity across the device", |inputs| inputs.gravity = Vector3::new(0.0, -9.81, 0.0)),
    ("a force of 1 mN across the tip", |inputs| inputs.tip_force.y += 1e-3),
    ("a force of 5 mN along the axis at the tip", |inputs| inputs.tip_force.z += 5e-3),
    ("another uniform field, 5 mT more across", |inputs| inputs.uniform_field.y += 5e-3),
    ("another uniform field, 5 mT more along the base's axis", |inputs| inputs.uniform_field.z += 5e-3),
];

/// By how much the least singular value must rise above what counts as nothing.
const HELPS: f64 = 10.0;

/// The experiment that raises the least singular value of the derivatives most; `None` where none does.
pub(super) fn helpful(
    weighted: &Weighted<'_>,
    minimum: &Minimum,
    scaled: &DMatrix<f64>,
    nothing: f64,
) -> Result<Option<&'static str>, Error> {
    let mut best = (HELPS * nothing, None);
    for (name, change) in EXPERIMENTS {
        let Some(rates) = weighted.problem.rates_with(&minimum.point.answers, change)? else { continue };
        let rates = weighted.scaled(&rates);
        let both = DMatrix::from_rows(&scaled.row_iter().chain(rates.row_iter()).collect::<Vec<_>>());
        let least = spectrum(&both).0.min();
        if least > best.0 {
            best = (least, Some(name));
        }
    }
    Ok(best.1)
}

//! Derivatives as differences of neighbouring devices: by parameters, and of outputs that have no row in the Jacobian.

use nalgebra::Vector3;

use super::host_values::HostValues;
use super::units::DENSITY;
use super::value::{DataType, Value};
use super::variable::Variable;
use crate::design::{Section, Specification};
use crate::error::Error;
use crate::magnetics::Wrench;
use crate::manipulator::{Manipulator, Number, Outputs};

/// Step of the differences of wrenches between sources, in parts of the usual size of what moves: their quadrature is accurate to 1e-6,
/// and the error of a difference of fourth order is the fourth power of the step.
const SOURCE_STEP: f64 = 0.02;

/// Steps and weights of differences: central of fourth order, and one-sided of second order (Fornberg, Math. Comp. 51 (1988) 699, tables
/// 1 and 3).
const STENCILS: [&[(f64, f64)]; 3] = [
    &[(-2.0, 1.0 / 12.0), (-1.0, -2.0 / 3.0), (1.0, 2.0 / 3.0), (2.0, -1.0 / 12.0)],
    &[(0.0, -1.5), (1.0, 2.0), (2.0, -0.5)],
    &[(0.0, 1.5), (-1.0, -2.0), (-2.0, 0.5)],
];

/// The outputs of two devices beside the solved one, and by how much their inputs or parameter differ.
pub(super) struct Neighbours {
    sides: [Outputs; 2],
    difference: f64,
}

impl Neighbours {
    /// Those with a smaller and with a larger value of a Real parameter.
    ///
    /// A density of 0 stands for the one that follows from the composition: it is varied about that one.
    ///
    /// # Errors
    /// As [`Manipulator::outputs_beside`].
    pub(super) fn by(
        manipulator: &Manipulator,
        values: &HostValues,
        parameter: &Variable,
    ) -> Result<Self, Error> {
        let unknown = || Error::NoDerivatives(format!("{} has no value", parameter.name));
        let mut value = parameter.host_value(values).and_then(Value::real).ok_or_else(unknown)?;
        let DataType::Real(quantity) = parameter.data_type else { return Err(unknown()) };
        if value == 0.0 && quantity == DENSITY {
            value = density_of(values, parameter)?.ok_or_else(unknown)?;
        }
        let number = Number { value, usual: quantity.nominal };
        let (sides, difference) = manipulator.outputs_beside(number, |value| {
            let mut varied = values.clone();
            parameter.set(&mut varied, Value::Real(value))?;
            varied.variant()
        })?;
        Ok(Self { sides, difference })
    }

    /// Those at inputs a little before and after along a direction, given by the derivatives of inputs.
    ///
    /// # Errors
    /// As [`Manipulator::outputs_beside`].
    pub(super) fn along(
        manipulator: &Manipulator,
        values: &HostValues,
        direction: &[(&Variable, f64)],
    ) -> Result<Self, Error> {
        let number = Number { value: 0.0, usual: usual(direction) };
        let (sides, difference) =
            manipulator.outputs_beside(number, |way| moved(values, direction, way)?.variant())?;
        Ok(Self { sides, difference })
    }

    /// The derivative of an output; `None` for what is no Real.
    pub(super) fn derivative(&self, output: &Variable) -> Option<f64> {
        let [before, after] = self.sides.each_ref().map(|side| output.output(side)?.real());
        Some((after? - before?) / self.difference)
    }
}

/// Derivatives of the wrench of each source from all others, along a direction that is given by derivatives of inputs and parameters.
///
/// # Errors
/// As [`crate::magnetics::Sources::mutual_wrenches`], and those of values beside.
pub(super) fn mutual_wrenches(
    values: &HostValues,
    direction: &[(&Variable, f64)],
) -> Result<Vec<Wrench>, Error> {
    let step = SOURCE_STEP * usual(direction);
    let at = |steps: f64| {
        let variant = moved(values, direction, steps * step)?.variant()?;
        variant.inputs.mutual_wrenches(&variant.sources)
    };
    let difference = |stencil: &[(f64, f64)]| {
        let mut sum: Vec<Wrench> = Vec::new();
        for &(steps, weight) in stencil {
            let wrenches = at(steps)?;
            sum.resize(wrenches.len(), Wrench { force: Vector3::zeros(), torque: Vector3::zeros() });
            for (sum, wrench) in sum.iter_mut().zip(wrenches) {
                sum.force += wrench.force * (weight / step);
                sum.torque += wrench.torque * (weight / step);
            }
        }
        Ok(sum)
    };
    // On one side where the other is beyond the range of a parameter, or where bodies touch.
    let [central, forward, backward] = STENCILS;
    difference(central).or_else(|_: Error| difference(forward)).or_else(|_| difference(backward))
}

/// The length of way along a direction on which the first of its variables changes by its usual size.
fn usual(direction: &[(&Variable, f64)]) -> f64 {
    let rates = direction.iter().map(|(variable, rate)| match variable.data_type {
        DataType::Real(quantity) => (rate / quantity.nominal).abs(),
        _ => 0.0,
    });
    1.0 / rates.fold(f64::MIN_POSITIVE, f64::max)
}

/// The values at a length of way along a direction.
fn moved(values: &HostValues, direction: &[(&Variable, f64)], way: f64) -> Result<HostValues, Error> {
    let mut moved = values.clone();
    for (variable, rate) in direction {
        if let Some(start) = variable.host_value(values).and_then(Value::real) {
            variable.set(&mut moved, Value::Real(start + rate * way))?;
        }
    }
    Ok(moved)
}

/// The density (kg/m3) that follows from the composition of the body whose density this parameter is.
fn density_of(values: &HostValues, parameter: &Variable) -> Result<Option<f64>, Error> {
    if let Specification::Sections(device) = &values.specification {
        return Ok(device.sections.get(parameter.index.item).map(Section::density));
    }
    let design = values.design()?;
    let segment = design.segments().get(parameter.index.component);
    Ok(segment.and_then(|segment| segment.spans.first()).map(|span| span.density))
}

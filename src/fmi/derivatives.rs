//! Derivatives of an instance: of inputs and outputs with respect to time, and of outputs with respect to inputs.

use std::sync::Arc;

use super::directional_derivatives::{direction, output_derivative};
use super::fmu_state::FmuState;
use super::host_values::HostValues;
use super::instance::Instance;
use super::state::{Ending, State};
use super::units::DENSITY;
use super::value::{DataType, Value};
use super::variable::{Causality, Variability, Variable};
use crate::error::Error;
use crate::manipulator::{Manipulator, Number, Outputs};

impl Instance {
    /// Sets time derivatives of inputs for the next step, in the unit of the input per second: all of them, or none if one
    /// is refused.
    ///
    /// `orders` are the orders of the derivatives. Inputs are taken as linear in time, so that derivatives of an order above
    /// the first are not used; if one of them is not zero, the log says so.
    pub fn set_input_derivatives(&mut self, references: &[u32], orders: &[i32], values: &[f64]) -> Ending {
        let entries = || references.iter().zip(orders).zip(values);
        let mut unused = None;
        for ((&reference, &order), &value) in entries() {
            let Some(variable) = self.variable(reference) else { return Ending::Error };
            let name = &variable.name;
            if variable.causality != Causality::Input || variable.variability != Variability::Continuous {
                return self.refuse(&format!("{name} is not a continuous input: it has no time derivative"));
            }
            if order < 1 {
                return self.refuse(&format!("the order {order} of a derivative of {name} is not allowed"));
            }
            if !value.is_finite() {
                let quantity = format!("time derivative of {name}");
                return self.refuse(&Error::range(quantity, value, "finite").to_string());
            }
            if order > 1 && value != 0.0 {
                unused = Some(name);
            }
        }
        if let Some(name) = unused {
            self.log.notice(&format!("derivatives of {name} above the first order are not used"));
        }
        for ((&reference, _), &value) in entries().filter(|((_, order), _)| **order == 1) {
            self.fmu_state.input_derivatives.set(reference, value);
        }
        Ending::Ok
    }

    /// Time derivatives of outputs at the present time, in the unit of the output per second. They follow from the time
    /// derivatives of the inputs, and are 0 where the inputs are held constant.
    ///
    /// Derivatives of an order above the first are unknown and therefore returned as 0 (FMI 2.0.4, section 4.2.1).
    ///
    /// # Errors
    /// [`Ending::Error`], explained in the log, when there are none.
    pub fn output_derivatives(&mut self, references: &[u32], orders: &[i32]) -> Result<Vec<f64>, Ending> {
        if let Some(order) = orders.iter().find(|order| **order < 1) {
            return Err(self.refuse(&format!("the order {order} of a derivative is not allowed")));
        }
        let (knowns, seed): (Vec<_>, Vec<_>) = self.fmu_state.input_derivatives.nonzero().unzip();
        let mut values = self.directional_derivative(references, &knowns, &seed)?;
        let higher = values.iter_mut().zip(orders).filter(|(_, order)| **order > 1);
        higher.for_each(|(value, _)| *value = 0.0);
        Ok(values)
    }

    /// Derivatives of the outputs `unknowns` with respect to the inputs `knowns`, times the direction `seed`.
    ///
    /// Gravity, a tunable parameter, counts as an input. During initialisation fixed parameters of type Real are known too (FMI 2.0.4,
    /// section 2.1.9).
    ///
    /// # Errors
    /// [`Ending::Error`], explained in the log, when there are none.
    pub fn directional_derivative(
        &mut self,
        unknowns: &[u32],
        knowns: &[u32],
        seed: &[f64],
    ) -> Result<Vec<f64>, Ending> {
        for &reference in knowns {
            let variable = self.variable(reference).ok_or(Ending::Error)?;
            let varies = self.state() == State::Initialization && varies_the_device(variable);
            if !variable.derivative_role.is_known() && !varies {
                let (name, reason) = (&variable.name, "it is not a continuous input");
                let until = if varies_the_device(variable) { ", and initialisation is over" } else { "" };
                return Err(self.refuse(&format!("there are no derivatives by {name}: {reason}{until}")));
            }
        }
        for &reference in unknowns {
            let variable = self.variable(reference).ok_or(Ending::Error)?;
            if !variable.derivative_role.is_unknown() {
                let name = &variable.name;
                return Err(self.refuse(&format!("{name} has no derivatives: it is not a continuous output")));
            }
        }
        if let Some(value) = seed.iter().find(|value| !value.is_finite()) {
            return Err(self.refuse(&Error::range("seed of a derivative", *value, "finite").to_string()));
        }
        self.solve_if_live()?;
        if seed.iter().all(|value| *value == 0.0) {
            return Ok(vec![0.0; unknowns.len()]);
        }
        self.derivatives_along(unknowns, knowns, seed).map_err(|error| self.refuse(&error.to_string()))
    }

    fn derivatives_along(
        &mut self,
        unknowns: &[u32],
        knowns: &[u32],
        seed: &[f64],
    ) -> Result<Vec<f64>, Error> {
        let not_solved = || Error::NoDerivatives("nothing is solved yet".into());
        let FmuState { manipulator, jacobian, host_values, .. } = &mut self.fmu_state;
        let manipulator = manipulator.as_ref().ok_or_else(not_solved)?;
        let jacobian = match jacobian {
            Some(known) => known,
            None => jacobian.insert(Arc::new(manipulator.jacobian()?)),
        };
        let table = self.package.table();
        let seeded = knowns.iter().zip(seed).filter(|(_, seed)| **seed != 0.0);
        let seeded = seeded.filter_map(|(&known, &seed)| Some((table.find(known)?, seed)));
        let (parameters, seeded): (Vec<_>, Vec<_>) = seeded.partition(|(known, _)| varies_the_device(known));
        let direction = direction(jacobian, host_values, seeded.into_iter()).ok_or_else(not_solved)?;
        let all = jacobian.along(&direction)?;
        let of_output = |&unknown: &u32| {
            let variable = table.find(unknown)?;
            output_derivative(jacobian, all.as_slice(), manipulator.outputs(), variable)
        };
        let mut derivatives: Vec<f64> = unknowns
            .iter()
            .map(|unknown| of_output(unknown).ok_or_else(not_solved))
            .collect::<Result<_, _>>()?;
        for (parameter, seed) in parameters {
            let (sides, apart) = beside(manipulator, host_values, parameter)?;
            for (derivative, unknown) in derivatives.iter_mut().zip(unknowns) {
                let read = |outputs| table.find(*unknown)?.output(outputs)?.real();
                let [before, after] = sides.each_ref().map(read);
                *derivative += seed * (after.zip(before).map(|(a, b)| a - b)).ok_or_else(not_solved)? / apart;
            }
        }
        if derivatives.iter().all(|derivative| derivative.is_finite()) {
            Ok(derivatives)
        } else {
            Err(Error::NoDerivatives("they are too large for numbers".into()))
        }
    }
}

/// Whether the variable is a number on which the device depends, and its surroundings: a fixed parameter of type Real.
fn varies_the_device(variable: &Variable) -> bool {
    (variable.causality, variable.variability) == (Causality::Parameter, Variability::Fixed)
        && matches!(variable.data_type, DataType::Real(_))
}

/// The outputs of two devices beside the solved one, one with a smaller and one with a larger value of a parameter, and by how much it
/// differs between them.
fn beside(
    manipulator: &Manipulator,
    values: &HostValues,
    parameter: &Variable,
) -> Result<([Outputs; 2], f64), Error> {
    let unknown = || Error::NoDerivatives(format!("{} has no value", parameter.name));
    let value = parameter.host_value(values).and_then(Value::real).ok_or_else(unknown)?;
    let DataType::Real(quantity) = parameter.data_type else { return Err(unknown()) };
    if value == 0.0 && quantity == DENSITY {
        return Err(Error::NoDerivatives(format!(
            "{} = 0 stands for the rule of its material",
            parameter.name
        )));
    }
    let number = Number { value, usual: quantity.nominal };
    manipulator.outputs_beside(number, |value| {
        let mut varied = values.clone();
        parameter.set(&mut varied, Value::Real(value))?;
        varied.variant()
    })
}

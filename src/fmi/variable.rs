//! One row of the table of variables: what the variable is, and how it is read and set.

use super::dependency::{Dependency, DependencyKind, Known};
use super::derivative_role::DerivativeRole;
use super::host_values::HostValues;
use super::search_report::SearchReport;
use super::value::{DataType, Value};
use crate::error::Error;
use crate::manipulator::Outputs;
pub use crate::manipulator::output_table::{Index, Request};

/// The standard's causality.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Causality {
    /// Set by the host, before the start and between communication steps.
    Input,
    /// Set by the host; when, its variability says.
    Parameter,
    /// Computed from inputs and parameters, and connected to other models: a Real that has derivatives.
    Output,
    /// Read by the host alone: a fact about the packed design, or a result that has no derivatives. Some hosts read every output
    /// as a Real, or ask for its derivatives.
    Local,
}

/// The standard's variability.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Variability {
    /// Never changes.
    Constant,
    /// Does not change after initialisation.
    Fixed,
    /// Changes only between communication steps, when the host sets it.
    Tunable,
    /// Changes at communication points only, and has no derivatives.
    Discrete,
    /// Changes continuously with the inputs, or is such an input.
    Continuous,
}

/// When a result has a value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Availability {
    /// Always: it describes the search for an equilibrium, also one that found none.
    Always,
    /// Once an equilibrium was found.
    Solved,
    /// Once an equilibrium was found; it takes a computation of its own, which is done only when the host reads it.
    OnRequest(Request),
}

/// How a variable is read and set.
#[derive(Debug, Clone, Copy)]
pub enum Access {
    /// A Real input or parameter.
    Real {
        /// Reads it.
        get: fn(&HostValues, Index) -> f64,
        /// Sets it.
        set: fn(&mut HostValues, Index, f64),
    },
    /// A Boolean parameter.
    Boolean {
        /// Reads it.
        get: fn(&HostValues) -> bool,
        /// Sets it.
        set: fn(&mut HostValues, bool),
    },
    /// An Enumeration parameter.
    Enumeration {
        /// Reads the number of the item.
        get: fn(&HostValues) -> i32,
        /// Sets it; a number that is no item has no effect.
        set: fn(&mut HostValues, i32),
    },
    /// A Real, or a whole number as an Integer, that is read from the last shape.
    NumberOutput(fn(&Outputs, Index) -> f64),
    /// An Enumeration that is read from the last shape.
    IntegerOutput(fn(&Outputs) -> i32),
    /// A Boolean that is read from the last shape.
    BooleanOutput(fn(&Outputs) -> bool),
    /// A Real that describes the search for an equilibrium.
    RealOfSearch(fn(&SearchReport) -> f64),
    /// An Integer that describes the search for an equilibrium.
    IntegerOfSearch(fn(&SearchReport) -> i32),
    /// A constant.
    Constant(Value),
}

/// A row of the table.
#[derive(Debug, Clone)]
pub struct Variable {
    /// Structured name.
    pub name: String,
    /// Description for people.
    pub description: String,
    /// Data type.
    pub data_type: DataType,
    /// Causality.
    pub causality: Causality,
    /// Variability.
    pub variability: Variability,
    /// Smallest value, if there is one, in the variable's unit.
    pub min: Option<f64>,
    /// Largest value, if there is one, in the variable's unit.
    pub max: Option<f64>,
    /// Which element of its array the variable is.
    pub index: Index,
    /// How it is read and set.
    pub access: Access,
    /// What an input or parameter acts on; without meaning for other variables.
    pub known: Known,
    /// How a result depends on inputs and parameters; without meaning for other variables.
    pub dependency: Dependency,
    /// How it takes part in derivatives.
    pub derivative_role: DerivativeRole,
    /// When a result has a value; without meaning for other variables.
    pub availability: Availability,
}

impl Variable {
    /// Causality and variability in words, for people.
    #[must_use]
    pub fn causality_in_words(&self) -> &'static str {
        match (self.causality, self.variability) {
            (Causality::Input, _) => "input",
            (Causality::Parameter, Variability::Tunable) => "tunable parameter",
            (Causality::Parameter, _) => "fixed parameter",
            (Causality::Output, _) => "output",
            (Causality::Local, Variability::Constant) => "constant",
            (Causality::Local, _) => "local result",
        }
    }

    /// Whether it is computed: neither set by the host nor a constant.
    #[must_use]
    pub fn is_result(&self) -> bool {
        match self.causality {
            Causality::Input | Causality::Parameter => false,
            Causality::Output => true,
            Causality::Local => self.variability != Variability::Constant,
        }
    }

    /// The value of an input, parameter or constant; `None` for a result.
    #[must_use]
    pub fn host_value(&self, values: &HostValues) -> Option<Value> {
        match self.access {
            Access::Real { get, .. } => Some(Value::Real(get(values, self.index))),
            Access::Boolean { get, .. } => Some(Value::Boolean(get(values))),
            Access::Enumeration { get, .. } => Some(Value::Integer(get(values))),
            Access::Constant(value) => Some(value),
            Access::NumberOutput(_)
            | Access::IntegerOutput(_)
            | Access::BooleanOutput(_)
            | Access::RealOfSearch(_)
            | Access::IntegerOfSearch(_) => None,
        }
    }

    /// The value of a result that describes the search for an equilibrium; `None` for other variables.
    #[must_use]
    pub fn of_search(&self, report: &SearchReport) -> Option<Value> {
        match self.access {
            Access::RealOfSearch(get) => Some(Value::Real(get(report))),
            Access::IntegerOfSearch(get) => Some(Value::Integer(get(report))),
            _ => None,
        }
    }

    /// The value of a result that is read from a shape; `None` for other variables.
    #[must_use]
    pub fn output(&self, outputs: &Outputs) -> Option<Value> {
        match self.access {
            Access::NumberOutput(get) => {
                let number = get(outputs, self.index);
                #[expect(clippy::cast_possible_truncation, reason = "counts of contacts are small")]
                let whole = number as i32;
                Some(if self.data_type == DataType::Integer {
                    Value::Integer(whole)
                } else {
                    Value::Real(number)
                })
            }
            Access::IntegerOutput(get) => Some(Value::Integer(get(outputs))),
            Access::BooleanOutput(get) => Some(Value::Boolean(get(outputs))),
            Access::Real { .. }
            | Access::Boolean { .. }
            | Access::Enumeration { .. }
            | Access::RealOfSearch(_)
            | Access::IntegerOfSearch(_)
            | Access::Constant(_) => None,
        }
    }

    /// Checks that the variable can take this value: that it is of its type, and a finite number of a possible size or one of its items.
    ///
    /// Closer bounds are not checked here but where the value is used, since some hold only for a combination of parameters.
    ///
    /// # Errors
    /// [`Error::Range`] for a number that is not finite or too large; [`Error::Unsupported`] for a value of another type and for a
    /// number that is no item.
    pub fn check(&self, value: Value) -> Result<(), Error> {
        let name = &self.name;
        match (self.data_type, value) {
            (DataType::Real(_), Value::Real(number)) if !number.is_finite() => {
                Err(Error::range(name, number, "finite"))
            }
            (DataType::Real(quantity), Value::Real(number)) => {
                quantity.range().check(name, number).map(|_| ())
            }
            (DataType::Enumeration(enumeration), Value::Integer(number)) if !enumeration.has_item(number) => {
                Err(Error::Unsupported(format!("{name} has no item {number}")))
            }
            (DataType::Integer | DataType::Enumeration(_), Value::Integer(_))
            | (DataType::Boolean, Value::Boolean(_)) => Ok(()),
            _ => Err(Error::Unsupported(format!("{name} is not of type {}", value.type_name()))),
        }
    }

    /// Sets an input or parameter.
    ///
    /// # Errors
    /// Those of [`Variable::check`]; [`Error::Unsupported`] for an output or constant. Nothing is set then.
    pub fn set(&self, values: &mut HostValues, value: Value) -> Result<(), Error> {
        self.check(value)?;
        match (self.access, value) {
            (Access::Real { set, .. }, Value::Real(value)) => set(values, self.index, value),
            (Access::Boolean { set, .. }, Value::Boolean(value)) => set(values, value),
            (Access::Enumeration { set, .. }, Value::Integer(value)) => set(values, value),
            _ => return Err(Error::Unsupported(format!("{} cannot be set", self.name))),
        }
        Ok(())
    }

    /// How an output depends on an input or parameter; `None` if it does not.
    #[must_use]
    pub fn depends_on(&self, known: &Self) -> Option<DependencyKind> {
        self.dependency.on(known.known, self.index.component == known.index.component)
    }
}

//! Rows while the table is being written: scalars and arrays from drafts.

use core::ops::Bound::{self, Excluded, Included, Unbounded};

use super::super::dependency::{Dependency, Known};
use super::super::derivative_role::DerivativeRole;
use super::super::units::{QUATERNION, Quantity};
use super::super::value::{DataType, Value};
use super::super::variable::{Access, Availability, Causality, Index, Variability, Variable};
use crate::error;

/// A row before it is known which element of which array it becomes.
///
/// Its tags start with what holds for most variables; the methods named after tags change them.
#[derive(Debug, Clone)]
pub(super) struct Draft(Variable);

impl Draft {
    fn new(
        name: impl Into<String>,
        data_type: DataType,
        description: impl Into<String>,
        access: Access,
    ) -> Self {
        Self(Variable {
            name: name.into(),
            description: description.into(),
            data_type,
            causality: Causality::Local,
            variability: Variability::Constant,
            min: None,
            max: None,
            index: Index::default(),
            access,
            known: Known::Other,
            dependency: Dependency::Equilibrium,
            derivative_role: DerivativeRole::None,
            availability: Availability::Solved,
        })
    }

    /// The draft with an index behind its name.
    pub(super) fn indexed(self, index: &str) -> Self {
        self.with(|row| row.name += index)
    }

    fn with(mut self, change: impl FnOnce(&mut Variable)) -> Self {
        change(&mut self.0);
        self
    }

    /// The draft with the number of an item, counted from 0, in place of `*` in its name.
    pub(super) fn of_item(self, item: usize) -> Self {
        self.with(|row| row.name = row.name.replace('*', &(item + 1).to_string()))
    }

    fn tagged(self, causality: Causality, variability: Variability) -> Self {
        self.with(|row| (row.causality, row.variability) = (causality, variability))
    }

    /// A continuous input.
    pub(super) fn input(
        name: impl Into<String>,
        quantity: Quantity,
        description: &str,
        access: Access,
    ) -> Self {
        let row = Self::new(name, quantity.into(), description, access);
        row.tagged(Causality::Input, Variability::Continuous)
    }

    /// An input that is a component of a unit quaternion.
    pub(super) fn orientation(name: impl Into<String>, description: &str, access: Access) -> Self {
        Self::input(name, QUATERNION, description, access).min(-1.0).max(1.0)
    }

    /// A fixed parameter.
    pub(super) fn parameter(
        name: impl Into<String>,
        data_type: impl Into<DataType>,
        description: &str,
        access: Access,
    ) -> Self {
        let row = Self::new(name, data_type.into(), description, access);
        row.tagged(Causality::Parameter, Variability::Fixed)
    }

    /// A fixed parameter that holds this quantity, in this unit.
    pub(super) fn holding(
        quantity: &'static error::Quantity,
        unit: impl Into<DataType>,
        access: Access,
    ) -> Self {
        let limit = |bound: Bound<f64>| match bound {
            Included(limit) | Excluded(limit) => Some(limit),
            Unbounded => None,
        };
        let (min, max) = (limit(quantity.interval.low), limit(quantity.interval.high));
        let row = Self::parameter(quantity.variable, unit, quantity.description, access);
        row.with(|row| (row.min, row.max) = (min, max))
    }

    /// A result without derivatives: it is local, since some hosts read every output as a Real and ask for its derivatives.
    pub(super) fn result(
        name: impl Into<String>,
        data_type: impl Into<DataType>,
        description: &str,
        access: Access,
    ) -> Self {
        let row = Self::new(name, data_type.into(), description, access);
        row.tagged(Causality::Local, Variability::Discrete)
    }

    /// A constant.
    pub(super) fn constant(name: &str, description: &str, value: Value) -> Self {
        let data_type =
            if matches!(value, Value::Boolean(_)) { DataType::Boolean } else { DataType::Integer };
        Self::new(name, data_type, description, Access::Constant(value))
    }

    /// A parameter that may also be set between communication steps.
    pub(super) fn tunable(self) -> Self {
        self.with(|row| row.variability = Variability::Tunable)
    }

    /// The result as an output, which has derivatives.
    pub(super) fn continuous(self, role: DerivativeRole) -> Self {
        self.tagged(Causality::Output, Variability::Continuous).derivative_role(role)
    }

    pub(super) fn derivative_role(self, role: DerivativeRole) -> Self {
        self.with(|row| row.derivative_role = role)
    }

    /// The draft of a variable that is read and set otherwise.
    pub(super) fn access(self, access: Access) -> Self {
        self.with(|row| row.access = access)
    }

    pub(super) fn known(self, known: Known) -> Self {
        self.with(|row| row.known = known)
    }

    pub(super) fn dependency(self, dependency: Dependency) -> Self {
        self.with(|row| row.dependency = dependency)
    }

    pub(super) fn availability(self, availability: Availability) -> Self {
        self.with(|row| row.availability = availability)
    }

    pub(super) fn min(self, min: f64) -> Self {
        self.with(|row| row.min = Some(min))
    }

    pub(super) fn max(self, max: f64) -> Self {
        self.with(|row| row.max = Some(max))
    }
}

/// The rows written so far.
#[derive(Debug, Default)]
pub(super) struct Rows {
    pub(super) variables: Vec<Variable>,
}

impl Rows {
    /// A scalar.
    pub(super) fn scalar(&mut self, draft: Draft) {
        self.scalar_of(0, draft);
    }

    /// A scalar that belongs to body or point `item`.
    pub(super) fn scalar_of(&mut self, item: usize, draft: Draft) {
        self.component_of(item, 0, draft);
    }

    /// The variables `name[1]` to `name[length]`.
    pub(super) fn array(&mut self, length: usize, draft: &Draft) {
        self.array_of(0, length, draft);
    }

    /// The variables `name[1]` to `name[length]` that belong to body `item`.
    pub(super) fn array_of(&mut self, item: usize, length: usize, draft: &Draft) {
        self.components_of(item, length, draft, |component| format!("[{}]", component + 1));
    }

    /// The components of what belongs to body or point `item`, with an index for each.
    pub(super) fn components_of(
        &mut self,
        item: usize,
        length: usize,
        draft: &Draft,
        index: impl Fn(usize) -> String,
    ) {
        for component in 0..length {
            let named = draft.clone().indexed(&index(component)).with(|row| {
                if let DataType::Real(quantity) = row.data_type
                    && let Some(element) = quantity.elements.get(component)
                {
                    row.description = format!("{}: {element}", row.description);
                }
            });
            self.component_of(item, component, named);
        }
    }

    /// One component of what belongs to body or point `item`, under the draft's own name.
    pub(super) fn component_of(&mut self, item: usize, component: usize, draft: Draft) {
        self.variables.push(Variable { index: Index { item, component }, ..draft.0 });
    }
}

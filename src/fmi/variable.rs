//! One row of the variable table: what a variable is, and how it is read and set.

use serde::{Deserialize, Serialize};

use super::given::Given;
use super::slope::Slope;
use super::units::Quantity;
use crate::manipulator::Outputs;

/// The count of jumps to another branch.
pub(super) const SNAPS: &str = "stability.snaps";

/// A typed value. An enumeration's value is an integer.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum Value {
    /// Floating point.
    Real(f64),
    /// Integer or enumeration.
    Integer(i32),
    /// Truth value.
    Boolean(bool),
}

/// Type of a variable, as declared.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Kind {
    /// Real of a quantity.
    Real(Quantity),
    /// Integer.
    Integer,
    /// Boolean.
    Boolean,
    /// One of the items of an enumeration type.
    Enumeration(&'static Enumeration),
}

/// An enumeration type.
#[derive(Debug, PartialEq, Eq)]
pub struct Enumeration {
    /// Name of the type.
    pub name: &'static str,
    /// What it is.
    pub description: &'static str,
    /// Items.
    pub items: &'static [Item],
}

/// An item of an enumeration type.
#[derive(Debug, PartialEq, Eq)]
pub struct Item {
    /// Name of the item.
    pub name: &'static str,
    /// Its number.
    pub value: i32,
    /// What it means.
    pub description: &'static str,
}

/// Causality and variability together.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// Continuous input.
    Input,
    /// Parameter, set before the end of initialisation.
    Fixed,
    /// Parameter, set before the start and between steps.
    Tunable,
    /// What cannot change: a fact of the packed design.
    Constant,
    /// Output.
    Output,
}

/// Position in an array: which body, which axis, both from 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct At {
    /// Which ring, core, cylinder or shape point.
    pub item: usize,
    /// Which component.
    pub axis: usize,
}

/// How a variable is read and set.
#[derive(Debug, Clone, Copy)]
pub enum Access {
    /// A number that the host gives.
    Real {
        /// Reads it.
        get: fn(&Given, At) -> f64,
        /// Sets it.
        set: fn(&mut Given, At, f64),
    },
    /// A truth value that the host gives.
    Boolean {
        /// Reads it.
        get: fn(&Given) -> bool,
        /// Sets it.
        set: fn(&mut Given, bool),
    },
    /// An item that the host chooses.
    Choice {
        /// Reads it.
        get: fn(&Given) -> i32,
        /// Sets it; false for a number that is no item.
        set: fn(&mut Given, i32) -> bool,
    },
    /// A number that a solve answers.
    RealAnswer(fn(&Outputs, At) -> f64),
    /// An integer that a solve answers.
    IntegerAnswer(fn(&Outputs) -> i32),
    /// A truth value that a solve answers.
    BooleanAnswer(fn(&Outputs) -> bool),
    /// What cannot change.
    Fact(Value),
}

/// Upon which inputs and parameters an output depends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reach {
    /// Through the equilibrium upon everything but the load on a clamped ring.
    Equilibrium,
    /// The same and the load on a clamped ring: what the clamp bears.
    Clamp,
    /// Upon the base pose, as the first point of the centreline does.
    BasePoint,
    /// Upon the base pose, as the centre of a clamped ring does.
    ClampedCentre,
    /// Upon the base orientation, as the axis of a clamped ring does.
    ClampedAxis,
    /// Upon lengths of the design only.
    Lengths,
}

/// A row of the table.
#[derive(Debug, Clone)]
pub struct Variable {
    /// Structured name.
    pub name: String,
    /// What it is.
    pub description: String,
    /// Type.
    pub kind: Kind,
    /// Causality and variability.
    pub role: Role,
    /// Smallest value, if there is one.
    pub min: Option<f64>,
    /// Largest value, if there is one.
    pub max: Option<f64>,
    /// Position in its array.
    pub at: At,
    /// How it is read and set.
    pub access: Access,
    /// Upon what an output depends; without meaning for others.
    pub reach: Reach,
    /// How it takes part in derivatives.
    pub slope: Slope,
}

impl Variable {
    /// The value that the host gave, or the fact; `None` for an answer of a solve.
    #[must_use]
    pub fn given(&self, given: &Given) -> Option<Value> {
        match self.access {
            Access::Real { get, .. } => Some(Value::Real(get(given, self.at))),
            Access::Boolean { get, .. } => Some(Value::Boolean(get(given))),
            Access::Choice { get, .. } => Some(Value::Integer(get(given))),
            Access::Fact(value) => Some(value),
            Access::RealAnswer(_) | Access::IntegerAnswer(_) | Access::BooleanAnswer(_) => None,
        }
    }

    /// The answer of the last solve; `None` for what the host gives.
    #[must_use]
    pub fn answer(&self, outputs: &Outputs) -> Option<Value> {
        match self.access {
            Access::RealAnswer(get) => Some(Value::Real(get(outputs, self.at))),
            Access::IntegerAnswer(get) => Some(Value::Integer(get(outputs))),
            Access::BooleanAnswer(get) => Some(Value::Boolean(get(outputs))),
            _ => None,
        }
    }

    /// Whether it tells of the search for an equilibrium, which has a meaning even if none was ever found.
    #[must_use]
    pub fn tells_of_search(&self) -> bool {
        self.name.starts_with("solver.") || self.name == SNAPS
    }

    /// Sets what the host gives; false for a value that the variable cannot take.
    pub fn set(&self, given: &mut Given, value: Value) -> bool {
        match (self.access, value) {
            (Access::Real { set, .. }, Value::Real(value)) if value.is_finite() => set(given, self.at, value),
            (Access::Boolean { set, .. }, Value::Boolean(value)) => set(given, value),
            (Access::Choice { set, .. }, Value::Integer(value)) => return set(given, value),
            _ => return false,
        }
        true
    }

    /// Whether values of the same type as `value` belong to it.
    #[must_use]
    pub fn holds(&self, value: Value) -> bool {
        matches!(
            (self.kind, value),
            (Kind::Real(_), Value::Real(_))
                | (Kind::Integer | Kind::Enumeration(_), Value::Integer(_))
                | (Kind::Boolean, Value::Boolean(_))
        )
    }
}

impl Reach {
    /// How an output at `at` with this reach depends on the input or parameter `known`.
    ///
    /// The standard's words: `constant` (a constant factor) or `dependent` (no particular structure).
    #[must_use]
    pub fn upon(self, known: &Variable, at: At, clamped_ring: bool) -> Option<&'static str> {
        let name = known.name.as_str();
        let dependent = |holds: bool| holds.then_some("dependent");
        let same_axis =
            || (name.starts_with("base.position[") && known.at.axis == at.axis).then_some("constant");
        match self {
            Self::Equilibrium => dependent(!(clamped_ring && name.starts_with("ring[1].load_force"))),
            Self::Clamp => dependent(true),
            Self::BasePoint => same_axis(),
            Self::ClampedCentre => same_axis()
                .or(dependent(name.starts_with("base.orientation[") || name == "design.ring.length")),
            Self::ClampedAxis => dependent(name.starts_with("base.orientation[")),
            Self::Lengths => dependent(
                name.starts_with("design.")
                    && !name.starts_with("design.backbone")
                    && name.ends_with(".length"),
            ),
        }
    }
}

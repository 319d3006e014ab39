//! Values and data types of variables.

use serde::{Deserialize, Serialize};

use super::units::Quantity;

/// A value with its type. The value of an Enumeration is the number of an item.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum Value {
    /// Real, in the unit of the variable's quantity.
    Real(f64),
    /// Integer or Enumeration.
    Integer(i32),
    /// Boolean.
    Boolean(bool),
}

impl Value {
    /// The name of its type.
    #[must_use]
    pub fn type_name(self) -> &'static str {
        match self {
            Self::Real(_) => "Real",
            Self::Integer(_) => "Integer",
            Self::Boolean(_) => "Boolean",
        }
    }

    /// The number of a Real; `None` for another type.
    #[must_use]
    pub fn real(self) -> Option<f64> {
        if let Self::Real(value) = self { Some(value) } else { None }
    }

    /// The number of an Integer or of an item of an Enumeration; `None` for another type.
    #[must_use]
    pub fn integer(self) -> Option<i32> {
        if let Self::Integer(value) = self { Some(value) } else { None }
    }

    /// The truth value of a Boolean; `None` for another type.
    #[must_use]
    pub fn boolean(self) -> Option<bool> {
        if let Self::Boolean(value) = self { Some(value) } else { None }
    }
}

/// Data type of a variable. There are no String variables.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum DataType {
    /// Real of a quantity, which fixes its unit.
    Real(Quantity),
    /// Integer.
    Integer,
    /// Boolean.
    Boolean,
    /// One of the items of an enumeration type.
    Enumeration(&'static Enumeration),
}

impl From<Quantity> for DataType {
    fn from(quantity: Quantity) -> Self {
        Self::Real(quantity)
    }
}

/// An enumeration type.
#[derive(Debug, PartialEq, Eq)]
pub struct Enumeration {
    /// Name of the type.
    pub name: &'static str,
    /// Description for people.
    pub description: &'static str,
    /// The items.
    pub items: &'static [Item],
}

impl Enumeration {
    /// Whether an item has this number.
    #[must_use]
    pub fn has_item(&self, number: i32) -> bool {
        self.items.iter().any(|item| item.value == number)
    }
}

/// An item of an enumeration type.
#[derive(Debug, PartialEq, Eq)]
pub struct Item {
    /// Name of the item.
    pub name: &'static str,
    /// Its number.
    pub value: i32,
    /// Description for people.
    pub description: &'static str,
}

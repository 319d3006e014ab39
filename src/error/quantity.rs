//! What a number of a device or of its surroundings is, by all its names.

use super::{Error, Interval};

/// A number of a device or of its surroundings: what errors, scenes and the FMU call it, and what it may be.
///
/// ```
/// use mcm::error::{Error, Interval, Quantity};
/// static LENGTH: Quantity = Quantity {
///     name: "length (m)",
///     key: "part[*].length_mm",
///     variable: "part[*].length",
///     description: "Length of the part",
///     interval: Interval::above(0.0),
/// };
/// let refused = LENGTH.check(-0.2).map_err(|error| error.of_item(3)).unwrap_err();
/// assert_eq!(refused.to_string(), "length (m) = -0.2 is not allowed: it must be > 0");
/// assert_eq!(refused.identity().unwrap().key(), "part[3].length_mm");
/// assert_eq!(refused.identity().unwrap().variable(), "part[3].length");
/// ```
#[derive(Debug, PartialEq)]
pub struct Quantity {
    /// Name with the unit of the library, as errors tell it.
    pub name: &'static str,
    /// Key that holds it in a scene; `*` stands for the number of an item of a list. Without it the number of an item comes last.
    pub key: &'static str,
    /// Variable of the FMU that holds it, with `*` as in the key; empty where there is none.
    pub variable: &'static str,
    /// What it is, in words without a full stop.
    pub description: &'static str,
    /// What it may be, in the unit of the library.
    pub interval: Interval,
}

impl Quantity {
    /// Returns a value that is allowed, whatever other quantities are.
    ///
    /// # Errors
    /// [`Error::Range`] for any other value.
    pub fn check(&'static self, value: f64) -> Result<f64, Error> {
        self.check_beside(value, f64::INFINITY)
    }

    /// Returns a value that is allowed while the other quantity of its interval has the value `other`.
    ///
    /// # Errors
    /// [`Error::Range`] for any other value.
    pub fn check_beside(&'static self, value: f64, other: f64) -> Result<f64, Error> {
        self.interval.check_beside(self.name, value, other).map_err(|error| error.of(self))
    }
}

/// Which number of a scene an error is about.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Identity {
    /// What it is.
    pub quantity: &'static Quantity,
    /// Numbers of the items of lists that it belongs to, from 1, the outermost first; 0 while not known.
    items: [usize; 2],
}

impl Identity {
    /// The key that holds it in a scene, with the numbers of items in place of `*`, as far as they are known.
    #[must_use]
    pub fn key(&self) -> String {
        self.numbered(self.quantity.key)
    }

    /// The variable of the FMU that holds it, with the numbers of items in place of `*`; empty where there is none.
    #[must_use]
    pub fn variable(&self) -> String {
        self.numbered(self.quantity.variable)
    }

    /// The innermost list comes last in a name, and its number is known first.
    fn numbered(&self, name: &str) -> String {
        let items = self.items.iter().rev().filter(|item| **item > 0);
        items.fold(name.to_owned(), |name, item| match name.rsplit_once('*') {
            Some((before, after)) => format!("{before}{item}{after}"),
            // One value of a list that may also be one value for all.
            None => format!("{name}[{item}]"),
        })
    }
}

impl Error {
    /// The error, about this quantity.
    #[must_use]
    pub fn of(self, quantity: &'static Quantity) -> Self {
        match self {
            Self::Range { quantity: name, value, allowed, .. } => {
                let identity = Some(Identity { quantity, items: [0; 2] });
                Self::Range { quantity: name, value, allowed, identity }
            }
            other => other,
        }
    }

    /// The error, about an item of a list, by its number from 1: the innermost list first.
    #[must_use]
    pub fn of_item(mut self, number: usize) -> Self {
        if let Self::Range { identity: Some(identity), .. } = &mut self
            && let Some(unknown) = identity.items.iter_mut().rev().find(|item| **item == 0)
        {
            *unknown = number;
        }
        self
    }

    /// The error about the item with another number: what `number_of` gives for that of the outermost list.
    #[must_use]
    pub(crate) fn renumbered(mut self, number_of: impl FnOnce(usize) -> usize) -> Self {
        if let Self::Range { identity: Some(identity), .. } = &mut self
            && let Some(item) = identity.items.iter_mut().find(|item| **item > 0)
        {
            *item = number_of(*item);
        }
        self
    }

    /// Which number of a scene the error is about, if it is about one.
    #[must_use]
    pub fn identity(&self) -> Option<&Identity> {
        match self {
            Self::Range { identity, .. } => identity.as_ref(),
            _ => None,
        }
    }
}

/// Writes a table of quantities, of which the last five columns are those of [`Quantity`], and the list of all.
macro_rules! quantities {
    ($($row:ident: $name:literal, $key:literal, $variable:literal, $description:literal, $interval:expr;)*) => {
        $(
            #[doc = concat!($description, ": `", $key, "` in a scene.")]
            pub static $row: $crate::error::Quantity = $crate::error::Quantity {
                name: $name,
                key: $key,
                variable: $variable,
                description: $description,
                interval: $interval,
            };
        )*

        /// All rows of the table.
        pub static ALL: &[&$crate::error::Quantity] = &[$(&$row),*];
    };
}
pub(crate) use quantities;

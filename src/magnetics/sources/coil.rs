//! The dimensions of a coil.

use crate::error::Error;
use crate::magnetics::quantities::{COIL_INNER, COIL_LENGTH, COIL_OUTER, TURNS};

/// A winding of rectangular section whose turns fill it evenly, about its frame's `z`, centred at the origin. A positive current
/// makes a field along `+z` in its bore.
///
/// [`super::Solenoid`] makes the field source of it, or [`super::MultipoleCoil`] where its field is known by a table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Coil {
    /// Inner radius of the winding, m.
    pub inner_radius: f64,
    /// Outer radius of the winding, m.
    pub outer_radius: f64,
    /// Length along the axis, m.
    pub length: f64,
    /// Number of turns.
    pub turns: f64,
}

impl Coil {
    /// Checks the dimensions.
    ///
    /// # Errors
    /// [`Error::Range`] naming the first quantity out of range.
    pub fn checked(self) -> Result<Self, Error> {
        let Self { inner_radius, outer_radius, length, turns } = self;
        COIL_OUTER.check(outer_radius)?;
        COIL_INNER.check_beside(inner_radius, outer_radius)?;
        COIL_LENGTH.check(length)?;
        TURNS.check(turns)?;
        Ok(self)
    }
}

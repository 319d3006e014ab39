//! A coil: the dimensions of its winding, and its core.

use super::iron_core::IronCore;
use super::quantities::{COIL_INNER, COIL_LENGTH, COIL_OUTER, TURNS};
use crate::error::Error;

/// A thick solenoid: a winding of rectangular section whose turns fill it evenly, about its frame's `z`, centred at
/// the origin. A positive current makes a field along `+z` in its bore.
///
/// [`super::Assembly::of_coil`] makes the field source of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Coil {
    /// Inner radius of the winding, m.
    pub inner_radius: f64,
    /// Outer radius of the winding, m.
    pub outer_radius: f64,
    /// Length along the axis, m.
    pub length: f64,
    /// Number of turns; with a core, whose multipoles say all of the field, a remark.
    pub turns: f64,
    /// The iron core; `None` for none.
    pub core: Option<IronCore>,
}

impl Coil {
    /// Checks the dimensions.
    ///
    /// # Errors
    /// [`Error::Range`] naming the first quantity out of range.
    pub fn checked(self) -> Result<Self, Error> {
        let Self { inner_radius, outer_radius, length, turns, core } = self;
        COIL_OUTER.check(outer_radius)?;
        COIL_INNER.check_beside(inner_radius, outer_radius)?;
        COIL_LENGTH.check(length)?;
        TURNS.check(turns)?;
        core.map_or(Ok(self), |core| core.checked().map(|_| self))
    }
}

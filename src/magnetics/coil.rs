//! A coil: the dimensions of its winding, and its core.

use super::iron_core::IronCore;
use super::limits::{COIL_INNER_RADIUS, COIL_TURNS, SIZE};
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
        SIZE.check("coil outer radius (m)", outer_radius)?;
        COIL_INNER_RADIUS.check_beside("coil inner radius (m)", inner_radius, outer_radius)?;
        SIZE.check("coil length (m)", length)?;
        COIL_TURNS.check("coil turns", turns)?;
        core.map_or(Ok(self), |core| core.checked().map(|_| self))
    }
}

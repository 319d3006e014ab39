//! The field of a coil with an iron core, by axial multipoles.

use nalgebra::Vector3;

use super::axisymmetric::{Components, Meridian};
use super::multipole::{MOST_DEGREES, of_coefficients};
use super::quantities::{MULTIPOLE, REACH};
use crate::constants::VACUUM_PERMEABILITY;
use crate::error::Error;

/// An iron core that no other source magnetises, by what it and its winding make together of one ampere: axial multipoles about
/// the coil's centre, as they are fitted to a measured or computed field.
///
/// On the axis at the distance `r` the field is the sum of `multipoles[l - 1] / r^(l + 2)` over the degrees `l`; on the other side of the
/// centre even degrees change their sign. The iron is linear: twice the current makes twice the field.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct IronCore {
    /// Radius of the sphere about the coil's centre outside which the series holds, m.
    pub reach: f64,
    /// Coefficients of the degrees 1 (the dipole), 2, ..., T m^(l + 2) / A; 0 where a degree is missing.
    pub multipoles: [f64; IronCore::MOST_DEGREES],
}

impl IronCore {
    /// Largest degree of the multipoles.
    pub const MOST_DEGREES: usize = MOST_DEGREES;

    /// The core with these coefficients of the degrees 1, 2, ....
    ///
    /// ```
    /// use mcm::magnetics::IronCore;
    /// assert_eq!(IronCore::new(0.05, &[2e-7, 0.0, 1e-10])?.multipoles[2], 1e-10);
    /// assert!(IronCore::new(0.05, &[0.0]).is_err()); // no field
    /// # Ok::<(), mcm::error::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Range`] for a reach that is not positive or a coefficient that is not finite, [`Error::Count`] for too many
    /// coefficients, [`Error::Unsupported`] where all are 0.
    pub fn new(reach: f64, coefficients: &[f64]) -> Result<Self, Error> {
        if coefficients.len() > MOST_DEGREES {
            return Err(Error::Count {
                quantity: "list of a coil's multipoles".into(),
                given: coefficients.len(),
                expected: format!("at most {MOST_DEGREES}"),
            });
        }
        let mut multipoles = [0.0; MOST_DEGREES];
        multipoles[..coefficients.len()].copy_from_slice(coefficients);
        Self { reach, multipoles }.checked()
    }

    /// Checks the numbers.
    pub(super) fn checked(self) -> Result<Self, Error> {
        REACH.check(self.reach)?;
        for coefficient in self.multipoles {
            MULTIPOLE.check(coefficient)?;
        }
        if self.multipoles.iter().all(|coefficient| *coefficient == 0.0) {
            return Err(Error::Unsupported(
                "a coil with an iron core needs a multipole that is not 0".into(),
            ));
        }
        Ok(self)
    }

    /// Magnetic moment along the axis, A m2, of one ampere.
    pub(super) fn moment(&self) -> f64 {
        2.0 * core::f64::consts::PI * self.multipoles[0] / VACUUM_PERMEABILITY
    }

    /// The components of the field of one ampere at a point.
    pub(super) fn components<const ORDER: u8>(
        &self,
        point: &Vector3<f64>,
    ) -> Result<(Meridian, Components), Error> {
        let r2 = point.norm_squared();
        if !(r2 >= self.reach * self.reach && r2 <= 1e18) {
            let allowed = format!(">= {} and <= 1e9, where the series holds", self.reach);
            return Err(Error::range("distance from the centre of a coil with iron (m)", r2.sqrt(), allowed));
        }
        let at = Meridian::of(point.x, point.y);
        Ok((at, of_coefficients::<ORDER>(&self.multipoles, point.z, r2)))
    }
}

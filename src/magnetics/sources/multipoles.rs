//! A coil whose field is known by a table of axial multipoles, as one with an iron core.

use core::f64::consts::PI;
use core::fmt;

use nalgebra::{Matrix3, Vector3};

use super::coil::Coil;
use super::mutual::{Sum, around, directions};
use super::part::Part;
use super::source::{Drive, FieldSource, Source};
use crate::constants::VACUUM_PERMEABILITY;
use crate::error::Error;
use crate::geometry::Pose;
use crate::magnetics::axisymmetric::{Components, Meridian};
use crate::magnetics::edge::{FIELD, GRADIENT, HESSIAN};
use crate::magnetics::jet::Jet;
use crate::magnetics::multipole::{MOST_DEGREES, of_coefficients};
use crate::magnetics::overlap::Outline;
use crate::magnetics::quantities::{MULTIPOLE, REACH};
use crate::magnetics::wrench::{Wrench, refined};
use crate::numerics::quadrature::gauss_legendre;

/// By how much the sphere on which the stress is taken is larger than that of the multipoles.
const OUTSIDE: f64 = 1.0 + 1e-9;

/// What a coil and its iron core, which no other source magnetises, make together of one ampere: axial multipoles about the coil's
/// centre, as they are fitted to a measured or computed field.
///
/// On the axis at the distance `r` the field is the sum of `multipoles[l - 1] / r^(l + 2)` over the degrees `l`; on the other side of the
/// centre even degrees change their sign. The iron is linear: twice the current makes twice the field.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MultipoleTable {
    /// Radius of the sphere about the coil's centre outside which the series holds, m.
    pub reach: f64,
    /// Coefficients of the degrees 1 (the dipole), 2, ..., T m^(l + 2) / A; 0 where a degree is missing.
    pub multipoles: [f64; MultipoleTable::MOST_DEGREES],
}

impl MultipoleTable {
    /// Largest degree of the multipoles.
    pub const MOST_DEGREES: usize = MOST_DEGREES;

    /// The table with these coefficients of the degrees 1, 2, ....
    ///
    /// ```
    /// use mcm::magnetics::MultipoleTable;
    /// assert_eq!(MultipoleTable::new(0.05, &[2e-7, 0.0, 1e-10])?.multipoles[2], 1e-10);
    /// assert!(MultipoleTable::new(0.05, &[0.0]).is_err()); // no field
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
    fn checked(self) -> Result<Self, Error> {
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
    fn moment(&self) -> f64 {
        2.0 * PI * self.multipoles[0] / VACUUM_PERMEABILITY
    }

    /// The components of the field of one ampere at a point.
    fn components<const ORDER: u8>(&self, point: &Vector3<f64>) -> Result<(Meridian, Components), Error> {
        let r2 = point.norm_squared();
        if !(r2 >= self.reach * self.reach && r2 <= 1e18) {
            let allowed = format!(">= {} and <= 1e9, where the series holds", self.reach);
            return Err(Error::range("distance from the centre of a coil with iron (m)", r2.sqrt(), allowed));
        }
        let at = Meridian::of(point.x, point.y);
        Ok((at, of_coefficients::<ORDER>(&self.multipoles, point.z, r2)))
    }
}

/// A coil with the field of a table; core and winding are one body, and no part of the device may come into the sphere in which
/// the multipoles say nothing.
#[derive(Debug, Clone, PartialEq)]
pub struct MultipoleCoil {
    made_from: (Coil, MultipoleTable),
    parts: [Part; 1],
}

impl MultipoleCoil {
    /// The field source of a coil with these multipoles; its number of turns is a remark.
    ///
    /// # Errors
    /// [`Error::Range`] naming the first dimension out of range; as [`MultipoleTable::new`].
    pub fn new(coil: Coil, table: MultipoleTable) -> Result<Self, Error> {
        let (coil, table) = (coil.checked()?, table.checked()?);
        let outline = Outline::cylinder(0.0, coil.outer_radius, coil.length);
        let part = Part::winding(outline, &(Vector3::z() * table.moment()));
        Ok(Self { made_from: (coil, table), parts: [part] })
    }

    fn table(&self) -> &MultipoleTable {
        &self.made_from.1
    }
}

impl FieldSource for MultipoleCoil {
    fn drive(&self) -> Drive {
        Drive::Current
    }

    fn fields(&self, points: &[Vector3<f64>], out: &mut [Vector3<f64>]) -> Result<(), Error> {
        for (point, out) in points.iter().zip(out) {
            let (at, components) = self.table().components::<FIELD>(point)?;
            *out = components.field(&at);
        }
        Ok(())
    }

    fn gradients(
        &self,
        points: &[Vector3<f64>],
        out: &mut [(Vector3<f64>, Matrix3<f64>)],
    ) -> Result<(), Error> {
        for (point, out) in points.iter().zip(out) {
            let (at, components) = self.table().components::<GRADIENT>(point)?;
            *out = (components.field(&at), components.gradient(&at));
        }
        Ok(())
    }

    fn jets(&self, points: &[Vector3<f64>], out: &mut [Jet]) -> Result<(), Error> {
        for (point, out) in points.iter().zip(out) {
            let (at, components) = self.table().components::<HESSIAN>(point)?;
            *out = components.jet(&at);
        }
        Ok(())
    }

    fn contains_any(&self, points: &[Vector3<f64>]) -> bool {
        let reach = self.table().reach;
        points.iter().any(|point| point.norm_squared() < reach * reach)
    }

    fn distance(&self, point: &Vector3<f64>) -> f64 {
        (point.norm() - self.table().reach).max(0.0)
    }

    fn unknown_within(&self) -> f64 {
        self.table().reach
    }

    fn parts(&self) -> &[Part] {
        &self.parts
    }

    fn moment(&self) -> Vector3<f64> {
        Vector3::z() * self.table().moment()
    }

    fn is_axisymmetric(&self) -> bool {
        true
    }

    /// The Maxwell stress on the sphere outside which the field is known.
    fn wrench_in(&self, other: &Source, pose: &Pose, accuracy: f64) -> Result<Wrench, Error> {
        let radius = self.table().reach * OUTSIDE;

        let by = |(_, around): (usize, usize)| {
            let (heights, shares) = gauss_legendre(around / 2);
            let mut sum = Sum::NONE;
            for (height, share) in heights.iter().zip(&shares) {
                let across = (1.0 - height * height).sqrt();
                for (sine, cosine) in directions(around) {
                    let local = Vector3::new(across * cosine, across * sine, *height);
                    let normal = pose.rotation * local;
                    let (at, components) = self.table().components::<FIELD>(&(local * radius))?;
                    let (arm, own) = (normal * radius, pose.rotation * components.field(&at));
                    let field = other.field(&(pose.position + arm))?;
                    let stress =
                        own * field.dot(&normal) + field * own.dot(&normal) - normal * own.dot(&field);
                    let area = radius * radius * share * 2.0 * PI / around as f64;
                    sum.add(&arm, &(stress * (area / VACUUM_PERMEABILITY)));
                }
            }
            Ok(sum.wrench_and_size())
        };
        refined(around(radius, other, pose), radius, accuracy, by)
    }

    fn identity(&self) -> &dyn fmt::Debug {
        &self.made_from
    }
}

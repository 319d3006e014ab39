//! All settings of the comparison methods.

use super::method::Method;
use crate::error::{Error, check};

/// Solution method, and the resolution and limits of the comparison methods.
///
/// The settings of the potential method are [`crate::equilibrium::Settings`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// Solution method; default [`Method::Potential`].
    pub method: Method,
    /// Runge-Kutta steps per core (or per element of a plain cylinder), 1 to 10000; default 16. A disc takes a quarter as many.
    pub steps: usize,
    /// Gauss points per collocation interval, 1 to 8; default 3. The order at the mesh points is twice that.
    pub stages: usize,
    /// Initial number of collocation intervals per core, 1 to 1000; default 2. A disc has one.
    pub intervals: usize,
    /// Tolerance of the residual of the differential equations between the collocation points; default 1e-3.
    ///
    /// An interval with a larger residual is divided. Relative to one unit (moment over bending stiffness: a curvature of one
    /// radian per element).
    pub mesh_tolerance: f64,
    /// Residual norm at which a shape counts as solved; default 1e-9.
    ///
    /// In element lengths, radians, and the wrench that bends an element by one radian.
    pub tolerance: f64,
    /// Largest number of iterations of one attempt; default 100.
    pub iterations: u32,
    /// Smallest fraction of an input change tried when the whole change does not converge; default 1/64.
    ///
    /// One means that only the whole change is tried.
    pub smallest_part: f64,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            method: Method::Potential,
            steps: 16,
            stages: 3,
            intervals: 2,
            mesh_tolerance: 1e-3,
            tolerance: 1e-9,
            iterations: 100,
            smallest_part: 1.0 / 64.0,
        }
    }
}

impl Settings {
    /// The settings, after a check of their ranges.
    ///
    /// # Errors
    /// [`Error::Range`] naming the first setting out of range.
    pub fn checked(self) -> Result<Self, Error> {
        let count = |name: &str, value: usize, most: f64, allowed: &str| {
            check(name, value as f64, |v| (1.0..=most).contains(&v), allowed)
        };
        count("Runge-Kutta steps of a core", self.steps, 1e4, "from 1 to 10000")?;
        count("Gauss points of an interval", self.stages, 8.0, "from 1 to 8")?;
        count("collocation intervals of a core", self.intervals, 1e3, "from 1 to 1000")?;
        check("residual of the mesh", self.mesh_tolerance, |v| v > 0.0, "> 0")?;
        check(
            "tolerance of the methods",
            self.tolerance,
            |v| (1e-14..0.1).contains(&v),
            "from 1e-14 to 0.1",
        )?;
        check("iterations of the methods", f64::from(self.iterations), |v| v >= 1.0, ">= 1")?;
        check("smallest part of an input change", self.smallest_part, |v| v > 0.0 && v <= 1.0, "in (0, 1]")?;
        Ok(self)
    }
}

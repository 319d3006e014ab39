//! All knobs of the methods, in one place.

use super::method::Method;
use crate::error::{Error, check};

/// Which method, and the resolution and limits of those beside the potential one, whose settings are
/// [`crate::equilibrium::Settings`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// How the equilibrium is found; default [`Method::Potential`].
    pub method: Method,
    /// Runge-Kutta steps of a core (or of one element of a plain cylinder), 1 to 10000; default 16. A disc takes a
    /// quarter as many.
    pub steps: usize,
    /// Gauss points of a collocation interval, 1 to 8; default 3. The order at the mesh points is twice that.
    pub stages: usize,
    /// Collocation intervals of a core at the start, 1 to 1000; default 2. A disc has one.
    pub intervals: usize,
    /// Residual of the differential equations between the collocation points at which an interval is not divided
    /// further, relative to one unit (moment over bending stiffness: a curvature of one radian per element); default
    /// 1e-3.
    pub mesh_tolerance: f64,
    /// Norm of the residual at which a shape is solved, in element lengths, radians, and the wrench that bends an element
    /// by a radian; default 1e-9.
    pub tolerance: f64,
    /// Iterations at most of one attempt; default 100.
    pub iterations: u32,
    /// Smallest part of an input change that is tried when the whole does not converge; default 1/64. One means that
    /// only the whole change is tried.
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
    /// The same, checked.
    ///
    /// # Errors
    /// [`Error::Range`] naming the first knob out of range.
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

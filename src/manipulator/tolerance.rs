//! How far the tip may be from the converged answer of its model.

use crate::equilibrium::{Settings, TipDeviation};
use crate::error::Error;

/// Smallest tolerance of the position that follows from the relative one, m: at a device that hardly moves, residuals and quadratures
/// leave a few nanometres.
const LEAST: f64 = 1e-8;

/// Tolerances of the tip, compared with the converged solution of the model.
///
/// ```
/// use mcm::manipulator::{Scene, TipTolerance};
/// let scene = Scene::parse("[design]\nsegments = 1\n[field]\nuniform_mt = [0, 1, 0]", "example")?;
/// let mut manipulator = scene.manipulator(2)?;
/// manipulator.set_tolerance(TipTolerance { position: 1e-6, angle: 1e-4, relative: 0.0 })?;
/// assert!(manipulator.solve(&scene.inputs)?.error_estimate <= 1e-6);
/// # Ok::<(), mcm::error::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TipTolerance {
    /// Distance of the tip, m, above 0.
    pub position: f64,
    /// Rotation of the tip, rad, above 0.
    pub angle: f64,
    /// Distance of the tip relative to its distance from its unloaded place, from 0 to 1; 0: the position alone counts.
    pub relative: f64,
}

impl TipTolerance {
    /// Those of the settings.
    #[must_use]
    pub fn of(settings: &Settings) -> Self {
        Self {
            position: settings.tolerance_position,
            angle: settings.tolerance_angle,
            relative: settings.tolerance_relative,
        }
    }

    /// Checks all three.
    ///
    /// # Errors
    /// [`Error::Range`] naming the first that is out of its range.
    pub fn checked(self) -> Result<Self, Error> {
        let Self { position, angle, relative } = self;
        let settings = Settings {
            tolerance_position: position,
            tolerance_angle: angle,
            tolerance_relative: relative,
            ..Settings::default()
        };
        settings.checked().map(|_| self)
    }

    /// What is allowed for a tip so far (m) from its unloaded place.
    pub(super) fn after(&self, travel: f64) -> TipDeviation {
        let relative = if self.relative > 0.0 { (self.relative * travel).max(LEAST) } else { f64::INFINITY };
        TipDeviation { distance: self.position.min(relative), angle: self.angle }
    }
}

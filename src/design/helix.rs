//! Geometry of the magnetic soft helix: a core cylinder with a spiral, between two closed and ground ends.

use core::f64::consts::PI;

use super::area::annulus_area;
use super::checks;
use super::quantities::HELIX_WINDING_HEIGHT;
use super::specification::Helix;
use crate::error::{Error, check};

/// Geometry derived from a helix's length, boundary angle, radius and windings.
///
/// ```text
/// p = R Theta / W      h = (L - W p) / (2 + W)      phi = 2 pi h / (h + p)
/// ```
///
/// Source: Richter et al., Eq. (1) to (3); the choice `h = z_u(phi) - h` gives Eq. (2), the printed
/// `w = z_u(phi) - h` does not.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HelixGeometry {
    /// Angle `theta = Theta / W` by which one winding can bend, rad.
    pub winding_angle: f64,
    /// Pitch `p`: gap between adjacent windings, m.
    pub pitch: f64,
    /// Height `h` of a winding and of each closed end, m.
    pub height: f64,
    /// Sector angle `phi` of the spiral in a cross-section, rad.
    pub sector_angle: f64,
    /// Length `L - 2 h` of the core between the closed ends, m.
    pub core_length: f64,
}

/// How the volume of the spiral is computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum SpiralVolume {
    /// The spiral's volume, `pi W h (R^2 - r_oc^2)`.
    #[default]
    Exact,
    /// Eq. (8) as printed, which takes the outer radius as the arc's radius: 3.5 % too large for Table 1.
    Printed,
}

/// Volumes of the parts of one helix (Eq. 7), m3.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HelixVolumes {
    /// Core cylinder `V_cyl`.
    pub core: f64,
    /// Both closed ends `V_end`.
    pub ends: f64,
    /// Spiral `V_spi`.
    pub spiral: f64,
}

impl HelixVolumes {
    /// `V_mpc = V_cyl + V_end + V_spi` (Eq. 7), m3.
    #[must_use]
    pub fn total(&self) -> f64 {
        self.core + self.ends + self.spiral
    }
}

impl Helix {
    /// Derived geometry (Eq. 1 to 3).
    ///
    /// ```
    /// use mcm::design::Helix;
    /// let geometry = Helix::paper().geometry()?;
    /// assert!((geometry.height - 0.6509e-3).abs() < 1e-7);
    /// let short = Helix { length: 1.0e-3, ..Helix::paper() };
    /// assert!(short.geometry().is_err()); // no room for two windings with their pitch
    /// # Ok::<(), mcm::error::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Range`] naming the first quantity out of range; the height `h` must be positive.
    pub fn geometry(&self) -> Result<HelixGeometry, Error> {
        checks::helix_dimensions(self)?;
        let winding_angle = self.boundary_angle / self.windings;
        let pitch = self.radius * winding_angle;
        let height = check(
            HELIX_WINDING_HEIGHT.name,
            (self.length - self.windings * pitch) / (2.0 + self.windings),
            |h| h > 0.0,
            "> 0: the helix length must exceed radius times boundary angle",
        )
        .map_err(|error| error.of(&HELIX_WINDING_HEIGHT))?;
        Ok(HelixGeometry {
            winding_angle,
            pitch,
            height,
            sector_angle: 2.0 * PI * height / (height + pitch),
            core_length: self.length - 2.0 * height,
        })
    }

    /// Volumes of core, ends and spiral (Eq. 7, 8), m3.
    ///
    /// # Errors
    /// As [`Helix::geometry`].
    pub fn volumes(&self, spiral: SpiralVolume) -> Result<HelixVolumes, Error> {
        let HelixGeometry { pitch, height, sector_angle, core_length, .. } = self.geometry()?;
        let spiral = match spiral {
            SpiralVolume::Exact => self.windings * height * annulus_area(self.core_outer_radius, self.radius),
            SpiralVolume::Printed => {
                let width = self.radius - self.core_outer_radius;
                let arc = self.radius.hypot((height + pitch) / (2.0 * PI));
                width * height * arc * (2.0 * PI * self.windings - sector_angle)
            }
        };
        Ok(HelixVolumes {
            core: annulus_area(self.core_inner_radius, self.core_outer_radius) * core_length,
            ends: 2.0 * annulus_area(self.core_inner_radius, self.radius) * height,
            spiral,
        })
    }
}

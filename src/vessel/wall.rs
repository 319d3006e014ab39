//! The wall: how a compliant lining answers to a body that is pressed into it.

use core::f64::consts::SQRT_2;

use super::friction;
use super::quantities::WALL_MODULUS;
use crate::error::Error;
use crate::numerics::onset::onset;

/// Poisson's ratio of the wall: soft tissue and silicone keep their volume.
const POISSON: f64 = 0.5;

/// Depth over which contact sets in times the wall's modulus, N/m: a line load far below any that matters here.
const ONSET: f64 = 0.1;

/// A compliant wall, by default without friction. A rigid one is the limit of a large modulus.
///
/// A body in line contact is pushed back by `k` per length and depth. With `k = E*/sqrt(2)`, `E* = E/(1 - nu^2)`, the force of
/// an isolated contact between a rod and a wall of relative radius of curvature `R` is that of Hertz,
/// `4/3 E* sqrt(R) depth^(3/2)`: its indentation profile is a parabola along the arc. Where a rim or a tip touches in a point,
/// the force is that of Hertz for a ball of its radius.
///
/// Both laws set in within a depth of `0.1 N/m` over the modulus (0.1 um at 1e6 Pa), so that their energies have four continuous
/// derivatives; they are exactly zero without contact.
///
/// H. Hertz, J. reine angew. Math. 92 (1882) 156, doi:10.1515/crll.1882.92.156.
///
/// ```
/// use mcm::vessel::Wall;
/// let silicone = Wall::new(1.7e6)?;
/// let [_, force, _] = silicone.ball(2e-3, 76e-6); // a ball of 2 mm, 76 um deep
/// assert!((force - 0.09).abs() < 1e-3);
/// assert_eq!(silicone.ball(2e-3, -1e-6), [0.0; 3]);
/// # Ok::<(), mcm::error::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wall {
    modulus: f64,
    friction: f64,
}

impl Wall {
    /// A wall with this Young's modulus, Pa.
    ///
    /// # Errors
    /// [`Error::Range`] unless it is from 1e3 to 1e12 Pa.
    pub fn new(modulus: f64) -> Result<Self, Error> {
        let modulus = WALL_MODULUS.check(modulus)?;
        Ok(Self { modulus, friction: 0.0 })
    }

    /// This wall with this coefficient of Coulomb friction.
    ///
    /// ```
    /// use mcm::vessel::Wall;
    /// let dry = Wall::new(1e6)?.with_friction(1.0)?;
    /// assert_eq!(dry.friction(), 1.0);
    /// assert!(dry.with_friction(-0.1).is_err());
    /// # Ok::<(), mcm::error::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Range`] unless it is from 0 to 10.
    pub fn with_friction(self, coefficient: f64) -> Result<Self, Error> {
        Ok(Self { friction: friction::checked(coefficient)?, ..self })
    }

    /// Coefficient of Coulomb friction.
    #[must_use]
    pub fn friction(&self) -> f64 {
        self.friction
    }

    /// Young's modulus, Pa.
    #[must_use]
    pub fn modulus(&self) -> f64 {
        self.modulus
    }

    /// This wall with its modulus divided by `exp(softening)`.
    #[must_use]
    pub fn softened(self, softening: f64) -> Self {
        Self { modulus: self.modulus * (-softening).exp(), ..self }
    }

    /// Plane-strain modulus `E*`, Pa.
    fn plane_modulus(self) -> f64 {
        self.modulus / (1.0 - POISSON * POISSON)
    }

    /// Depth at which contact has set in, m.
    #[must_use]
    pub fn onset(&self) -> f64 {
        ONSET / self.modulus
    }

    /// The ramp that replaces the depth, with its integral and slope.
    fn ramp(self, depth: f64) -> Option<[f64; 3]> {
        let half = 0.5 * self.onset();
        onset(depth - half, half)
    }

    /// Energy (J/m), force (N/m) and stiffness (N/m2) per length of a rod this deep (m) in the wall.
    #[must_use]
    pub fn line(&self, depth: f64) -> [f64; 3] {
        let stiffness = self.plane_modulus() / SQRT_2;
        self.ramp(depth).map_or([0.0; 3], |ramp| ramp.map(|value| stiffness * value))
    }

    /// Energy (J), force (N) and stiffness (N/m) of a ball of this radius (m) this deep (m) in the wall.
    #[must_use]
    pub fn ball(&self, radius: f64, depth: f64) -> [f64; 3] {
        let Some([integral, ramp, slope]) = self.ramp(depth) else { return [0.0; 3] };
        // The energy is (2 P)^(5/4) times a constant, with the ramp's integral P: x^(5/2) for a ramp x.
        let root = (2.0 * integral).powf(0.25);
        let factor = 4.0 / 3.0 * self.plane_modulus() * radius.sqrt();
        if root == 0.0 {
            return [0.0; 3]; // underflow
        }
        [
            factor * 0.8 * integral * root,
            factor * root * ramp,
            factor * (0.5 * ramp * ramp * root / (2.0 * integral) + root * slope),
        ]
    }
}

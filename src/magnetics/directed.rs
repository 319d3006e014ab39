//! A rigid magnet that is not magnetised along its axis, or a ball, as the source of the field in which other magnets are.

use nalgebra::{Matrix3, Vector3};

use super::jet::Jet;
use super::sources::{FieldSource, ObliqueCylinder, Sphere};
use crate::error::Error;

/// A magnet of any shape and direction that a device may have, but a ring magnetised along its axis, whose field costs less
/// ([`super::AxialSource`]).
#[derive(Debug, Clone, PartialEq)]
pub enum DirectedMagnet {
    /// A cylinder or ring.
    Cylinder(ObliqueCylinder),
    /// A ball.
    Ball(Sphere),
}

impl DirectedMagnet {
    /// A cylinder or ring of the inner (0: solid) and outer radius and the length (m) with a remanence (T) in its frame.
    ///
    /// # Errors
    /// As [`ObliqueCylinder::new`].
    pub fn cylinder(radii: [f64; 2], length: f64, remanence: Vector3<f64>) -> Result<Self, Error> {
        Ok(Self::Cylinder(ObliqueCylinder::new(radii, length, remanence)?))
    }

    /// A ball of this radius (m) with a remanence (T) in its frame.
    ///
    /// # Errors
    /// As [`Sphere::new`].
    pub fn ball(radius: f64, remanence: Vector3<f64>) -> Result<Self, Error> {
        Ok(Self::Ball(Sphere::new(radius, remanence)?))
    }

    fn source(&self) -> &dyn FieldSource {
        match self {
            Self::Cylinder(cylinder) => cylinder,
            Self::Ball(ball) => ball,
        }
    }

    /// Whether a point in its frame is inside.
    #[must_use]
    pub fn contains(&self, point: &Vector3<f64>) -> bool {
        self.source().contains_any(core::slice::from_ref(point))
    }

    /// `B` (T) and its gradient (T/m) at a point in its frame.
    ///
    /// # Errors
    /// As [`FieldSource::gradients`].
    pub fn field_gradient(&self, point: &Vector3<f64>) -> Result<(Vector3<f64>, Matrix3<f64>), Error> {
        let mut out = [(Vector3::zeros(), Matrix3::zeros())];
        self.source().gradients(core::slice::from_ref(point), &mut out)?;
        Ok(out[0])
    }

    /// `B` and its first two derivatives at a point in its frame.
    ///
    /// # Errors
    /// As [`FieldSource::jets`].
    pub fn jet(&self, point: &Vector3<f64>) -> Result<Jet, Error> {
        let mut out = [Jet::zero()];
        self.source().jets(core::slice::from_ref(point), &mut out)?;
        let [jet] = out;
        Ok(jet)
    }

    /// The scalar potential (T m) at a point outside in its frame: `B` is minus its gradient.
    ///
    /// # Errors
    /// As [`DirectedMagnet::field_gradient`].
    pub fn potential(&self, point: &Vector3<f64>) -> Result<f64, Error> {
        match self {
            Self::Cylinder(cylinder) => cylinder.potential(point),
            Self::Ball(ball) => Ok(ball.potential(point)),
        }
    }
}

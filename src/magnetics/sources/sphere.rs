//! A sphere magnetised in any direction.

use core::fmt;

use nalgebra::{Matrix3, Vector3};

use super::part::Part;
use super::shape::Shape;
use super::source::{Drive, FieldSource, Source};
use crate::constants::VACUUM_PERMEABILITY;
use crate::error::Error;
use crate::geometry::Pose;
use crate::magnetics::axial_source::{FARTHEST, refused};
use crate::magnetics::dipole::Dipole;
use crate::magnetics::jet::{FieldHessian, Jet};
use crate::magnetics::overlap::Outline;
use crate::magnetics::quantities::{DIRECTED_REMANENCE, RADIUS};
use crate::magnetics::wrench::Wrench;

/// The shape of a sphere.
pub(super) static SHAPE: Shape = Shape {
    name: "sphere",
    description: "A ball",
    dimensions: &[&RADIUS],
    make: |radii, remanence| Ok(Sphere::new(radii[0], remanence)?.into()),
};

/// A sphere centred at the origin of its frame with a remanence in any direction: outside it is exactly a dipole, inside the field is two
/// thirds of the remanence. On the surface it has the values outside.
///
/// ```
/// use mcm::magnetics::{Source, Sphere};
/// use nalgebra::Vector3;
/// let ball = Source::from(Sphere::new(5e-3, Vector3::new(0.0, 0.0, 1.2))?);
/// assert!((ball.field(&Vector3::zeros())?.z - 0.8).abs() < 1e-15);
/// assert!((ball.field(&Vector3::new(0.0, 0.0, 10e-3))?.z - 0.1).abs() < 1e-15); // 2/3 B_r (R/r)^3
/// # Ok::<(), mcm::error::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Sphere {
    radius: f64,
    remanence: Vector3<f64>,
    dipole: Dipole,
    parts: [Part; 1],
    identity: (&'static str, f64, [f64; 3]),
}

impl Sphere {
    /// A sphere of this radius (m) and remanence (T).
    ///
    /// # Errors
    /// [`Error::Range`] naming the first quantity out of range.
    pub fn new(radius: f64, remanence: Vector3<f64>) -> Result<Self, Error> {
        RADIUS.check(radius)?;
        DIRECTED_REMANENCE.check(remanence.norm())?;
        let part = Part { outline: Outline::Sphere(radius), centre: Vector3::zeros(), remanence };
        let dipole = Dipole::new(remanence * (part.outline.volume() / VACUUM_PERMEABILITY))?;
        let identity = ("sphere", radius, remanence.into());
        Ok(Self { radius, remanence, dipole, parts: [part], identity })
    }

    /// What `outside` makes of the dipole at each point, and inside `uniform`.
    fn each<T: Clone>(
        &self,
        points: &[Vector3<f64>],
        out: &mut [T],
        uniform: &T,
        outside: impl Fn(&Vector3<f64>) -> Result<T, Error>,
    ) -> Result<(), Error> {
        for (point, out) in points.iter().zip(out) {
            if !point.iter().all(|coordinate| coordinate.abs() <= FARTHEST) {
                return Err(refused(point));
            }
            *out = if self.contains(point) { uniform.clone() } else { outside(point)? };
        }
        Ok(())
    }

    /// The scalar potential (T m) at a point (m) outside: `B` is minus its gradient.
    pub(in crate::magnetics) fn potential(&self, point: &Vector3<f64>) -> f64 {
        VACUUM_PERMEABILITY / (4.0 * core::f64::consts::PI) * self.dipole.moment().dot(point)
            / point.norm().powi(3)
    }

    fn contains(&self, point: &Vector3<f64>) -> bool {
        point.norm_squared() < self.radius * self.radius
    }

    /// The field inside, T.
    fn inside(&self) -> Vector3<f64> {
        self.remanence * (2.0 / 3.0)
    }
}

impl FieldSource for Sphere {
    fn drive(&self) -> Drive {
        Drive::Factor
    }

    fn fields(&self, points: &[Vector3<f64>], out: &mut [Vector3<f64>]) -> Result<(), Error> {
        self.each(points, out, &self.inside(), |point| self.dipole.field(point))
    }

    fn gradients(
        &self,
        points: &[Vector3<f64>],
        out: &mut [(Vector3<f64>, Matrix3<f64>)],
    ) -> Result<(), Error> {
        self.each(points, out, &(self.inside(), Matrix3::zeros()), |point| self.dipole.field_gradient(point))
    }

    fn jets(&self, points: &[Vector3<f64>], out: &mut [Jet]) -> Result<(), Error> {
        let inside =
            Jet { field: self.inside(), gradient: Matrix3::zeros(), hessian: FieldHessian::default() };
        self.each(points, out, &inside, |point| self.dipole.jet(point))
    }

    fn contains_any(&self, points: &[Vector3<f64>]) -> bool {
        points.iter().any(|point| self.contains(point))
    }

    fn distance(&self, point: &Vector3<f64>) -> f64 {
        (point.norm() - self.radius).max(0.0)
    }

    fn unknown_within(&self) -> f64 {
        0.0
    }

    fn parts(&self) -> &[Part] {
        &self.parts
    }

    fn moment(&self) -> Vector3<f64> {
        self.dipole.moment()
    }

    fn is_axisymmetric(&self) -> bool {
        self.remanence.xy() == nalgebra::Vector2::zeros()
    }

    /// Exactly that on the dipole at its centre: the mean of a harmonic function over a ball is its value in the middle.
    fn wrench_in(&self, other: &Source, pose: &Pose, _: f64) -> Result<Wrench, Error> {
        let (field, gradient) = other.field_gradient(&pose.position)?;
        let moment = pose.rotation * self.moment();
        Ok(Wrench { force: gradient * moment, torque: moment.cross(&field) })
    }

    fn identity(&self) -> &dyn fmt::Debug {
        &self.identity
    }
}

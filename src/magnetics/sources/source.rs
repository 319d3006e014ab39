//! What every kind of field source says of itself, and a source of any kind.

use core::fmt;
use core::ops::Deref;
use core::slice::from_ref;
use std::sync::Arc;

use nalgebra::{Matrix3, Vector3};

use super::part::Part;
use crate::error::Error;
use crate::geometry::Pose;
use crate::magnetics::axial_source::AxialSource;
use crate::magnetics::jet::Jet;
use crate::magnetics::overlap;
use crate::magnetics::wrench::{Wrench, adaptive, check_accuracy};

/// What the strength of a source is, which also names it in scenes and in the FMU.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Drive {
    /// A factor on the field of a magnet; a magnet of strength 0 is absent.
    Factor,
    /// The current through a coil, A; without one, the coil is still in the way of others.
    Current,
}

impl Drive {
    /// Name of a source driven like this.
    #[must_use]
    pub fn noun(self) -> &'static str {
        match self {
            Self::Factor => "magnet",
            Self::Current => "coil",
        }
    }
}

/// A kind of field source: a rigid body, in its own frame and at unit strength (coils: at one ampere).
///
/// There is nothing to inherit: a kind that leaves out its wrench, its parts or its moment does not compile. The fields are asked for
/// at a batch of points, so that the kind is found once a batch. [`Source`] has the same for a single point.
///
/// A magnetic dipole of 1 A m2 along `z`, 1 mm thick:
///
/// ```
/// use mcm::error::Error;
/// use mcm::geometry::Pose;
/// use mcm::magnetics::{Dipole, Drive, FieldSource, Jet, Outline, Part, Source, Wrench};
/// use nalgebra::{Matrix3, Vector3};
///
/// #[derive(Debug)]
/// struct Needle(Dipole, [Part; 1]);
///
/// impl FieldSource for Needle {
///     fn drive(&self) -> Drive {
///         Drive::Factor
///     }
///     fn fields(&self, points: &[Vector3<f64>], out: &mut [Vector3<f64>]) -> Result<(), Error> {
///         points.iter().zip(out).try_for_each(|(point, out)| Ok(*out = self.0.field(point)?))
///     }
///     fn gradients(
///         &self,
///         points: &[Vector3<f64>],
///         out: &mut [(Vector3<f64>, Matrix3<f64>)],
///     ) -> Result<(), Error> {
///         points.iter().zip(out).try_for_each(|(point, out)| Ok(*out = self.0.field_gradient(point)?))
///     }
///     fn jets(&self, points: &[Vector3<f64>], out: &mut [Jet]) -> Result<(), Error> {
///         points.iter().zip(out).try_for_each(|(point, out)| Ok(*out = self.0.jet(point)?))
///     }
///     fn contains_any(&self, points: &[Vector3<f64>]) -> bool {
///         points.iter().any(|point| self.distance(point) == 0.0)
///     }
///     fn distance(&self, point: &Vector3<f64>) -> f64 {
///         (point.norm() - 0.5e-3).max(0.0)
///     }
///     fn unknown_within(&self) -> f64 {
///         0.0
///     }
///     fn parts(&self) -> &[Part] {
///         &self.1
///     }
///     fn moment(&self) -> Vector3<f64> {
///         self.0.moment()
///     }
///     fn is_axisymmetric(&self) -> bool {
///         true
///     }
///     fn wrench_in(&self, other: &Source, pose: &Pose, _: f64) -> Result<Wrench, Error> {
///         let (field, gradient) = other.field_gradient(&pose.position)?;
///         let moment = pose.rotation * self.moment();
///         Ok(Wrench { force: gradient * moment, torque: moment.cross(&field) })
///     }
///     fn identity(&self) -> &dyn std::fmt::Debug {
///         self
///     }
/// }
///
/// let part = Part { outline: Outline::cylinder(0.0, 0.5e-3, 1e-3), centre: Vector3::zeros(), remanence: Vector3::z() };
/// let needle = Source::from(Needle(Dipole::new(Vector3::z())?, [part]));
/// let wrench = needle.wrench_on_source(&needle, &Pose::identity().advanced(0.1), 1e-3)?;
/// assert!((wrench.force.z / -6e-3 - 1.0).abs() < 1e-12); // -6 mu_0 / (4 pi) m^2 / r^4
/// # Ok::<(), Error>(())
/// ```
pub trait FieldSource: fmt::Debug + Send + Sync {
    /// What its strength is.
    fn drive(&self) -> Drive;

    /// Flux density `B` (T) at points (m), written to `out` in their order.
    ///
    /// # Errors
    /// [`Error::OnEdge`] where the field is singular, [`Error::Range`] where it is not known; `out` is then incomplete.
    fn fields(&self, points: &[Vector3<f64>], out: &mut [Vector3<f64>]) -> Result<(), Error>;

    /// `B` (T) and its gradient `dB_i/dx_j` (T/m) at points (m), written to `out` in their order.
    ///
    /// # Errors
    /// As [`FieldSource::fields`].
    fn gradients(
        &self,
        points: &[Vector3<f64>],
        out: &mut [(Vector3<f64>, Matrix3<f64>)],
    ) -> Result<(), Error>;

    /// `B`, its gradient and its second derivative at points (m), written to `out` in their order.
    ///
    /// # Errors
    /// As [`FieldSource::fields`].
    fn jets(&self, points: &[Vector3<f64>], out: &mut [Jet]) -> Result<(), Error>;

    /// Whether any of the points (m) lies inside the material, or where the field is not known.
    fn contains_any(&self, points: &[Vector3<f64>]) -> bool;

    /// Distance from a point to what contains points, m; 0 inside.
    fn distance(&self, point: &Vector3<f64>) -> f64;

    /// Radius of the sphere about the centre within which the field is not known, m; 0 where it is known everywhere.
    fn unknown_within(&self) -> f64;

    /// The solid parts, which overlap with no part of another body.
    fn parts(&self) -> &[Part];

    /// Magnetic moment, A m2.
    fn moment(&self) -> Vector3<f64>;

    /// Whether body and field are the same in every direction across the frame's `z`.
    fn is_axisymmetric(&self) -> bool;

    /// The wrench on this source, at `pose` in the frame of `other`, in the field of that, both of strength 1; in the axes of that
    /// frame, about this source's origin. `accuracy` is that of [`crate::magnetics::AxialSource::wrench_on`]; the parts are known to be
    /// apart.
    ///
    /// # Errors
    /// [`Error::Range`] for an accuracy that is not attained, and where the other's field is not known.
    fn wrench_in(&self, other: &Source, pose: &Pose, accuracy: f64) -> Result<Wrench, Error>;

    /// All numbers that it is made from, with the name of the kind: what tells it from other sources in snapshots.
    fn identity(&self) -> &dyn fmt::Debug;
}

/// A field source of any kind, shared by its clones. Two are equal where their kinds and all their numbers are.
///
/// ```
/// use mcm::magnetics::{AxialMagnet, Cylinders, Source};
/// use nalgebra::Vector3;
/// let cylinder = AxialMagnet { radius: 5e-3, inner_radius: 0.0, length: 10e-3, offset: 0.0, remanence: 1.3 };
/// let magnet = Source::from(Cylinders::new(vec![cylinder])?);
/// assert!(magnet.field(&Vector3::new(0.0, 0.0, 0.05))?.z > 0.0);
/// assert!(magnet.contains(&Vector3::zeros()) && magnet.distance(&Vector3::x()) == 0.995);
/// # Ok::<(), mcm::error::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Source(Arc<dyn FieldSource>);

impl<S: FieldSource + 'static> From<S> for Source {
    fn from(kind: S) -> Self {
        Self(Arc::new(kind))
    }
}

impl Deref for Source {
    type Target = dyn FieldSource;

    fn deref(&self) -> &Self::Target {
        &*self.0
    }
}

impl PartialEq for Source {
    fn eq(&self, other: &Self) -> bool {
        let identity = |source: &Self| format!("{:?}", source.identity());
        Arc::ptr_eq(&self.0, &other.0) || identity(self) == identity(other)
    }
}

impl Source {
    /// Flux density `B` (T) at a point (m).
    ///
    /// # Errors
    /// As [`FieldSource::fields`].
    pub fn field(&self, point: &Vector3<f64>) -> Result<Vector3<f64>, Error> {
        let mut out = [Vector3::zeros()];
        self.fields(from_ref(point), &mut out)?;
        Ok(out[0])
    }

    /// `B` (T) and its gradient `dB_i/dx_j` (T/m) at a point (m).
    ///
    /// # Errors
    /// As [`FieldSource::fields`].
    pub fn field_gradient(&self, point: &Vector3<f64>) -> Result<(Vector3<f64>, Matrix3<f64>), Error> {
        let mut out = [(Vector3::zeros(), Matrix3::zeros())];
        self.gradients(from_ref(point), &mut out)?;
        Ok(out[0])
    }

    /// `B` (T) and its gradient `dB_i/dx_j` (T/m), in the world frame, at a point (m) of that frame, where the source has this pose.
    ///
    /// # Errors
    /// As [`FieldSource::fields`].
    pub fn field_gradient_from(
        &self,
        pose: &Pose,
        point: &Vector3<f64>,
    ) -> Result<(Vector3<f64>, Matrix3<f64>), Error> {
        let turn = pose.rotation;
        let local = turn.tr_mul(&(point - pose.position));
        let (field, gradient) = self.field_gradient(&local).map_err(|error| error.at((*point).into()))?;
        Ok((turn * field, turn * gradient * turn.transpose()))
    }

    /// `B`, its gradient and its second derivative at a point (m).
    ///
    /// # Errors
    /// As [`FieldSource::fields`].
    pub fn jet(&self, point: &Vector3<f64>) -> Result<Jet, Error> {
        let mut out = [Jet::zero()];
        self.jets(from_ref(point), &mut out)?;
        Ok(out[0])
    }

    /// Whether a point (m) lies inside the material, or where the field is not known.
    #[must_use]
    pub fn contains(&self, point: &Vector3<f64>) -> bool {
        self.contains_any(from_ref(point))
    }

    /// The wrench on `body` at `pose` in the source's frame, in its axes; see [`AxialSource::wrench_on`].
    ///
    /// # Errors
    /// As [`AxialSource::wrench_on`].
    pub fn wrench_on(&self, body: &AxialSource, pose: &Pose, accuracy: f64) -> Result<Wrench, Error> {
        check_accuracy(accuracy)?;
        for part in self.parts() {
            let seen = Pose { position: pose.position - part.centre, ..*pose };
            overlap::check(&part.outline, &body.outline(), &seen)?;
        }
        adaptive(body, pose, accuracy, self.distance(&pose.position), |point| self.field(point))
    }
}

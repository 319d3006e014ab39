//! Pose of a rigid body: position and orientation.

use nalgebra::{Matrix3, Quaternion, Rotation3, UnitQuaternion, Vector3};
use serde::{Deserialize, Serialize};

use super::rotation::{RotationVector, rotation_log};
use crate::error::{Error, check};

/// Position and orientation of a frame, body to world.
///
/// ```
/// use mcm::geometry::Pose;
/// let turned = Pose::new([0.0, 0.0, 0.1], [0.0, 1.0, 0.0, 0.0])?;
/// assert!((turned.axis().z + 1.0).abs() < 1e-15);
/// assert!(Pose::new([0.0; 3], [0.0; 4]).is_err());
/// # Ok::<(), mcm::error::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Pose {
    /// Origin of the frame, m.
    pub position: Vector3<f64>,
    /// Rotation matrix `R`; its columns are the directors `d1`, `d2`, `d3`.
    pub rotation: Matrix3<f64>,
}

impl Pose {
    /// Angle (rad) within which directions count as one: far above rounding, far below what a residual shows.
    const SAME_DIRECTION: f64 = 1e-9;

    /// Largest deviation of a given quaternion's norm from one.
    const NORM_SLACK: f64 = 1e-3;

    /// The identity: a frame at the origin without rotation.
    #[must_use]
    pub fn identity() -> Self {
        Self { position: Vector3::zeros(), rotation: Matrix3::identity() }
    }

    /// Pose from a position (m) and a unit quaternion, scalar first.
    ///
    /// A quaternion within 1e-3 of unit norm is normalised: it describes the same rotation, rounded.
    ///
    /// # Errors
    /// [`crate::error::Error::Range`] if an entry is not finite or the quaternion is not of unit norm.
    pub fn new(position: [f64; 3], orientation_wxyz: [f64; 4]) -> Result<Self, Error> {
        for value in position {
            check("position (m)", value, |_| true, "finite")?;
        }
        for value in orientation_wxyz {
            check("orientation (quaternion)", value, |_| true, "finite")?;
        }
        let [w, x, y, z] = orientation_wxyz;
        let quaternion = Quaternion::new(w, x, y, z);
        check(
            "norm of the orientation quaternion",
            quaternion.norm(),
            |n| (n - 1.0).abs() <= Self::NORM_SLACK,
            "1 within 1e-3",
        )?;
        let rotation = UnitQuaternion::from_quaternion(quaternion).to_rotation_matrix().into_inner();
        Ok(Self { position: position.into(), rotation })
    }

    /// The frame's third director `d3`: a rod's tangent, a magnet's axis.
    #[must_use]
    pub fn axis(&self) -> Vector3<f64> {
        self.rotation.column(2).into()
    }

    /// Whether a vector is zero or points along the axis, or against it, within 1e-9 rad.
    #[must_use]
    pub fn is_along_axis(&self, vector: &Vector3<f64>) -> bool {
        self.axis().cross(vector).norm() <= Self::SAME_DIRECTION * vector.norm()
    }

    /// Whether a point (m) lies on the line of the axis, within 1e-9 of its distance from the frame's origin.
    #[must_use]
    pub fn is_on_axis(&self, point: &Vector3<f64>) -> bool {
        self.is_along_axis(&(point - self.position))
    }

    /// The unit quaternion (w, x, y, z) with `w >= 0`.
    #[must_use]
    pub fn quaternion(&self) -> [f64; 4] {
        let q = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(self.rotation));
        let sign = if q.w < 0.0 { -1.0 } else { 1.0 };
        [sign * q.w, sign * q.i, sign * q.j, sign * q.k]
    }

    /// Angular velocity (rad, fixed axes) of the orientation of a quaternion that changes at the given rate.
    ///
    /// It is `2 rate q* / |q|^2`, both arguments scalar first; the part of `rate` along `q` causes no rotation.
    ///
    /// ```
    /// use mcm::geometry::Pose;
    /// let spin = Pose::rotation_rate([1.0, 0.0, 0.0, 0.0], [0.0, 0.0, 0.5, 0.0]);
    /// assert_eq!(spin.as_slice(), [0.0, 1.0, 0.0]);
    /// ```
    #[must_use]
    pub fn rotation_rate(orientation_wxyz: [f64; 4], rate: [f64; 4]) -> Vector3<f64> {
        let [w, x, y, z] = orientation_wxyz;
        let q = Quaternion::new(w, x, y, z);
        let [w, x, y, z] = rate;
        (Quaternion::new(w, x, y, z) * q.conjugate()).imag() * (2.0 / q.norm_squared())
    }

    /// The rate of [`Pose::quaternion`] when the frame turns at an angular velocity (rad, fixed axes).
    #[must_use]
    pub fn quaternion_rate(&self, angular_velocity: &Vector3<f64>) -> [f64; 4] {
        let [w, x, y, z] = self.quaternion();
        let rate = Quaternion::from_imag(*angular_velocity) * Quaternion::new(w, x, y, z) * 0.5;
        [rate.w, rate.i, rate.j, rate.k]
    }

    /// The world coordinates of a point given in this frame.
    #[must_use]
    pub fn transform(&self, local: &Vector3<f64>) -> Vector3<f64> {
        self.position + self.rotation * local
    }

    /// World pose of a frame whose pose in this frame is `local`.
    #[must_use]
    pub fn compose(&self, local: &Self) -> Self {
        Self { position: self.transform(&local.position), rotation: self.rotation * local.rotation }
    }

    /// This pose relative to the frame `from`: `from.compose` of the result is this pose.
    #[must_use]
    pub fn seen_from(&self, from: &Self) -> Self {
        let back = from.rotation.transpose();
        Self { position: back * (self.position - from.position), rotation: back * self.rotation }
    }

    /// The frame moved by `distance` (m) along its own axis.
    #[must_use]
    pub fn advanced(&self, distance: f64) -> Self {
        Self { position: self.position + self.axis() * distance, rotation: self.rotation }
    }

    /// The pose at the fraction `t` of the way to `other`, rotated along the shortest arc.
    #[must_use]
    pub fn between(&self, other: &Self, t: f64) -> Self {
        let turn = rotation_log(&self.rotation.tr_mul(&other.rotation)) * t;
        Self {
            position: self.position.lerp(&other.position, t),
            rotation: self.rotation * RotationVector::new(turn).matrix(),
        }
    }
}

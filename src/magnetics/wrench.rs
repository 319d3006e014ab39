//! The wrench that one magnet exerts on another, both rigid and uniformly magnetised along their axes.

use core::f64::consts::PI;

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::axial_source::AxialSource;
use super::overlap;
use crate::constants::VACUUM_PERMEABILITY;
use crate::error::{Error, check};
use crate::geometry::Pose;
use crate::numerics::quadrature::gauss_legendre;

/// Numbers of nodes along the radius and around each face, from coarse to fine.
///
/// The error of a rule with `n` nodes around is about `(s/d)^n` with the body's extent `s` and the distance `d` from
/// its centre to the other magnet (measured on ring pairs 3 to 30 mm apart, within a factor of 20); the number of nodes
/// along the radius preserves that rate.
const RULES: [(usize, usize); 9] =
    [(1, 8), (2, 12), (3, 16), (4, 24), (6, 32), (8, 48), (12, 72), (18, 108), (27, 160)];

/// Finest accuracy that may be requested: below it, rounding errors of the sums are visible.
const FINEST: f64 = 1e-12;

/// Force and torque on a body.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Wrench {
    /// Force, N.
    pub force: Vector3<f64>,
    /// Torque about the body's centre, N m.
    pub torque: Vector3<f64>,
}

impl Wrench {
    /// No force and no torque.
    pub const NONE: Self = Self { force: Vector3::new(0.0, 0.0, 0.0), torque: Vector3::new(0.0, 0.0, 0.0) };
}

impl Wrench {
    /// Wrench of the body at `position` (m) on the source at the origin: the opposite force, and its torque about the
    /// origin.
    ///
    /// It balances this wrench: the magnetic forces and torques between the two bodies add up to zero.
    #[must_use]
    pub fn reaction(&self, position: &Vector3<f64>) -> Self {
        Self { force: -self.force, torque: -(self.torque + position.cross(&self.force)) }
    }
}

impl AxialSource {
    /// The wrench on `body` at `pose` in this magnet's frame, in the axes of that frame.
    ///
    /// The body's magnetisation is equivalent to a magnetic charge `+-B_r / mu_0` on its two faces:
    ///
    /// ```text
    /// F = (B_r / mu_0) [int_+ B dA - int_- B dA]      T = (B_r / mu_0) [int_+ (x - c) x B dA - int_- (x - c) x B dA]
    /// ```
    ///
    /// integrated by Gauss-Legendre quadrature in `rho^2` and the trapezoidal rule in the angle, with as many nodes as
    /// `accuracy` needs at that distance. `accuracy`, from 1e-12 to 0.1, bounds the estimated error of the force
    /// relative to `|F| + |T|/a` and of the torque relative to `|F| a + |T|`, with the body's radius `a`.
    ///
    /// ```
    /// use mcm::geometry::Pose;
    /// use mcm::magnetics::AxialSource;
    /// let ring = AxialSource::new(0.75e-3, 2.0e-3, 1.0e-3, 1.35)?;
    /// let wrench = ring.wrench_on(&ring, &Pose::new([0.0, 0.0, 5.0e-3], [1.0, 0.0, 0.0, 0.0])?, 1e-6)?;
    /// assert!(wrench.force.z < 0.0); // poles in line attract
    /// assert!(ring.wrench_on(&ring, &Pose::new([1.0e-3, 0.0, 0.0], [1.0, 0.0, 0.0, 0.0])?, 1e-6).is_err()); // overlap
    /// # Ok::<(), mcm::error::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Unsupported`] when the bodies overlap; [`Error::Range`] for an accuracy out of range, or one that the
    /// finest rule (8640 nodes) does not attain because the bodies almost touch; [`Error::OnEdge`] when a node meets an
    /// edge.
    pub fn wrench_on(&self, body: &Self, pose: &Pose, accuracy: f64) -> Result<Wrench, Error> {
        check_accuracy(accuracy)?;
        overlap::check(&self.outline(), &body.outline(), pose)?;
        adaptive(body, pose, accuracy, self.distance(&pose.position), |point| self.field(point))
    }
}

pub(super) fn check_accuracy(accuracy: f64) -> Result<f64, Error> {
    check("accuracy of the wrench", accuracy, |v| (FINEST..=0.1).contains(&v), "from 1e-12 to 0.1")
}

/// The wrench by the charges on the faces of `body`, as accurate as asked for.
pub(super) fn adaptive(
    body: &AxialSource,
    pose: &Pose,
    accuracy: f64,
    distance: f64,
    field: impl Fn(&Vector3<f64>) -> Result<Vector3<f64>, Error>,
) -> Result<Wrench, Error> {
    let ratio = body.outer_radius().hypot(0.5 * body.length()) / distance;
    refined(ratio, body.outer_radius(), accuracy, |rule| on_faces(body, pose, rule, &field))
}

/// Refines a rule, from one level below the expected one, until the error estimated from two levels is small enough.
///
/// `ratio` is the body's extent over the distance from its centre to the other one, and `radius` (m) what torques are compared
/// with; `by` gives the wrench by a rule of so many nodes along the radius and around, and the sum of the magnitudes of its
/// terms, N.
pub(super) fn refined(
    ratio: f64,
    radius: f64,
    accuracy: f64,
    by: impl Fn((usize, usize)) -> Result<(Wrench, f64), Error>,
) -> Result<Wrench, Error> {
    let ratio = ratio.clamp(1e-6, 0.75);
    let expected = |&(_, around): &(usize, usize)| ratio.powi(i32::try_from(around).unwrap_or(i32::MAX));
    let enough = RULES.iter().position(|rule| expected(rule) <= accuracy).unwrap_or(RULES.len() - 1);
    let start = enough.saturating_sub(1);
    let (mut coarse, _) = by(RULES[start])?;
    let mut reached = f64::INFINITY;
    for step in RULES[start..].windows(2) {
        let (fine, size) = by(step[1])?;
        // The difference estimates the error of the coarse rule; the fine one's exponent is larger by the ratio of the
        // nodes around.
        let difference = relative_difference(&coarse, &fine, size, radius);
        let gain = step[1].1 as f64 / step[0].1 as f64;
        reached = difference.min(10.0 * difference.powf(gain));
        if reached <= accuracy.max(FINEST) {
            return Ok(fine);
        }
        coarse = fine;
    }
    Err(Error::range("accuracy of the wrench", accuracy, format!(">= {reached:.1e} for bodies this close")))
}

/// Difference of two wrenches relative to the finer one; 0 within the rounding of sums of the magnitude `size`, N.
pub(super) fn relative_difference(coarse: &Wrench, fine: &Wrench, size: f64, radius: f64) -> f64 {
    let scale = fine.force.norm() + fine.torque.norm() / radius;
    let difference = (coarse.force - fine.force).norm().max((coarse.torque - fine.torque).norm() / radius);
    let rounding = 16.0 * f64::EPSILON * size;
    if difference <= rounding { 0.0 } else { difference / scale }
}

/// The wrench by one rule, and the sum of the magnitudes of its terms, N.
fn on_faces(
    body: &AxialSource,
    pose: &Pose,
    (along, around): (usize, usize),
    field: &impl Fn(&Vector3<f64>) -> Result<Vector3<f64>, Error>,
) -> Result<(Wrench, f64), Error> {
    let (nodes, weights) = gauss_legendre(along);
    let (inner2, outer2) = (body.inner_radius().powi(2), body.outer_radius().powi(2));
    let charge = body.remanence() / VACUUM_PERMEABILITY;

    let mut wrench = Wrench { force: Vector3::zeros(), torque: Vector3::zeros() };
    let mut size = 0.0;

    for (node, weight) in nodes.iter().zip(&weights) {
        let rho = (0.5 * (outer2 + inner2) + 0.5 * (outer2 - inner2) * node).sqrt();
        let area = 0.25 * (outer2 - inner2) * weight * 2.0 * PI / around as f64;

        for step in 0..around {
            let (sine, cosine) = (2.0 * PI * (step as f64 + 0.5) / around as f64).sin_cos();
            for side in [-1.0, 1.0] {
                let arm = pose.rotation * Vector3::new(rho * cosine, rho * sine, side * 0.5 * body.length());
                let force = field(&(pose.position + arm))? * (side * charge * area);
                wrench.force += force;
                wrench.torque += arm.cross(&force);
                size += force.norm();
            }
        }
    }

    Ok((wrench, size))
}

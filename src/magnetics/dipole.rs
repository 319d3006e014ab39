//! The point dipole: the far-field limit of every magnet, used for comparison.

use core::f64::consts::PI;

use nalgebra::{Matrix3, Vector3};

use super::jet::{FieldHessian, Jet};
use crate::constants::VACUUM_PERMEABILITY;
use crate::error::{Error, check};

/// A point dipole at the origin.
///
/// With `n = r/|r|`, `w = m.n` and `k = mu_0 / 4 pi`:
///
/// ```text
/// B_i   = k (3 w n_i - m_i) / r^3
/// G_ij  = 3 k / r^4 [m_i n_j + m_j n_i + w d_ij - 5 w n_i n_j]
/// H_ijk = 3 k / r^5 [m_i d_jk + m_j d_ik + m_k d_ij - 5 (m_i n_j n_k + m_j n_i n_k + m_k n_i n_j
///                    + w (d_ij n_k + d_ik n_j + d_jk n_i)) + 35 w n_i n_j n_k]
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dipole {
    moment: Vector3<f64>,
}

impl Dipole {
    /// A dipole of the given moment, A m2.
    ///
    /// # Errors
    /// [`Error::Range`] for a moment that is not finite.
    pub fn new(moment: Vector3<f64>) -> Result<Self, Error> {
        for component in &moment {
            check("dipole moment (A m2)", *component, |_| true, "finite")?;
        }
        Ok(Self { moment })
    }

    /// The moment, A m2.
    #[must_use]
    pub fn moment(&self) -> Vector3<f64> {
        self.moment
    }

    /// Flux density `B` (T) at a point (m).
    ///
    /// # Errors
    /// [`Error::Range`] for a point that is not finite, or closer than 1e-30 m or further than 1e30 m.
    pub fn field(&self, point: &Vector3<f64>) -> Result<Vector3<f64>, Error> {
        let ray = Ray::new(&self.moment, point)?;
        Ok(self.field_on(&ray))
    }

    /// `B` (T) and its gradient `dB_i/dx_j` (T/m) at a point (m).
    ///
    /// # Errors
    /// As [`Dipole::field`].
    pub fn field_gradient(&self, point: &Vector3<f64>) -> Result<(Vector3<f64>, Matrix3<f64>), Error> {
        let ray = Ray::new(&self.moment, point)?;
        Ok((self.field_on(&ray), self.gradient_on(&ray)))
    }

    /// `B`, its gradient and its second derivative at a point (m).
    ///
    /// # Errors
    /// As [`Dipole::field`].
    pub fn jet(&self, point: &Vector3<f64>) -> Result<Jet, Error> {
        let ray = Ray::new(&self.moment, point)?;
        Ok(Jet {
            field: self.field_on(&ray),
            gradient: self.gradient_on(&ray),
            hessian: self.hessian_on(&ray),
        })
    }

    fn field_on(&self, ray: &Ray) -> Vector3<f64> {
        (ray.direction * (3.0 * ray.along) - self.moment) * ray.scale
    }

    fn gradient_on(&self, ray: &Ray) -> Matrix3<f64> {
        let (m, n, w) = (&self.moment, &ray.direction, ray.along);
        let outer = m * n.transpose();
        let bracket =
            outer + outer.transpose() + Matrix3::from_diagonal_element(w) - n * n.transpose() * (5.0 * w);
        bracket * (3.0 * ray.scale / ray.distance)
    }

    fn hessian_on(&self, ray: &Ray) -> FieldHessian {
        let (m, n, w) = (&self.moment, &ray.direction, ray.along);
        let same = |i: usize, j: usize| if i == j { 1.0 } else { 0.0 };
        let factor = 3.0 * ray.scale / (ray.distance * ray.distance);
        let entry = |[i, j, k]: [usize; 3]| {
            let single = m[i] * same(j, k) + m[j] * same(i, k) + m[k] * same(i, j);
            let double = m[i] * n[j] * n[k] + m[j] * n[i] * n[k] + m[k] * n[i] * n[j];
            let mixed = same(i, j) * n[k] + same(i, k) * n[j] + same(j, k) * n[i];
            factor * (single - 5.0 * (double + w * mixed) + 35.0 * w * n[i] * n[j] * n[k])
        };
        FieldHessian(FieldHessian::INDICES.map(entry))
    }
}

/// Direction and distance of a point from the dipole.
struct Ray {
    direction: Vector3<f64>,
    distance: f64,
    /// `m.n`.
    along: f64,
    /// `mu_0 / (4 pi r^3)`.
    scale: f64,
}

impl Ray {
    fn new(moment: &Vector3<f64>, point: &Vector3<f64>) -> Result<Self, Error> {
        let distance = check(
            "distance from the dipole (m)",
            point.norm(),
            |r| (1e-30..=1e30).contains(&r),
            "from 1e-30 to 1e30",
        )?;
        let direction = point / distance;
        let scale = VACUUM_PERMEABILITY / (4.0 * PI) / distance.powi(3);
        Ok(Self { direction, distance, along: moment.dot(&direction), scale })
    }
}

//! Conversion of the cylindrical components of an axisymmetric field to Cartesian ones.

use nalgebra::{Matrix3, Vector3};

use super::jet::{FieldHessian, Jet};

/// A point in cylindrical coordinates: its distance from the axis and its azimuth.
#[derive(Debug, Clone, Copy)]
pub(super) struct Meridian {
    pub(super) x: f64,
    pub(super) y: f64,
    pub(super) rho: f64,
    cosine: f64,
    sine: f64,
}

impl Meridian {
    /// The point at `x`, `y`; on the axis, where the azimuth is arbitrary, it is that of the `x` axis.
    #[inline]
    pub(super) fn of(x: f64, y: f64) -> Self {
        let rho2 = x * x + y * y;
        if rho2 < f64::MIN_POSITIVE {
            return Self { x, y, rho: 0.0, cosine: 1.0, sine: 0.0 };
        }
        let rho = rho2.sqrt();
        let inverse = 1.0 / rho;
        Self { x, y, rho, cosine: x * inverse, sine: y * inverse }
    }

    /// Squares of cosine and sine of the azimuth, and their product.
    #[inline]
    pub(super) fn squares(&self) -> [f64; 3] {
        [self.cosine * self.cosine, self.sine * self.sine, self.cosine * self.sine]
    }
}

/// Cylindrical components, divided by the powers of `rho` with which they vanish on the axis.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Components {
    /// `B_rho / rho`.
    pub(super) radial: f64,
    /// `B_z`.
    pub(super) axial: f64,
    /// `dB_rho/dz / rho = dB_z/drho / rho`.
    pub(super) radial_dz: f64,
    /// `dB_z/dz`.
    pub(super) axial_dz: f64,
    /// `d2B_rho/dz2 / rho`.
    pub(super) radial_dzz: f64,
    /// `d2B_z/dz2`.
    pub(super) axial_dzz: f64,
    /// `(dB_z/dz + 2 B_rho/rho) / rho^2`.
    pub(super) twist: f64,
}

impl Components {
    #[inline]
    pub(super) fn field(&self, at: &Meridian) -> Vector3<f64> {
        Vector3::new(at.x * self.radial, at.y * self.radial, self.axial)
    }

    #[inline]
    pub(super) fn gradient(&self, at: &Meridian) -> Matrix3<f64> {
        let (c2, s2, cs) = (at.cosine * at.cosine, at.sine * at.sine, at.cosine * at.sine);
        let b = self.radial;
        let d = -self.axial_dz - b; // div B = 0
        let (xx, xy, yy) = (c2 * d + s2 * b, cs * (d - b), s2 * d + c2 * b);
        let (xz, yz) = (at.x * self.radial_dz, at.y * self.radial_dz);
        Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, self.axial_dz)
    }

    #[inline]
    pub(super) fn jet(&self, at: &Meridian) -> Jet {
        Jet { field: self.field(at), gradient: self.gradient(at), hessian: self.hessian(at) }
    }

    #[inline]
    pub(super) fn hessian(&self, at: &Meridian) -> FieldHessian {
        let (x, y) = (at.x, at.y);
        let (c2, s2, cs) = (at.cosine * at.cosine, at.sine * at.sine, at.cosine * at.sine);
        let (zzz, zzr, zff, rff) = (self.axial_dzz, self.radial_dzz, self.radial_dz, -self.twist);
        let zrr = -zzz - zff;
        let rrr = -zzr - rff;
        FieldHessian([
            x * (c2 * rrr + 3.0 * s2 * rff),
            y * (c2 * rrr + (s2 - 2.0 * c2) * rff),
            c2 * zrr + s2 * zff,
            x * (s2 * rrr + (c2 - 2.0 * s2) * rff),
            cs * (zrr - zff),
            x * zzr,
            y * (s2 * rrr + 3.0 * c2 * rff),
            s2 * zrr + c2 * zff,
            y * zzr,
            zzz,
        ])
    }
}

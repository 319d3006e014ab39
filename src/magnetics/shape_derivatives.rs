//! Derivatives of the Newtonian potential of a body's volume, and the field of its uniform magnetisation in any direction.
//!
//! With `V = int dV' / (4 pi r)` over the body, a uniform remanence `b` has the field `B_i = b_j d_i d_j V` outside, and
//! `b_i` more inside (Poisson's relation).

use nalgebra::{Matrix3, Vector3};

use super::axisymmetric::{Components, Meridian};
use super::jet::{FieldHessian, Jet};

/// Entries of a fully symmetric tensor of rank two, three and four: first those with the fewest indices that are not `x`, among
/// them those with the fewest `z`: xx, xy, xz, yy, yz, zz and so on. See [`position`].
pub(super) type Second = [f64; 6];
pub(super) type Third = [f64; 10];
pub(super) type Fourth = [f64; 15];

/// Place of the entry with so many indices that are not `x`, of which so many are `z`.
const fn position(not_x: usize, zs: usize) -> usize {
    not_x * (not_x + 1) / 2 + zs
}

/// A fully symmetric tensor of the rank `RANK`, contracted with a vector: a tensor of one rank less.
#[inline]
fn contracted<const RANK: usize, const FROM: usize, const TO: usize>(
    tensor: &[f64; FROM],
    with: &Vector3<f64>,
) -> [f64; TO] {
    let mut out = [0.0; TO];
    for not_x in 0..RANK {
        for zs in 0..=not_x {
            let [x, y, z] = [(0, 0), (1, 0), (1, 1)].map(|(more, z)| tensor[position(not_x + more, zs + z)]);
            out[position(not_x, zs)] = with.x * x + with.y * y + with.z * z;
        }
    }
    out
}

/// `B` outside the body, T, of the remanence `b` (T) from the second derivatives of its potential.
#[inline]
pub(super) fn field(second: &Second, b: &Vector3<f64>) -> Vector3<f64> {
    contracted::<2, 6, 3>(second, b).into()
}

/// `dB_i/dx_j`, T/m, of the remanence `b` (T) from the third derivatives (1/m) of the potential.
#[inline]
pub(super) fn gradient(third: &Third, b: &Vector3<f64>) -> Matrix3<f64> {
    let [xx, xy, xz, yy, yz, zz] = contracted::<3, 10, 6>(third, b);
    Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz)
}

/// `d2B_i/dx_jdx_k`, T/m2, of the remanence `b` (T) from the fourth derivatives (1/m2) of the potential.
#[inline]
pub(super) fn hessian(fourth: &Fourth, b: &Vector3<f64>) -> FieldHessian {
    FieldHessian(contracted::<4, 15, 10>(fourth, b))
}

/// The derivatives of an axisymmetric body's potential at one point: the components of its axial field per unit remanence, which
/// are those with `z`, and the shear, which gives those across. See [`super::transverse`].
#[derive(Debug, Clone, Copy)]
pub(super) struct AxisymmetricDerivatives {
    pub(super) axial: Components,
    /// `(V_zz + 2 V_rho/rho) / rho^2`, 1/m2.
    pub(super) shear: f64,
}

impl AxisymmetricDerivatives {
    /// The components of one derivative along `z` less: those of `V` as [`Components`] has them of `d_z V`.
    #[inline]
    fn lowered(&self, at: &Meridian) -> Components {
        let own = &self.axial;
        Components {
            radial: 0.5 * (at.rho * at.rho * self.shear - own.axial),
            axial: 0.0,
            radial_dz: own.radial,
            axial_dz: own.axial,
            radial_dzz: own.radial_dz,
            axial_dzz: own.axial_dz,
            twist: self.shear,
        }
    }

    /// The second derivatives; inside the body, where their sum is -1, `V_zz` has 1 in it, as `B_z`.
    #[inline]
    fn second(&self, at: &Meridian) -> Second {
        let all = self.lowered(at).gradient(at);
        [all[(0, 0)], all[(0, 1)], all[(0, 2)], all[(1, 1)], all[(1, 2)], all[(2, 2)]]
    }

    /// The fourth derivatives, by `e = rho d shear/drho = radial_dz - 4 shear` and its next one `f`.
    #[inline]
    fn fourth(&self, at: &Meridian) -> Fourth {
        let own = &self.axial;
        let with_z = own.hessian(at).0;
        let shear = self.shear;
        let e = own.radial_dz - 4.0 * shear;
        let f = -(own.axial_dzz + 2.0 * own.radial_dz + 6.0 * e);
        let [c2, s2, cs] = at.squares();

        let across = [
            -3.0 * shear - c2 * (6.0 * e + c2 * f),
            -cs * (3.0 * e + c2 * f),
            -shear - e - c2 * s2 * f,
            -cs * (3.0 * e + s2 * f),
            -3.0 * shear - s2 * (6.0 * e + s2 * f),
        ];

        let mut out = [0.0; 15];
        for (not_x, entry) in across.into_iter().enumerate() {
            out[position(not_x, 0)] = entry;
        }
        for not_x in 1..5 {
            for zs in 1..=not_x {
                out[position(not_x, zs)] = with_z[position(not_x - 1, zs - 1)];
            }
        }
        out
    }

    /// `B`, T, of the remanence `b` (T), of whose components across the axis `inside` is added: 1 inside the body.
    #[inline]
    pub(super) fn field(&self, at: &Meridian, b: &Vector3<f64>, inside: f64) -> Vector3<f64> {
        field(&self.second(at), b) + Vector3::new(b.x, b.y, 0.0) * inside
    }

    /// `dB_i/dx_j`, T/m.
    #[inline]
    pub(super) fn gradient(&self, at: &Meridian, b: &Vector3<f64>) -> Matrix3<f64> {
        gradient(&self.lowered(at).hessian(at).0, b)
    }

    /// `B`, its gradient and its second derivative; the arguments are those of [`AxisymmetricDerivatives::field`].
    #[inline]
    pub(super) fn jet(&self, at: &Meridian, b: &Vector3<f64>, inside: f64) -> Jet {
        Jet {
            field: self.field(at, b, inside),
            gradient: self.gradient(at, b),
            hessian: hessian(&self.fourth(at), b),
        }
    }
}

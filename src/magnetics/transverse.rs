//! What magnetisation across the axis of a cylinder or ring needs beside the axial field: one more function.
//!
//! A body magnetised uniformly with the remanence `b` has the field `B_i = b_j d_i d_j V` outside, where
//! `V = int dV' / (4 pi r)` is the Newtonian potential of its volume. Of an axisymmetric body `d_z V` is the potential of the
//! axial field: with `radial = V_rhoz / rho` and `axial = V_zz` all derivatives are known that contain `z`. Those across
//! follow from
//!
//! ```text
//! shear = (V_zz + 2 g) / rho^2      g = V_rho / rho
//! V_xx = g - x^2 shear      V_xy = -x y shear      V_yy = g - y^2 shear
//! d shear/dz = twist      rho d shear/drho = radial_dz - 4 shear
//! ```
//!
//! so that neither gradient nor second derivative needs a further integral.

#![expect(
    clippy::inline_always,
    reason = "the batch of points compiles these formulas for several processors"
)]

use core::f64::consts::PI;

use super::edge::Place;
use super::integrals::Integrals;
use super::lanes::Lanes;

/// Square of `rho` over the distance `sqrt(a^2 + u^2)` from the edge to its axis, below which the series about the axis is
/// used: there the closed form still has all but two digits, and [`TERMS`] terms leave less than 1e-17.
const NEAR_AXIS: f64 = 0.16;

/// Number of terms of the series about the axis.
const TERMS: usize = 24;

/// Power of the ratio below which terms of the series are below rounding.
const NEGLIGIBLE: f64 = 1e-18;

/// Coefficients of the series, `(-1)^(j+1) (2j + 2) (2j) (2j - 1)! / ((j + 1)!^2 4^(j+1))` for `j` from 1.
const SERIES: [f64; TERMS] = series();

const fn series() -> [f64; TERMS] {
    let mut out = [0.0; TERMS];
    let mut value = 0.125;
    let mut at = 0;
    while at < TERMS {
        out[at] = value;
        let j = (at + 1) as f64;
        value *= -(2.0 * j + 4.0) * (2.0 * j + 1.0) / (4.0 * (j + 2.0) * (j + 2.0));
        at += 1;
    }
    out
}

/// Factors of the recurrence of the Gegenbauer polynomials of order 3/2, `C_n = x forth C_{n-1} - back C_{n-2}`.
const RECURRENCE: [[f64; 2]; 2 * TERMS] = recurrence();

const fn recurrence() -> [[f64; 2]; 2 * TERMS] {
    let mut out = [[0.0; 2]; 2 * TERMS];
    let mut n = 1;
    while n < 2 * TERMS {
        let degree = n as f64;
        out[n] = [(2.0 * degree + 1.0) / degree, (degree + 1.0) / degree];
        n += 1;
    }
    out
}

impl<const N: usize> Place<N> {
    /// The shear per unit remanence, as it goes on analytically from the axis through the curved wall: beyond the wall it is too
    /// large by [`Place::wall`] over `rho^4`. `radial` and `axial` are the components of the axial field.
    ///
    /// `g` is homogeneous of degree zero in the lengths, and its derivative with respect to the radius `a` is the radial
    /// field of a charged cylindrical sheet, which has the same integral of the third kind as `B_z`. Euler's theorem gives
    ///
    /// ```text
    /// rho^2 shear = u B_rho/rho + (a^2/rho^2) (B_z - u K / (pi R))
    /// ```
    #[inline(always)]
    pub(super) fn shear(&self, integrals: &Integrals<N>, radial: Lanes<N>, axial: Lanes<N>) -> Lanes<N> {
        let distance2 = self.a2 + self.u2;
        let near = |i: usize| self.rho2.0[i] < NEAR_AXIS * distance2.0[i];
        let inverse2 = 1.0 / self.rho2.max(1e-3 * self.a2);
        let beyond = self.half_sign_beyond();
        let rest = (axial + beyond - (1.0 / PI) * self.u * integrals.first * self.inverse_far) * inverse2;
        let closed = (self.u * radial + self.a2 * rest) * inverse2;
        if !(0..N).any(near) {
            return closed;
        }
        Lanes::select(near, self.shear_near_axis(distance2, near), closed)
    }

    /// What the shear of the points beyond the wall is too large by, times `rho^4`, m2. Added up with the strengths of all
    /// edges, it is exactly zero above and below the body.
    #[inline(always)]
    pub(super) fn wall(&self) -> Lanes<N> {
        self.half_sign_beyond() * self.a2
    }

    /// Half the sign of the height, where the point is beyond the wall, and half of that on it.
    #[inline(always)]
    fn half_sign_beyond(&self) -> Lanes<N> {
        let share = |i: usize| match self.difference.0[i] {
            inside if inside > 0.0 => 0.0,
            outside if outside < 0.0 => 0.5_f64.copysign(self.u.0[i]),
            _ => 0.25_f64.copysign(self.u.0[i]),
        };
        Lanes(core::array::from_fn(share))
    }

    /// The Taylor series about the axis, on which `V_zz = u / (2 d)`, where `d^2 = a^2 + u^2`; its derivatives are
    /// Gegenbauer polynomials of order 3/2 of `u/d`.
    #[inline(always)]
    fn shear_near_axis(&self, distance2: Lanes<N>, near: impl Fn(usize) -> bool) -> Lanes<N> {
        let inverse2 = 1.0 / distance2;
        let cosine = self.u * inverse2 * distance2.sqrt();
        let ratio2 = Lanes::select(near, self.rho2 * inverse2, Lanes::all(0.0));
        let (mut before, mut here) = (Lanes::all(1.0), 3.0 * cosine);
        let mut power = Lanes::all(1.0);
        let mut sum = Lanes::all(0.0);
        for (term, coefficient) in SERIES.iter().enumerate() {
            sum = sum + *coefficient * power * here;
            power = power * ratio2;
            if (0..N).all(|i| power.0[i] < NEGLIGIBLE) {
                break;
            }
            for n in [2 * term + 2, 2 * term + 3] {
                let Some([forth, back]) = RECURRENCE.get(n) else { break };
                (before, here) = (here, *forth * cosine * here - *back * before);
            }
        }
        0.5 * self.a2 * inverse2.squared() * sum
    }
}

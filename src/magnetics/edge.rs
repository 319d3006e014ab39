//! The exact field of the end edges of axially magnetised cylinders.
//!
//! A cylinder of radius `a` magnetised along its axis is equivalent to a current sheet on its lateral surface: the
//! difference of two semi-infinite solenoids, each with one circular edge. The derivative of such a solenoid along the
//! axis is a current loop, so derivatives need only complete elliptic integrals of the first two kinds; `B_z` alone
//! needs one of the third kind. The closed forms are arranged so that nothing cancels near the axis, where the textbook
//! differences of `K` and `E` lose all digits.

use core::array::from_fn;
use core::f64::consts::PI;

use super::axisymmetric::Components;
use super::integrals::Integrals;
use super::lanes::Lanes;

/// Parameter `m` above which the forms for points near the edge are used.
const NEAR_EDGE: f64 = 0.5;

/// Ratio of smallest to largest distance from an edge below which a point counts as lying on it: a few rounding errors.
const ON_EDGE: f64 = 4.0 * f64::EPSILON;

/// Order of differentiation: the field alone.
pub(super) const FIELD: u8 = 0;
/// Order of differentiation: field and gradient.
pub(super) const GRADIENT: u8 = 1;
/// Order of differentiation: field, gradient and second derivative.
pub(super) const HESSIAN: u8 = 2;

/// Coaxial circular edges.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Edges<const N: usize> {
    /// Radius of each, m.
    pub(super) radius: [f64; N],
    /// Axial position of each, m.
    pub(super) position: [f64; N],
    /// Remanence with the edge's sign, T: plus for the lower edge of an outer surface.
    pub(super) strength: [f64; N],
}

impl<const N: usize> Edges<N> {
    /// Components summed over the edges, at the distance `rho` from the axis and the height `z`; `None` on an edge.
    ///
    /// `ORDER` is the highest derivative; components of higher ones stay zero.
    #[inline]
    pub(super) fn components<const ORDER: u8>(&self, rho: f64, z: f64) -> Option<Components> {
        self.sum::<ORDER, false>(rho, z).map(|(_, sum)| sum)
    }

    /// As [`Edges::components`], with the scalar potential `psi` (T m), of which `mu_0 H` is minus the gradient.
    #[inline]
    pub(super) fn with_potential<const ORDER: u8>(&self, rho: f64, z: f64) -> Option<(f64, Components)> {
        self.sum::<ORDER, true>(rho, z)
    }

    /// The potential, zero unless `POTENTIAL`, and the components.
    #[inline]
    fn sum<const ORDER: u8, const POTENTIAL: bool>(&self, rho: f64, z: f64) -> Option<(f64, Components)> {
        let place = Place::new(Lanes(self.radius), z - Lanes(self.position), rho);
        if (0..N).any(|i| place.near2.0[i] <= ON_EDGE * ON_EDGE * place.far2.0[i]) {
            return None;
        }
        let m = 4.0 * rho * place.radius * place.inverse_far2;
        let integrals = Integrals::new(m, (place.near2 * place.inverse_far2).sqrt(), place.ratio);
        let weights = &self.strength;
        let (radial, axial) = place.field(&integrals);
        let mut sum = Components {
            radial: radial.weighted_sum(weights),
            axial: axial.weighted_sum(weights),
            ..Components::default()
        };
        let potential =
            if POTENTIAL { place.potential(&integrals, radial, axial).weighted_sum(weights) } else { 0.0 };
        if ORDER == FIELD {
            return Some((potential, sum));
        }
        let close: [bool; N] = from_fn(|i| m.0[i] > NEAR_EDGE);
        let any_close = close.contains(&true);
        let (mut radial_dz, mut axial_dz) = place.gradient(&integrals);
        if any_close {
            let (radial_dz_close, axial_dz_close) = place.gradient_near_edge(&integrals);
            radial_dz = radial_dz.replaced(close, radial_dz_close);
            axial_dz = axial_dz.replaced(close, axial_dz_close);
        }
        sum.radial_dz = radial_dz.weighted_sum(weights);
        sum.axial_dz = axial_dz.weighted_sum(weights);
        if ORDER >= HESSIAN {
            let [mut radial_dzz, mut axial_dzz, mut twist] = place.hessian(&integrals);
            if any_close {
                let [radial_dzz_close, axial_dzz_close] = place.hessian_near_edge(&integrals);
                radial_dzz = radial_dzz.replaced(close, radial_dzz_close);
                axial_dzz = axial_dzz.replaced(close, axial_dzz_close);
                twist = twist.replaced(close, (axial_dz + 2.0 * radial) / place.rho2);
            }
            sum.radial_dzz = radial_dzz.weighted_sum(weights);
            sum.axial_dzz = axial_dzz.weighted_sum(weights);
            sum.twist = twist.weighted_sum(weights);
        }
        Some((potential, sum))
    }
}

/// Position of a point relative to each edge, and the quantities that the formulas share.
struct Place<const N: usize> {
    radius: Lanes<N>,
    /// Height above the edge's plane.
    u: Lanes<N>,
    rho2: f64,
    a2: Lanes<N>,
    u2: Lanes<N>,
    /// `a^2 - rho^2`, without cancellation.
    w: Lanes<N>,
    /// `1 / (a + rho)`.
    inverse_sum: Lanes<N>,
    /// `(a - rho) / (a + rho)`.
    ratio: Lanes<N>,
    /// Square of the smallest distance to the edge, `q`.
    near2: Lanes<N>,
    /// Square of the largest distance to the edge, `R^2`.
    far2: Lanes<N>,
    inverse_far: Lanes<N>,
    inverse_far2: Lanes<N>,
    inverse_far3: Lanes<N>,
}

impl<const N: usize> Place<N> {
    #[inline]
    fn new(radius: Lanes<N>, u: Lanes<N>, rho: f64) -> Self {
        let (sum, difference) = (radius + rho, radius - rho);
        let u2 = u.squared();
        let far2 = sum.squared() + u2;
        let inverse_far2 = 1.0 / far2;
        let inverse_far = far2.sqrt() * inverse_far2;
        let inverse_sum = 1.0 / sum;
        Self {
            radius,
            u,
            rho2: rho * rho,
            a2: radius.squared(),
            u2,
            w: sum * difference,
            inverse_sum,
            ratio: difference * inverse_sum,
            near2: difference.squared() + u2,
            far2,
            inverse_far,
            inverse_far2,
            inverse_far3: inverse_far * inverse_far2,
        }
    }

    /// `B_rho / rho` and `B_z` per unit remanence.
    #[inline]
    fn field(&self, i: &Integrals<N>) -> (Lanes<N>, Lanes<N>) {
        let radial = (-8.0 / PI) * self.a2 * i.first * i.t * self.inverse_far3;
        let axial = (1.0 / PI) * self.u * self.radius * i.third * self.inverse_sum * self.inverse_far;
        (radial, axial)
    }

    /// Potential of `mu_0 H` per unit remanence, from the field components `radial` and `axial`.
    ///
    /// For `H` the edge bounds a disc of magnetic charge, -1 in units of the remanence. Within the solenoid's radius
    /// its field differs from `B` by half of the remanence, with opposite signs on the two sides. The potential is
    /// homogeneous of degree one in the lengths; Euler's theorem gives it from the field and from the derivative with
    /// respect to the radius, `a K / (pi R)`, which is the potential of a charged circle.
    #[inline]
    fn potential(&self, i: &Integrals<N>, radial: Lanes<N>, axial: Lanes<N>) -> Lanes<N> {
        let within = self.ratio.map(|ratio| if ratio > 0.0 { 0.5 } else { 0.25 * f64::from(ratio == 0.0) });
        let circle = (1.0 / PI) * self.a2 * i.first * self.inverse_far;
        within * self.u.map(f64::abs) - circle - self.rho2 * radial - self.u * axial
    }

    /// `dB_rho/dz / rho` and `dB_z/dz`: a current loop's field.
    #[inline]
    fn gradient(&self, i: &Integrals<N>) -> (Lanes<N>, Lanes<N>) {
        let scale = (1.0 / PI) * self.a2 / self.near2 * self.inverse_far;
        let gk = 4.0 * i.first * i.g * self.inverse_far2;
        (scale * self.u * gk, scale * (i.second - self.rho2 * gk))
    }

    /// As [`Place::gradient`], for points near the edge.
    #[inline]
    fn gradient_near_edge(&self, i: &Integrals<N>) -> (Lanes<N>, Lanes<N>) {
        let scale = (0.5 / PI) * self.inverse_far;
        let eq = i.second / self.near2;
        let radial_dz = scale * self.u * ((self.a2 + self.rho2 + self.u2) * eq - i.first) / self.rho2;
        (radial_dz, scale * (i.first + (self.w - self.u2) * eq))
    }

    /// The polynomials `V`, `P`, `Y` of the second derivatives.
    #[inline]
    fn polynomials(&self) -> [Lanes<N>; 3] {
        let (a2, u2, rho2) = (self.a2, self.u2, self.rho2);
        let (w2, u4, sum2) = (self.w.squared(), u2.squared(), a2 + rho2);
        let v = w2 + u2 * sum2;
        let p = w2 * sum2 + 2.0 * u2 * (a2 * (a2 - 6.0 * rho2) + rho2 * rho2) + u4 * sum2;
        let y = u2 * (2.0 * rho2 - 6.0 * a2) + u4 - self.w * (rho2 + 7.0 * a2);
        [v, p, y]
    }

    /// `d2B_rho/dz2 / rho`, `d2B_z/dz2` and `(dB_z/dz + 2 B_rho/rho) / rho^2`.
    #[inline]
    fn hessian(&self, i: &Integrals<N>) -> [Lanes<N>; 3] {
        let (a2, u2, rho2) = (self.a2, self.u2, self.rho2);
        let s2 = a2 + rho2 + u2;
        let [v, p, y] = self.polynomials();
        let tr = i.t * self.inverse_far2;
        let loop_scale = (1.0 / PI) * a2 * i.first * self.inverse_far3 / self.near2;
        let scale = loop_scale * self.inverse_far2 / self.near2;
        let radial_dzz = 2.0 * scale * (v - 3.0 * u2 * s2 - 4.0 * p * tr);
        let axial_dzz = 0.5
            * self.u
            * scale
            * (6.0 * s2 * (rho2 - u2 - a2) - 4.0 * rho2 * (self.w - u2) - 16.0 * rho2 * y * tr);
        let kc2 = self.near2 * self.inverse_far2;
        let twist = 4.0 * loop_scale * (4.0 * a2 * self.inverse_far2 * (0.5 - i.t - 16.0 * kc2 * i.t2) - i.g);
        [radial_dzz, axial_dzz, twist]
    }

    /// The first two of [`Place::hessian`], for points near the edge.
    #[inline]
    fn hessian_near_edge(&self, i: &Integrals<N>) -> [Lanes<N>; 2] {
        let [v, p, y] = self.polynomials();
        let scale = (0.5 / PI) * self.inverse_far3 / self.near2.squared();
        let radial_dzz = scale * (p * i.second - self.near2 * v * i.first) / self.rho2;
        let axial_dzz = scale * self.u * (y * i.second + self.near2 * (self.w - self.u2) * i.first);
        [radial_dzz, axial_dzz]
    }
}

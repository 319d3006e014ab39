//! The exact field of the end edges of axially magnetised cylinders.
//!
//! A cylinder of radius `a` magnetised along its axis is equivalent to a current sheet on its lateral surface: the
//! difference of two semi-infinite solenoids, each with one circular edge. The derivative of such a solenoid along the
//! axis is a current loop, so derivatives need only complete elliptic integrals of the first two kinds; `B_z` alone
//! needs one of the third kind. The closed forms are arranged so that nothing cancels near the axis, where the textbook
//! differences of `K` and `E` lose all digits.

#![expect(
    clippy::inline_always,
    reason = "the batch of points compiles these formulas for several processors"
)]

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

/// What is summed beside the components: nothing.
pub(super) const NOTHING: u8 = 0;
/// What is summed beside the components: the scalar potential `psi` (T m), of which `mu_0 H` is minus the gradient.
pub(super) const POTENTIAL: u8 = 1;
/// What is summed beside the components: the shear (T/m2), which magnetisation across the axis needs, see [`Place::shear`].
pub(super) const SHEAR: u8 = 2;

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
    /// Radius, axial position and signed strength of each.
    pub(super) fn each(&self) -> [[f64; 3]; N] {
        from_fn(|i| [self.radius[i], self.position[i], self.strength[i]])
    }

    /// Components summed over the edges, at the distance `rho` from the axis and the height `z`, after the number beside them that
    /// `BESIDE` names, 0 for [`NOTHING`]; `None` on an edge.
    ///
    /// `ORDER` is the highest derivative; components of higher ones stay zero.
    #[inline]
    pub(super) fn sum<const ORDER: u8, const BESIDE: u8>(
        &self,
        rho: f64,
        z: f64,
    ) -> Option<(f64, Components)> {
        let place = Place::new(Lanes(self.radius), z - Lanes(self.position), Lanes::all(rho));
        if place.is_on_edge() {
            return None;
        }

        let integrals = Integrals::new(place.parameter(), place.complement(), place.ratio());
        let parts = place.components::<ORDER, false>(&integrals);
        let weights = &self.strength;
        let mut sum = Components {
            radial: parts.radial.weighted_sum(weights),
            axial: parts.axial.weighted_sum(weights),
            ..Components::default()
        };

        let beside = match BESIDE {
            POTENTIAL => place.potential(&integrals, parts.radial, parts.axial).weighted_sum(weights),
            SHEAR => {
                let within = place.shear(&integrals, parts.radial, parts.axial).weighted_sum(weights);
                within - place.wall().weighted_sum(weights) / rho.powi(4).max(f64::MIN_POSITIVE)
            }
            _ => 0.0,
        };

        if ORDER >= GRADIENT {
            sum.radial_dz = parts.radial_dz.weighted_sum(weights);
            sum.axial_dz = parts.axial_dz.weighted_sum(weights);
        }
        if ORDER >= HESSIAN {
            sum.radial_dzz = parts.radial_dzz.weighted_sum(weights);
            sum.axial_dzz = parts.axial_dzz.weighted_sum(weights);
            sum.twist = parts.twist.weighted_sum(weights);
        }

        Some((beside, sum))
    }
}

/// Components per unit remanence, a lane for each pair of a point and an edge; see [`Components`].
pub(super) struct Parts<const N: usize> {
    pub(super) radial: Lanes<N>,
    pub(super) axial: Lanes<N>,
    pub(super) radial_dz: Lanes<N>,
    pub(super) axial_dz: Lanes<N>,
    pub(super) radial_dzz: Lanes<N>,
    pub(super) axial_dzz: Lanes<N>,
    pub(super) twist: Lanes<N>,
}

/// Positions of points relative to edges, and the quantities that the formulas share: a lane for each pair.
pub(super) struct Place<const N: usize> {
    radius: Lanes<N>,
    /// Height above the edge's plane.
    pub(super) u: Lanes<N>,
    rho: Lanes<N>,
    pub(super) rho2: Lanes<N>,
    pub(super) a2: Lanes<N>,
    pub(super) u2: Lanes<N>,
    /// `a^2 - rho^2`, without cancellation.
    w: Lanes<N>,
    /// `a + rho`, `a - rho` and `1 / (a + rho)`.
    pub(super) sum: Lanes<N>,
    pub(super) difference: Lanes<N>,
    inverse_sum: Lanes<N>,
    /// Square of the smallest distance to the edge, `q`.
    near2: Lanes<N>,
    inverse_near2: Lanes<N>,
    /// Square of the largest distance to the edge, `R^2`.
    far2: Lanes<N>,
    pub(super) inverse_far: Lanes<N>,
    inverse_far2: Lanes<N>,
    inverse_far3: Lanes<N>,
}

impl<const N: usize> Place<N> {
    #[inline(always)]
    pub(super) fn new(radius: Lanes<N>, u: Lanes<N>, rho: Lanes<N>) -> Self {
        let (sum, difference) = (radius + rho, radius - rho);
        let u2 = u.squared();
        let (near2, far2) = (difference.squared() + u2, sum.squared() + u2);
        // Three reciprocals from that of their product.
        let (both, beside) = (near2 * far2, far2 * sum);
        let whole = 1.0 / (both * sum);
        let inverse_far2 = whole * (near2 * sum);
        let inverse_far = far2.sqrt() * inverse_far2;
        Self {
            radius,
            u,
            rho,
            rho2: rho.squared(),
            a2: radius.squared(),
            u2,
            w: sum * difference,
            sum,
            difference,
            inverse_sum: whole * both,
            near2,
            inverse_near2: whole * beside,
            far2,
            inverse_far,
            inverse_far2,
            inverse_far3: inverse_far * inverse_far2,
        }
    }

    /// Whether one of the points lies on its edge.
    #[inline(always)]
    pub(super) fn is_on_edge(&self) -> bool {
        (0..N).any(|i| self.near2.0[i] <= ON_EDGE * ON_EDGE * self.far2.0[i])
    }

    /// Parameter `m` of the elliptic integrals.
    #[inline(always)]
    pub(super) fn parameter(&self) -> Lanes<N> {
        4.0 * self.rho * self.radius * self.inverse_far2
    }

    /// Complementary modulus `kc`, the ratio of the smallest to the largest distance from the edge.
    #[inline(always)]
    pub(super) fn complement(&self) -> Lanes<N> {
        (self.near2 * self.inverse_far2).sqrt()
    }

    /// Square of the smallest distance minus that of `least` times the largest one, m2: negative where `kc < least`.
    #[inline(always)]
    pub(super) fn excess(&self, least: f64) -> Lanes<N> {
        self.near2 - least * least * self.far2
    }

    /// `(a - rho) / (a + rho)`.
    #[inline(always)]
    fn ratio(&self) -> Lanes<N> {
        self.difference * self.inverse_sum
    }

    /// All components up to the order `ORDER`; those of higher orders are zero.
    ///
    /// `BATCH`: without branches, so that the gradient alone is good to `eps / kc^2` near an edge.
    #[inline(always)]
    pub(super) fn components<const ORDER: u8, const BATCH: bool>(
        &self,
        integrals: &Integrals<N>,
    ) -> Parts<N> {
        let zero = Lanes::all(0.0);

        let (radial, axial) = self.field(integrals);
        let mut parts = Parts {
            radial,
            axial,
            radial_dz: zero,
            axial_dz: zero,
            radial_dzz: zero,
            axial_dzz: zero,
            twist: zero,
        };
        if ORDER == FIELD {
            return parts;
        }

        let m = self.parameter();
        let close = |i: usize| m.0[i] > NEAR_EDGE;
        let any_close = if BATCH { ORDER >= HESSIAN } else { (0..N).any(close) };
        let inverse_rho2 = || 1.0 / self.rho2.max(1e-3 * self.a2);
        (parts.radial_dz, parts.axial_dz) = self.gradient(integrals);

        if any_close {
            let (radial_dz, axial_dz) = self.gradient_near_edge(integrals, inverse_rho2());
            parts.radial_dz = Lanes::select(close, radial_dz, parts.radial_dz);
            parts.axial_dz = Lanes::select(close, axial_dz, parts.axial_dz);
        }

        if ORDER >= HESSIAN {
            [parts.radial_dzz, parts.axial_dzz, parts.twist] = self.hessian(integrals);
            if any_close {
                let inverse = inverse_rho2();
                let [radial_dzz, axial_dzz] = self.hessian_near_edge(integrals, inverse);
                parts.radial_dzz = Lanes::select(close, radial_dzz, parts.radial_dzz);
                parts.axial_dzz = Lanes::select(close, axial_dzz, parts.axial_dzz);
                parts.twist = Lanes::select(close, (parts.axial_dz + 2.0 * radial) * inverse, parts.twist);
            }
        }

        parts
    }

    /// `B_rho / rho` and `B_z` per unit remanence.
    #[inline(always)]
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
    #[inline(always)]
    fn potential(&self, i: &Integrals<N>, radial: Lanes<N>, axial: Lanes<N>) -> Lanes<N> {
        let within = self.ratio().map(|ratio| if ratio > 0.0 { 0.5 } else { 0.25 * f64::from(ratio == 0.0) });
        let circle = (1.0 / PI) * self.a2 * i.first * self.inverse_far;
        within * self.u.map(f64::abs) - circle - self.rho2 * radial - self.u * axial
    }

    /// `dB_rho/dz / rho` and `dB_z/dz`: a current loop's field.
    #[inline(always)]
    fn gradient(&self, i: &Integrals<N>) -> (Lanes<N>, Lanes<N>) {
        let scale = (1.0 / PI) * self.a2 * self.inverse_near2 * self.inverse_far;
        let gk = 4.0 * i.first * i.g * self.inverse_far2;
        (scale * self.u * gk, scale * (i.second - self.rho2 * gk))
    }

    /// As [`Place::gradient`], for points near the edge, where `rho` is not small.
    #[inline(always)]
    fn gradient_near_edge(&self, i: &Integrals<N>, inverse_rho2: Lanes<N>) -> (Lanes<N>, Lanes<N>) {
        let scale = (0.5 / PI) * self.inverse_far;
        let eq = i.second * self.inverse_near2;
        let radial_dz = scale * self.u * ((self.a2 + self.rho2 + self.u2) * eq - i.first) * inverse_rho2;
        (radial_dz, scale * (i.first + (self.w - self.u2) * eq))
    }

    /// The polynomials `V`, `P`, `Y` of the second derivatives.
    #[inline(always)]
    fn polynomials(&self) -> [Lanes<N>; 3] {
        let (a2, u2, rho2) = (self.a2, self.u2, self.rho2);
        let (w2, u4, sum2) = (self.w.squared(), u2.squared(), a2 + rho2);
        let v = w2 + u2 * sum2;
        let p = w2 * sum2 + 2.0 * u2 * (a2 * (a2 - 6.0 * rho2) + rho2 * rho2) + u4 * sum2;
        let y = u2 * (2.0 * rho2 - 6.0 * a2) + u4 - self.w * (rho2 + 7.0 * a2);
        [v, p, y]
    }

    /// `d2B_rho/dz2 / rho`, `d2B_z/dz2` and `(dB_z/dz + 2 B_rho/rho) / rho^2`.
    #[inline(always)]
    fn hessian(&self, i: &Integrals<N>) -> [Lanes<N>; 3] {
        let (a2, u2, rho2) = (self.a2, self.u2, self.rho2);
        let s2 = a2 + rho2 + u2;
        let [v, p, y] = self.polynomials();
        let tr = i.t * self.inverse_far2;
        let loop_scale = (1.0 / PI) * a2 * i.first * self.inverse_far3 * self.inverse_near2;
        let scale = loop_scale * self.inverse_far2 * self.inverse_near2;
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
    #[inline(always)]
    fn hessian_near_edge(&self, i: &Integrals<N>, inverse_rho2: Lanes<N>) -> [Lanes<N>; 2] {
        let [v, p, y] = self.polynomials();
        let scale = (0.5 / PI) * self.inverse_far3 * self.inverse_near2.squared();
        let radial_dzz = scale * (p * i.second - self.near2 * v * i.first) * inverse_rho2;
        let axial_dzz = scale * self.u * (y * i.second + self.near2 * (self.w - self.u2) * i.first);
        [radial_dzz, axial_dzz]
    }
}

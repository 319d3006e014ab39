//! Demagnetisation of a ring magnet by its own field.

use core::f64::consts::PI;

use nalgebra::Vector3;

use super::area::annulus_area;
use super::direction::Direction;
use super::specification::{Helix, RingMagnet, Segmented};
use crate::numerics::quadrature::gauss_legendre;

/// Number of panels of the quadrature, each half as long as the previous one, towards the angle at which the two
/// circles are closest. The last one ends there: only in it, over 2e-7 of the range, may the integrand not be smooth;
/// the error is limited by its variation there.
const PANELS: i32 = 23;

/// Gauss points per panel: all singularities of the integrand are at least three halves of a panel's length away from
/// its middle, so that each point reduces the error by a factor of 34.
const POINTS: usize = 12;

/// Magnetometric demagnetising factor of an annulus along its axis, from 0 (a long tube) to 1 (a thin disc).
///
/// It is the factor in the mean field of a uniform magnetisation `M` within its own body, `<H_z> = -N M`, and follows
/// from the magnetostatic self-energy `mu_0 N M^2 V / 2` of its two charged faces. With the energy of two coaxial discs
/// of the radii `a` and `b`,
///
/// ```text
/// N = (J(R, R) - 2 J(R, r) + J(r, r)) / V      V = pi (R^2 - r^2) L
/// J(a, b) = 2 a b int_0^pi cos(phi) [S - D - L ln(L + S)] dphi
/// D^2 = a^2 + b^2 - 2 a b cos(phi)      S^2 = D^2 + L^2
/// ```
///
/// by Gauss-Legendre quadrature, to machine precision; for a wall that is thin compared with the radius, rounding
/// errors grow with the square of their ratio. Arguments are the inner radius `0 <= r < R`, the outer radius `R` and
/// the length `L > 0`, m.
///
/// ```
/// use mcm::design::demagnetising_factor;
/// // A cylinder as long as wide: 1 minus Nagaoka's coefficient 0.688423.
/// assert!((demagnetising_factor(0.0, 1e-3, 2e-3) - 0.311577).abs() < 1e-6);
/// // A bore reduces the factor.
/// assert!(demagnetising_factor(0.75e-3, 2e-3, 1e-3) < demagnetising_factor(0.0, 2e-3, 1e-3));
/// ```
///
/// Source: R. I. Joseph, J. Appl. Phys. 37 (1966) 4639, for the solid cylinder; the integral is that of F. E. Neumann
/// for the mutual inductance of coaxial circles, integrated twice along the axis.
#[must_use]
pub fn demagnetising_factor(inner_radius: f64, outer_radius: f64, length: f64) -> f64 {
    let energy = |a, b| discs(a, b, length);
    let own = energy(outer_radius, outer_radius) + energy(inner_radius, inner_radius);
    (own - 2.0 * energy(outer_radius, inner_radius)) / (annulus_area(inner_radius, outer_radius) * length)
}

/// `J(a, b)`: decrease of the energy of two coaxial discs of unit charge density as they move apart by `length`, over
/// `2 pi`, m3.
fn discs(a: f64, b: f64, length: f64) -> f64 {
    let (nodes, weights) = gauss_legendre(POINTS);
    let mut sum = 0.0;
    for panel in 0..PANELS {
        let (end, last) = (PI * 0.5_f64.powi(panel), panel + 1 == PANELS);
        let start = if last { 0.0 } else { 0.5 * end };
        let half = 0.5 * (end - start);
        for (node, weight) in nodes.iter().zip(&weights) {
            let angle = start + half * (1.0 + node);
            let half_sine = (0.5 * angle).sin();
            let square = (a - b) * (a - b) + 4.0 * a * b * half_sine * half_sine;
            let (gap, slant) = (square.sqrt(), (square + length * length).sqrt());
            // S - L and ln((L + S)/2L): the omitted constants vanish in the integral with the cosine.
            let longer = square / (slant + length);
            let logarithm = (0.5 * longer / length).ln_1p();
            sum += half * weight * angle.cos() * (longer - gap - length * logarithm);
        }
    }
    2.0 * a * b * sum
}

impl Segmented {
    /// Magnetic polarisation `J = mu_0 M` along the axis of rings that are all alike, T: the remanence of equivalent magnets of
    /// permeability 1.
    ///
    /// With the linear demagnetisation curve `B = B_r + mu_0 mu_r H` and the mean `H = -N M` of the ring's own field,
    ///
    /// ```text
    /// J = B_r / (1 + N (mu_r - 1))
    /// ```
    ///
    /// with [`demagnetising_factor`] `N`. The uniform magnetisation is an approximation with an error of second order
    /// in `mu_r - 1`: compared with an integral equation (`cargo test recoil`), the error of the moment of the paper's
    /// ring is 5e-5 at `mu_r = 1.05` and 1e-2 at 2; that of its field at the next ring is larger by 6e-4 and 9e-3,
    /// respectively. Magnetisation induced by other magnets is neglected: 20 mT change the polarisation by
    /// `20 mT (mu_r - 1)`, at 1.05 by 1 mT of 1.35 T.
    ///
    /// ```
    /// use mcm::design::{RingMagnet, Segmented};
    /// let sintered = RingMagnet { recoil_permeability: 1.05, ..RingMagnet::paper() };
    /// let chain = Segmented { ring: sintered, ..Segmented::paper(1) };
    /// assert!((chain.ring_polarisation() / 1.35 - 0.97285).abs() < 1e-5);
    /// assert_eq!(Segmented::paper(1).ring_polarisation(), 1.35);
    /// ```
    #[must_use]
    pub fn ring_polarisation(&self) -> f64 {
        polarisation(&self.ring, &self.helix, Direction::Axial).0
    }
}

/// Magnetic polarisation (T) of a ring with the radii of a helix that is magnetised in this direction, and the direction of the
/// polarisation.
///
/// Across the axis the factor is `(1 - N) / 2`: the three factors of any body add up to 1. A ring that is weakened by its own field
/// more along one direction than along another is magnetised a little off the direction of its remanence.
pub(super) fn polarisation(ring: &RingMagnet, helix: &Helix, direction: Direction) -> (f64, Direction) {
    let (sign, direction) = direction.signed();
    let remanence = sign * ring.remanence;
    let excess = ring.recoil_permeability - 1.0;
    if excess == 0.0 {
        return (remanence, direction);
    }

    let along = demagnetising_factor(helix.core_inner_radius, helix.radius, ring.length);
    if direction.is_axial() {
        return (remanence / (1.0 + along * excess), direction);
    }
    let across = 0.5 * (1.0 - along);
    let weakened = [across, across, along].map(|factor| 1.0 / (1.0 + factor * excess));
    let (size, direction) = Direction::of(&direction.vector().component_mul(&Vector3::from(weakened)));
    (remanence * size, direction)
}

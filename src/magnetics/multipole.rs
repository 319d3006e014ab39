//! The far field of an axially magnetised cylinder or ring: its axial multipoles.

use core::f64::consts::PI;

use super::axisymmetric::Components;
use super::edge::{GRADIENT, HESSIAN};

/// Number of multipoles kept: the degrees 1, 3, .. 17.
pub(super) const TERMS: usize = 9;

/// Number of solid harmonics, up to the second derivative of the highest multipole.
const DEGREES: usize = 2 * TERMS + 3;

/// Distance, relative to the body's extent `s`, from which each number of terms neglects less than 1e-14.
///
/// The first omitted degree `l + 2` is smaller than the dipole by about `(s/r)^(l+1)`: the distances are
/// `10^(14/(l+1))`.
const REACH: [(f64, usize); TERMS] =
    [(1e7, 1), (3163.0, 2), (216.0, 3), (56.3, 4), (25.2, 5), (14.7, 6), (10.0, 7), (7.5, 8), (0.0, 9)];

/// The multipole coefficients `beta_l = (B_r / 4 pi) l (l + 1) M_{l-1}` for odd `l`, T m^(l+2).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Multipole {
    beta: [f64; TERMS],
    /// Square of the body's extent `sqrt(a^2 + h^2)`, m2.
    extent2: f64,
}

impl Multipole {
    /// Multipoles of a body with the radii `inner` and `outer`, half length `half` (m) and the remanence in T.
    pub(super) fn new(inner: f64, outer: f64, half: f64, remanence: f64) -> Self {
        let beta = core::array::from_fn(|term| {
            let l = 2 * term + 1;
            remanence / (4.0 * PI) * (l * (l + 1)) as f64 * axial_moment(l - 1, inner, outer, half)
        });
        Self { beta, extent2: outer * outer + half * half }
    }

    /// Components at height `z` and distance `sqrt(r2)` from the centre, at least six times the extent, by as many
    /// terms as are needed there.
    #[inline]
    pub(super) fn components<const ORDER: u8>(&self, z: f64, r2: f64) -> Components {
        let ratio2 = r2 / self.extent2;
        let terms =
            REACH.iter().find(|(reach, _)| ratio2 >= reach * reach).map_or(TERMS, |&(_, terms)| terms);
        self.sum::<ORDER>(z, r2, terms)
    }

    /// The scalar potential at such a point by all terms, T m: the sum of `beta_l S^0_l / (l+1)`.
    #[inline]
    pub(super) fn potential(&self, z: f64, r2: f64) -> f64 {
        let inverse2 = 1.0 / r2;
        let zonal = solid::<0>(inverse2.sqrt(), z * inverse2, inverse2, 2 * TERMS);
        let degrees = (1..).step_by(2);
        self.beta.iter().zip(degrees).map(|(beta, l)| beta * zonal[l] / (l as f64 + 1.0)).sum()
    }

    /// The components by `terms` terms, anywhere beyond the extent.
    ///
    /// With `S^k_n = P_n^(k)(z/r) / r^(n+1+k)`, `P_n^(k)` the `k`-th derivative of the Legendre polynomial, `B_z` is
    /// the sum of `beta_l S^0_{l+1}`, `B_rho / rho` that of `beta_l S^1_{l+1} / (l+1)`, and each derivative along `z`
    /// raises `n` by one.
    #[inline]
    pub(super) fn sum<const ORDER: u8>(&self, z: f64, r2: f64, terms: usize) -> Components {
        let inverse2 = 1.0 / r2;
        let inverse3 = inverse2 * inverse2.sqrt();
        let (along, last) = (z * inverse2, 2 * terms + usize::from(ORDER));
        let zonal = solid::<0>(inverse3 * r2, along, inverse2, last);
        let first = solid::<1>(inverse3, along, inverse2, last);
        let mut sum = Components::default();
        for (term, &beta) in self.beta.iter().enumerate().take(terms) {
            let l = 2 * term + 1;
            let degree = l as f64;
            sum.axial += beta * zonal[l + 1];
            sum.radial += beta * first[l + 1] / (degree + 1.0);
            if ORDER >= GRADIENT {
                sum.axial_dz -= beta * (degree + 2.0) * zonal[l + 2];
                sum.radial_dz -= beta * first[l + 2];
            }
            if ORDER >= HESSIAN {
                sum.axial_dzz += beta * (degree + 2.0) * (degree + 3.0) * zonal[l + 3];
                sum.radial_dzz += beta * (degree + 2.0) * first[l + 3];
            }
        }
        if ORDER >= HESSIAN {
            let second = solid::<2>(3.0 * inverse3 * inverse2, along, inverse2, last);
            for (term, &beta) in self.beta.iter().enumerate().take(terms) {
                let l = 2 * term + 1;
                sum.twist += beta * second[l + 2] / (l as f64 + 1.0);
            }
        }
        sum
    }
}

/// `S^K_n` for `n` up to `last`, from `start = S^K_K`, `along = z / r^2` and `inverse2 = 1 / r^2`.
///
/// `(n - K + 1) S^K_{n+1} = (2n + 1) (z/r^2) S^K_n - (n + K) S^K_{n-1} / r^2`.
#[inline]
fn solid<const K: usize>(start: f64, along: f64, inverse2: f64, last: usize) -> [f64; DEGREES] {
    let mut values = [0.0; DEGREES];
    values[K] = start;
    let mut before = 0.0;
    for n in K..last.min(DEGREES - 1) {
        let here = values[n];
        let k = K as f64;
        let n_real = n as f64;
        values[n + 1] =
            ((2.0 * n_real + 1.0) * along * here - (n_real + k) * inverse2 * before) / (n_real - k + 1.0);
        before = here;
    }
    values
}

/// The moment `M_j`, the volume integral of `r^j P_j(cos theta)`, of a centred annular cylinder, `j` even, m^(j+3).
///
/// `M_j = sum_i (-1)^i j! / ((j-2i)! i!^2 4^i) [2 h^(j-2i+1) / (j-2i+1)] [2 pi (a^(2i+2) - b^(2i+2)) / (2i+2)]`
/// with the outer radius `a`, the inner radius `b` and the half length `h`.
pub(super) fn axial_moment(j: usize, inner: f64, outer: f64, half: f64) -> f64 {
    let mut coefficient = 1.0; // (-1)^i j! / ((j-2i)! i!^2 4^i)
    let mut sum = 0.0;
    for i in 0..=j / 2 {
        let (left, order) = (j - 2 * i, 2 * i + 2);
        let along = 2.0 * power(half, left + 1) / (left + 1) as f64;
        let across = 2.0 * PI * (power(outer, order) - power(inner, order)) / order as f64;
        sum += coefficient * along * across;
        coefficient *= -((left * left.saturating_sub(1)) as f64) / (4 * (i + 1) * (i + 1)) as f64;
    }
    sum
}

/// `x^n` for a small `n`.
fn power(x: f64, n: usize) -> f64 {
    (0..n).fold(1.0, |product, _| product * x)
}

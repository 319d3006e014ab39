//! The far field of an axially magnetised cylinder or ring: its axial multipoles.

use core::f64::consts::PI;

use super::axisymmetric::Components;
use super::edge::{GRADIENT, HESSIAN, Parts};
use super::lanes::Lanes;

/// Number of multipoles kept: the degrees 1, 3, .. 17.
pub(super) const TERMS: usize = 9;

/// Largest degree of a multipole.
pub(super) const MOST_DEGREES: usize = 2 * TERMS - 1;

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
        self.sum::<ORDER>(z, r2, self.terms(r2))
    }

    /// The scalar potential at such a point by all terms, T m: the sum of `beta_l S^0_l / (l+1)`.
    #[inline]
    pub(super) fn potential(&self, z: f64, r2: f64) -> f64 {
        let inverse2 = 1.0 / r2;
        let zonal =
            solid::<0, 1>(Lanes([inverse2.sqrt()]), Lanes([z * inverse2]), Lanes([inverse2]), 2 * TERMS);
        let degrees = (1..).step_by(2);
        self.beta.iter().zip(degrees).map(|(beta, l)| beta * zonal[l].0[0] / (l as f64 + 1.0)).sum()
    }

    /// The shear at such a point, T/m2, for magnetisation across the axis, see [`super::transverse`].
    #[inline]
    pub(super) fn shear(&self, z: f64, r2: f64) -> f64 {
        self.shear_of(Lanes([z]), Lanes([r2]), self.terms(r2)).0[0]
    }

    /// The shear by `terms` terms at points side by side: minus the sum of `beta_l S^2_{l+1} / (l (l + 1))`.
    #[expect(clippy::inline_always, reason = "compiled for several processors")]
    #[inline(always)]
    pub(super) fn shear_of<const N: usize>(&self, z: Lanes<N>, r2: Lanes<N>, terms: usize) -> Lanes<N> {
        let inverse2 = 1.0 / r2;
        let start = 3.0 * inverse2.squared() * inverse2.sqrt();
        let second = solid::<2, N>(start, z * inverse2, inverse2, 2 * terms);
        let mut sum = Lanes::all(0.0);
        for (term, beta) in self.beta.iter().enumerate().take(terms) {
            let l = 2 * term + 1;
            sum = sum + *beta / (l * (l + 1)) as f64 * second[l + 1];
        }
        -1.0 * sum
    }

    /// Number of terms that are needed at the distance `sqrt(r2)`.
    #[inline]
    fn terms(&self, r2: f64) -> usize {
        let ratio2 = r2 / self.extent2;
        REACH.iter().find(|(reach, _)| ratio2 >= reach * reach).map_or(TERMS, |&(_, terms)| terms)
    }

    /// The components by `terms` terms, anywhere beyond the extent.
    #[inline]
    pub(super) fn sum<const ORDER: u8>(&self, z: f64, r2: f64, terms: usize) -> Components {
        self.parts::<ORDER, 1>(Lanes([z]), Lanes([r2]), terms).alone()
    }

    /// The components by `terms` terms at points side by side.
    ///
    /// With `S^k_n = P_n^(k)(z/r) / r^(n+1+k)`, `P_n^(k)` the `k`-th derivative of the Legendre polynomial, `B_z` is
    /// the sum of `beta_l S^0_{l+1}`, `B_rho / rho` that of `beta_l S^1_{l+1} / (l+1)`, and each derivative along `z`
    /// raises `n` by one.
    #[expect(clippy::inline_always, reason = "compiled for several processors")]
    #[inline(always)]
    pub(super) fn parts<const ORDER: u8, const N: usize>(
        &self,
        z: Lanes<N>,
        r2: Lanes<N>,
        terms: usize,
    ) -> Parts<N> {
        let odd = self.beta.iter().take(terms).enumerate().map(|(term, beta)| (2 * term + 1, *beta));
        series::<ORDER, N>(odd, 2 * terms - 1, z, r2)
    }
}

/// The components at one point of the multipoles of the degrees 1, 2, ..., as many as there are coefficients, at most
/// [`MOST_DEGREES`].
pub(super) fn of_coefficients<const ORDER: u8>(beta: &[f64; MOST_DEGREES], z: f64, r2: f64) -> Components {
    let degrees = (1..).zip(beta.iter().copied());
    series::<ORDER, 1>(degrees, MOST_DEGREES, Lanes([z]), Lanes([r2])).alone()
}

/// The sum over multipoles, each with its degree, of which `last` is the largest; see [`Multipole::parts`].
#[expect(clippy::inline_always, reason = "compiled for several processors")]
#[inline(always)]
fn series<const ORDER: u8, const N: usize>(
    multipoles: impl Iterator<Item = (usize, f64)> + Clone,
    last: usize,
    z: Lanes<N>,
    r2: Lanes<N>,
) -> Parts<N> {
    let zero = Lanes::all(0.0);
    let inverse2 = 1.0 / r2;
    let inverse3 = inverse2 * inverse2.sqrt();
    let (along, last) = (z * inverse2, last + 1 + usize::from(ORDER));
    let zonal = solid::<0, N>(inverse3 * r2, along, inverse2, last);
    let first = solid::<1, N>(inverse3, along, inverse2, last);

    let (mut radial, mut axial) = (zero, zero);
    let (mut radial_dz, mut axial_dz, mut radial_dzz, mut axial_dzz) = (zero, zero, zero, zero);

    for (l, beta) in multipoles.clone() {
        let degree = l as f64;
        axial = axial + beta * zonal[l + 1];
        radial = radial + beta / (degree + 1.0) * first[l + 1];
        if ORDER >= GRADIENT {
            axial_dz = axial_dz - beta * (degree + 2.0) * zonal[l + 2];
            radial_dz = radial_dz - beta * first[l + 2];
        }
        if ORDER >= HESSIAN {
            axial_dzz = axial_dzz + beta * (degree + 2.0) * (degree + 3.0) * zonal[l + 3];
            radial_dzz = radial_dzz + beta * (degree + 2.0) * first[l + 3];
        }
    }

    let mut twist = zero;
    if ORDER >= HESSIAN {
        let second = solid::<2, N>(3.0 * inverse3 * inverse2, along, inverse2, last);
        for (l, beta) in multipoles {
            twist = twist + beta / (l as f64 + 1.0) * second[l + 2];
        }
    }

    Parts { radial, axial, radial_dz, axial_dz, radial_dzz, axial_dzz, twist }
}

impl Parts<1> {
    /// Those of the one point.
    fn alone(&self) -> Components {
        let [radial, axial, radial_dz, axial_dz] =
            [self.radial, self.axial, self.radial_dz, self.axial_dz].map(|part| part.0[0]);
        let [radial_dzz, axial_dzz, twist] =
            [self.radial_dzz, self.axial_dzz, self.twist].map(|part| part.0[0]);
        Components { radial, axial, radial_dz, axial_dz, radial_dzz, axial_dzz, twist }
    }
}

/// Factors of the recurrence of `S^K_n`, by `K` and `n`.
const RECURRENCE: [[[f64; 2]; DEGREES]; 3] = recurrence();

const fn recurrence() -> [[[f64; 2]; DEGREES]; 3] {
    let mut out = [[[0.0; 2]; DEGREES]; 3];
    let mut k = 0;
    while k < 3 {
        let mut n = k;
        while n < DEGREES {
            let next = (n + 1 - k) as f64;
            out[k][n] = [(2 * n + 1) as f64 / next, (n + k) as f64 / next];
            n += 1;
        }
        k += 1;
    }
    out
}

/// `S^K_n` for `n` up to `last`, from `start = S^K_K`, `along = z / r^2` and `inverse2 = 1 / r^2`.
///
/// `(n - K + 1) S^K_{n+1} = (2n + 1) (z/r^2) S^K_n - (n + K) S^K_{n-1} / r^2`.
#[expect(clippy::inline_always, reason = "compiled for several processors")]
#[inline(always)]
fn solid<const K: usize, const N: usize>(
    start: Lanes<N>,
    along: Lanes<N>,
    inverse2: Lanes<N>,
    last: usize,
) -> [Lanes<N>; DEGREES] {
    let mut values = [Lanes::all(0.0); DEGREES];
    values[K] = start;
    let mut before = Lanes::all(0.0);
    for n in K..last.min(DEGREES - 1) {
        let here = values[n];
        let [forth, back] = RECURRENCE[K][n];
        values[n + 1] = forth * along * here - back * inverse2 * before;
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

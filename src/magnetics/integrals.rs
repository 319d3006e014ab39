//! Complete elliptic integrals of a circular edge, from one run of the arithmetic-geometric mean (AGM).

#![expect(
    clippy::inline_always,
    reason = "the batch of points compiles these formulas for several processors"
)]

use core::f64::consts::FRAC_PI_2;

use super::lanes::Lanes;

/// Relative difference of the two means below which only one more step is made; the error is a sixteenth of its square.
const LAST_STEP: f64 = 4e-8;

/// Largest number of steps: seven suffice for the smallest `kc` that can occur (about 1e-15).
const MOST_STEPS: i32 = 12;

/// Fourth power of the parameter `m` below which the means' differences from the third on are below the rounding of `t2`.
const SMALL: f64 = 6.25e-10;

/// The integrals of parameter `m = 1 - kc^2`, and combinations of them without cancellation.
///
/// ```text
/// t  = ((1 - m/2) K - E) / (m^2 K)      t2 = (t - 1/16 - m/32) / m^2      g = 1/2 - (2 - m) t
/// third = cel(kc, gamma^2, 1, gamma) = integral of (cos^2 + gamma sin^2) / ((cos^2 + gamma^2 sin^2) sqrt(cos^2 + kc^2 sin^2))
/// ```
///
/// The differences of `K` and `E` are sums of the AGM's `c_n`, which are computed by `c_{n+1} = c_n^2 / (4 a_{n+1})`
/// and not as differences of the means.
///
/// Source: Abramowitz and Stegun 17.6; R. Bulirsch, Numerische Mathematik 7 (1965) and 13 (1969), for `cel`.
pub(super) struct Integrals<const N: usize> {
    /// `K`.
    pub(super) first: Lanes<N>,
    /// `E`.
    pub(super) second: Lanes<N>,
    /// `cel(kc, gamma^2, 1, gamma)`; `K` for `gamma = 0`, the mean of both sides.
    pub(super) third: Lanes<N>,
    pub(super) t: Lanes<N>,
    pub(super) t2: Lanes<N>,
    pub(super) g: Lanes<N>,
}

impl<const N: usize> Integrals<N> {
    /// The integrals of the parameter `m`, the complementary modulus `kc = sqrt(1 - m) > 0` and `gamma` in `[-1, 1]`.
    #[inline]
    pub(super) fn new(m: Lanes<N>, kc: Lanes<N>, gamma: Lanes<N>) -> Self {
        let sum = 1.0 + kc;
        let m2 = m.squared();
        let (mut a, mut g) = (Lanes::all(1.0), kc);
        let mut p = gamma.map(|ratio| if ratio == 0.0 { 1.0 } else { ratio.abs() });
        let (mut cosine, mut sine) = (Lanes::all(1.0), gamma.map(|ratio| 1.0_f64.copysign(ratio)));
        let mut v = Lanes::all(0.0); // c_n / m^2
        let mut u = Lanes::all(0.0); // sum of 2^(n-1) v_n^2 from n = 2
        let mut weight = 1.0;
        for step in 0..MOST_STEPS {
            let last = step > 0 && (0..N).all(|i| (a.0[i] - g.0[i]).abs() <= LAST_STEP * a.0[i]);
            let product = a * g;
            let inverse_p = 1.0 / p;
            let x = product * inverse_p;
            (cosine, sine) = (0.5 * (cosine + sine * inverse_p), 0.5 * (cosine * x + sine));
            p = 0.5 * (p + x);
            a = 0.5 * (a + g);
            g = product.sqrt();
            if step > 0 {
                v = if step == 1 { 1.0 / (16.0 * sum.squared() * a) } else { 0.25 * m2 * v.squared() / a };
                u = u + weight * v.squared();
            }
            weight *= 2.0;
            if last {
                break;
            }
        }
        let sum2 = sum.squared();
        let t2 = (5.0 + kc * (4.0 + kc)) / (32.0 * sum2.squared()) + u;
        let t = 1.0 / 16.0 + m * (1.0 / 32.0) + m2 * t2;
        let first = FRAC_PI_2 / a;
        let third = first * (sine + cosine * a) / (a + p);
        Self {
            first,
            second: first * (1.0 - 0.5 * m - m2 * t),
            third: Lanes::select(|i| gamma.0[i] == 0.0, first, third),
            t,
            t2,
            g: 0.5 - (2.0 - m) * t,
        }
    }

    /// All integrals for `gamma = numerator / denominator` by a fixed number of steps, with one division.
    ///
    /// The third kind is carried as a quotient, with numerators `c`, `s` of cosine and sine over `d`, and the means'
    /// differences from the third on are subtractions: their errors do not count there. The denominator is of order one.
    #[inline(always)]
    pub(super) fn with_steps<const STEPS: u32>(
        m: Lanes<N>,
        kc: Lanes<N>,
        [numerator, denominator]: [Lanes<N>; 2],
    ) -> Self {
        let on_wall = |i: usize| numerator.0[i] == 0.0;
        let one = Lanes::all(1.0);
        let (mut a, mut g) = (one, kc);
        let mut p = Lanes::select(on_wall, denominator, numerator.map(f64::abs));
        let mut q = denominator;
        let (mut c, mut s, mut d) = (one, numerator.map(|value| 1.0_f64.copysign(value)), one);
        let mut second_mean = one;
        let mut rest = Lanes::all(0.0); // sum of 2^(n-1) c_n^2 from n = 3
        let mut weight = 1.0;
        for step in 0..STEPS {
            let product = a * g;
            let scaled = product * q;
            (c, s) = (c * p + s * q, c * scaled + s * p);
            d = 2.0 * d * p;
            (p, q) = (p.squared() + scaled * q, 2.0 * p * q);
            if step > 1 {
                rest = rest + weight * (0.5 * (a - g)).squared();
            }
            weight *= 2.0;
            a = 0.5 * (a + g);
            if step + 1 < STEPS {
                g = product.sqrt();
            }
            if step == 1 {
                second_mean = a;
            }
        }
        let m2 = m.squared();
        let m4 = m2.squared().max(Lanes::all(SMALL));
        let sum2 = (1.0 + kc).squared();
        // Reciprocals of 16 sum^2 a_2, a, d (a q + p) and m^4 from that of their product.
        let (first, second, third) = (16.0 * sum2 * second_mean, a, d * (a * q + p));
        let (left, right) = (first * second, third * m4);
        let whole = 1.0 / (left * right);
        let (inverse_left, inverse_right) = (whole * right, whole * left);
        let v2 = inverse_left * second;
        let inverse_sum2 = 16.0 * second_mean * v2;
        let t2 = (5.0 + kc * (4.0 + kc)) * inverse_sum2.squared() * (1.0 / 32.0)
            + 2.0 * v2.squared()
            + rest * (inverse_right * third);
        let t = 1.0 / 16.0 + m * (1.0 / 32.0) + m2 * t2;
        let first_kind = FRAC_PI_2 * (inverse_left * first);
        let third_kind = first_kind * ((s + c * a) * q * (inverse_right * m4));
        Self {
            first: first_kind,
            second: first_kind * (1.0 - 0.5 * m - m2 * t),
            third: Lanes::select(on_wall, first_kind, third_kind),
            t,
            t2,
            g: 0.5 - (2.0 - m) * t,
        }
    }
}

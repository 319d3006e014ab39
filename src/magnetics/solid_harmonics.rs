//! The far field of a body of any shape: a series of irregular solid harmonics.
//!
//! With `Theta_n^m = (-1)^m (n - m)! P_n^m(cos theta) e^(i m phi) / r^(n+1)` (Dehnen, Computational Astrophysics and Cosmology 1 (2014), 1,
//! doi:10.1186/s40668-014-0001-7, appendix A) every derivative is another one of them:
//!
//! ```text
//! d_z Theta_n^m = -Theta_{n+1}^m    (d_x + i d_y) Theta_n^m = -Theta_{n+1}^{m+1}    (d_x - i d_y) Theta_n^m = Theta_{n+1}^{m-1}
//! ```

use core::f64::consts::PI;

use nalgebra::{Complex, Matrix3, Vector3};

use super::jet::{FieldHessian, Jet};
use crate::numerics::quadrature::gauss_legendre;

/// Largest degree of the series of the field's potential; degrees are odd.
const MOST: usize = 15;

/// Largest degree of the harmonics: up to the third derivative.
const LAST: usize = MOST + 3;

/// Nodes along each axis for the moments: exact for polynomials of twice the degree.
const NODES: usize = MOST.div_ceil(2) + 1;

/// Degrees whose share is below this of the dipole's are left out.
const NEGLIGIBLE: f64 = 1e-16;

/// Number of the harmonic of degree `n` and order `m >= 0`.
const fn number(n: usize, m: usize) -> usize {
    n * (n + 1) / 2 + m
}

/// The potential `psi` of the field `B = grad psi` (T) of a uniformly magnetised body, seen from outside.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct SolidHarmonics {
    /// Unit of length, m.
    extent: f64,
    /// Degree, order and coefficient (T) of each harmonic whose coefficient is not zero, by ascending degree.
    terms: Vec<(usize, usize, Complex<f64>)>,
}

/// The harmonics at a point, by [`number`].
struct Harmonics([Complex<f64>; number(LAST + 1, 0)]);

impl SolidHarmonics {
    /// Those of a cuboid with these halves of its edges (m) and this remanence (T).
    pub(super) fn of_cuboid(half: &Vector3<f64>, remanence: &Vector3<f64>) -> Self {
        let extent = half.norm();
        let moments = moments(&(half / extent));
        let across = Complex::new(remanence.x, -remanence.y);
        let mut out = vec![Complex::new(0.0, 0.0); number(MOST + 1, 0)];
        for n in (0..MOST).step_by(2) {
            for m in (0..=n).step_by(2) {
                // Orders m and -m of a real potential together are twice the real part of one.
                let moment = moments[number(n, m)] * if m > 0 { 2.0 } else { 1.0 };
                out[number(n + 1, m)] -= Complex::from(remanence.z * moment);
                out[number(n + 1, m + 1)] -= across * (0.5 * moment);
                if m > 0 {
                    out[number(n + 1, m - 1)] += across.conj() * (0.5 * moment);
                } else {
                    out[number(n + 1, 1)] -= across * (0.5 * moment);
                }
            }
        }
        let orders = (1..=MOST).step_by(2).flat_map(|n| (0..=n).map(move |m| (n, m)));
        let terms = orders.map(|(n, m)| (n, m, out[number(n, m)]));
        Self { extent, terms: terms.filter(|(.., value)| value.norm() > 0.0).collect() }
    }

    /// Harmonics at a point (m), and the largest degree that counts there.
    fn at(&self, point: &Vector3<f64>) -> (Harmonics, usize) {
        let point = point / self.extent;
        let nearness = 1.0 / point.norm();
        let mut degree = 1;
        let mut share = nearness * nearness;
        while degree < MOST && share > NEGLIGIBLE {
            degree += 2;
            share *= nearness * nearness;
        }
        (Harmonics::new(&point, degree + 3), degree)
    }

    /// Sums of the harmonics `order` degrees up, shifted by `-ORDER ..= ORDER` in `m`.
    fn sums<const ORDER: usize, const SHIFTS: usize>(
        &self,
        (harmonics, degree): &(Harmonics, usize),
    ) -> [Complex<f64>; SHIFTS] {
        let mut out = [Complex::new(0.0, 0.0); SHIFTS];
        for (n, m, coefficient) in self.terms.iter().take_while(|(n, ..)| n <= degree) {
            for (sum, shift) in out.iter_mut().zip(0..) {
                *sum += coefficient * harmonics.shifted(n + ORDER, *m, shift, ORDER);
            }
        }
        out
    }

    /// `B`, T, at a point (m) beyond the extent.
    pub(super) fn field(&self, point: &Vector3<f64>) -> Vector3<f64> {
        self.field_by(&self.at(point))
    }

    /// `B`, T, and `dB_i/dx_j`, T/m.
    pub(super) fn field_gradient(&self, point: &Vector3<f64>) -> (Vector3<f64>, Matrix3<f64>) {
        let at = self.at(point);
        (self.field_by(&at), self.gradient_by(&at))
    }

    /// `B`, its gradient and its second derivative.
    pub(super) fn jet(&self, point: &Vector3<f64>) -> Jet {
        let at = self.at(point);
        Jet { field: self.field_by(&at), gradient: self.gradient_by(&at), hessian: self.hessian_by(&at) }
    }

    fn field_by(&self, at: &(Harmonics, usize)) -> Vector3<f64> {
        let [minus, zero, plus] = self.sums::<1, 3>(at);
        Vector3::new(0.5 * (minus - plus).re, -0.5 * (plus + minus).im, -zero.re)
    }

    fn gradient_by(&self, at: &(Harmonics, usize)) -> Matrix3<f64> {
        let [minus2, minus, zero, plus, plus2] = self.sums::<2, 5>(at);
        let (sum, half) = (0.25 * (plus2 + minus2).re, 0.5 * zero.re);
        let xy = 0.25 * (plus2 - minus2).im;
        let (xz, yz) = (0.5 * (plus - minus).re, 0.5 * (plus + minus).im);
        Matrix3::new(sum - half, xy, xz, xy, -sum - half, yz, xz, yz, zero.re) / self.extent
    }

    fn hessian_by(&self, at: &(Harmonics, usize)) -> FieldHessian {
        let [minus3, minus2, minus, zero, plus, plus2, plus3] = self.sums::<3, 7>(at);
        let zzz = -zero.re;
        // The derivatives (d_x + i d_y)^3 and so on, of which D+ D- = -d_z^2.
        let (three, two_one, one_two, down) = (-plus3, plus, -minus, minus3);
        let xxx = 0.125 * (three + 3.0 * two_one + 3.0 * one_two + down).re;
        let xxy = 0.125 * (three + two_one - one_two - down).im;
        let xyy = -0.125 * (three - two_one - one_two + down).re;
        let yyy = -0.125 * (three - 3.0 * two_one + 3.0 * one_two - down).im;
        let sum = -0.25 * (plus2 + minus2).re;
        let xyz = 0.25 * (minus2 - plus2).im;
        let (xzz, yzz) = (0.5 * (minus - plus).re, -0.5 * (plus + minus).im);
        let entries = [xxx, xxy, sum - 0.5 * zzz, xyy, xyz, xzz, yyy, -sum - 0.5 * zzz, yzz, zzz];
        FieldHessian(entries.map(|entry| entry / (self.extent * self.extent)))
    }
}

impl Harmonics {
    /// Up to the degree `last`.
    fn new(point: &Vector3<f64>, last: usize) -> Self {
        let mut out = [Complex::new(0.0, 0.0); number(LAST + 1, 0)];
        let inverse2 = 1.0 / point.norm_squared();
        let across = Complex::new(point.x, point.y) * inverse2;
        let along = point.z * inverse2;
        out[0] = Complex::from(inverse2.sqrt());
        for n in 1..=last {
            let steps = (2 * n - 1) as f64;
            out[number(n, n)] = across * out[number(n - 1, n - 1)] * steps;
            for m in 0..n {
                let before = out[number(n - 1, m)] * (steps * along);
                let second = if m + 2 <= n { out[number(n - 2, m)] } else { Complex::from(0.0) };
                out[number(n, m)] = before - second * (((n - 1) * (n - 1) - m * m) as f64 * inverse2);
            }
        }
        Self(out)
    }

    /// The harmonic of degree `n` and order `m + shift - back`, which may be negative.
    #[inline]
    fn shifted(&self, n: usize, m: usize, shift: usize, back: usize) -> Complex<f64> {
        if let Some(order) = (m + shift).checked_sub(back) {
            return self.0[number(n, order)];
        }
        let order = back - m - shift;
        let mirrored = self.0[number(n, order)].conj();
        if order.is_multiple_of(2) { mirrored } else { -mirrored }
    }
}

/// Volume integrals of the regular harmonics `r^n P_n^m e^(-i m phi) (-1)^m / (n + m)!` of even degree and order over a cuboid, over `4 pi`; of
/// others they are zero.
fn moments(half: &Vector3<f64>) -> Vec<f64> {
    let mut out = vec![0.0; number(MOST + 1, 0)];
    let (nodes, weights) = gauss_legendre(NODES);
    let volume = half.product();
    for (x, by_x) in nodes.iter().zip(&weights) {
        for (y, by_y) in nodes.iter().zip(&weights) {
            for (z, by_z) in nodes.iter().zip(&weights) {
                let point = Vector3::new(*x, *y, *z).component_mul(half);
                let weight = volume * by_x * by_y * by_z / (4.0 * PI);
                add_regular(&point, weight, &mut out);
            }
        }
    }
    out
}

/// Adds the real parts of the regular harmonics at a point, each times `weight`.
fn add_regular(point: &Vector3<f64>, weight: f64, out: &mut [f64]) {
    let r2 = point.norm_squared();
    let across = Complex::new(point.x, point.y);
    let mut values = vec![Complex::from(0.0); out.len()];
    values[0] = Complex::from(1.0);
    out[0] += weight;
    for n in 1..MOST {
        for m in 0..n {
            let before = values[number(n - 1, m)] * ((2 * n - 1) as f64 * point.z);
            let second = if m + 2 <= n { values[number(n - 2, m)] * r2 } else { Complex::from(0.0) };
            values[number(n, m)] = (before - second) / ((n * n - m * m) as f64);
        }
        values[number(n, n)] = values[number(n - 1, n - 1)] * across / (2 * n) as f64;
        for m in 0..=n {
            out[number(n, m)] += weight * values[number(n, m)].re;
        }
    }
}

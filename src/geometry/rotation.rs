//! The exponential of a rotation vector and its first and second derivatives, without singularity at zero.
//!
//! With `z = |theta|^2` and the Stumpff functions `c_k(z) = sum_j (-z)^j / (2j + k)!`,
//!
//! - rotation `exp = c0 1 + c1 hat + c2 theta theta^T`,
//! - left Jacobian `J_l = c1 1 + c2 hat + c3 theta theta^T`, right Jacobian `J_r = J_l^T`,
//! - `dc_k/dz = (k c_{k+2} - c_{k+1}) / 2`.
//!
//! Every scalar that is linear in one of these matrices has the form
//! `a0(z) t + a1(z) theta.w + a2(z) theta^T M theta`, so that one function gives all second derivatives.

use nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3};

/// Squared angle above which the Stumpff functions are computed from sine and cosine, below it from their series.
const SERIES_LIMIT: f64 = 12.0;

/// Number of terms of the series: at `SERIES_LIMIT` the first neglected one is below 1e-17 of the sum.
const SERIES_TERMS: usize = 12;

/// Squared angle below which half of the terms suffice.
const SHORT_LIMIT: f64 = 0.5;

/// Coefficients `(-1)^j k! / (2j + k)!` of the series of `k! c_k`.
const fn series(k: usize) -> [f64; SERIES_TERMS] {
    let mut out = [1.0; SERIES_TERMS];
    let mut j = 1;
    while j < SERIES_TERMS {
        let n = (2 * j + k) as f64;
        out[j] = -out[j - 1] / (n * (n - 1.0));
        j += 1;
    }
    out
}

const SIXTH: [f64; SERIES_TERMS] = series(6);
const SEVENTH: [f64; SERIES_TERMS] = series(7);

/// The matrix of the cross product, `hat(a) b = a x b`.
#[must_use]
pub fn hat(a: &Vector3<f64>) -> Matrix3<f64> {
    Matrix3::new(0.0, -a.z, a.y, a.z, 0.0, -a.x, -a.y, a.x, 0.0)
}

/// The vector `t` with `t.a = N : hat(a)` for every `a`: twice the axial vector of `N`.
#[must_use]
pub fn axial(n: &Matrix3<f64>) -> Vector3<f64> {
    Vector3::new(n.m32 - n.m23, n.m13 - n.m31, n.m21 - n.m12)
}

/// Stumpff functions `c_0 .. c_7` of `z`.
fn stumpff(z: f64) -> [f64; 8] {
    let mut c = [0.0; 8];

    // Upwards, c_{k+2} = (1 / k! - c_k) / z, where z is large enough that little cancels.
    if z > SERIES_LIMIT {
        let angle = z.sqrt();
        c[0] = angle.cos();
        c[1] = angle.sin() / angle;
        let mut factorial = 1.0;
        for k in 0..6 {
            factorial *= (k.max(1)) as f64;
            c[k + 2] = (1.0 / factorial - c[k]) / z;
        }
        return c;
    }

    // Below, series for the last two (here as k! c_k, by Horner's rule), and the recurrence downwards: it
    // divides by nothing.
    let terms = if z < SHORT_LIMIT { SERIES_TERMS / 2 } else { SERIES_TERMS };
    let (mut six, mut seven) = (0.0, 0.0);
    for (sixth, seventh) in SIXTH[..terms].iter().zip(&SEVENTH[..terms]).rev() {
        six = six * z + sixth;
        seven = seven * z + seventh;
    }

    c[6] = six / 720.0;
    c[7] = seven / 5040.0;
    c[5] = 1.0 / 120.0 - z * c[7];
    c[4] = 1.0 / 24.0 - z * c[6];
    c[3] = 1.0 / 6.0 - z * c[5];
    c[2] = 0.5 - z * c[4];
    c[1] = 1.0 - z * c[3];
    c[0] = 1.0 - z * c[2];

    c
}

/// A rotation vector with the Stumpff functions of its matrix and derivatives.
#[derive(Debug, Clone, Copy)]
pub struct RotationVector {
    vector: Vector3<f64>,
    c: [f64; 8],
}

impl RotationVector {
    /// The rotation vector `vector` (rad) with its Stumpff functions.
    #[must_use]
    pub fn new(vector: Vector3<f64>) -> Self {
        Self { vector, c: stumpff(vector.norm_squared()) }
    }

    /// The rotation matrix `exp(theta)`.
    #[must_use]
    pub fn matrix(&self) -> Matrix3<f64> {
        self.combine(0, 1.0)
    }

    /// The left Jacobian: a change `d` of the vector rotates the frame by `J_l d` in fixed axes.
    #[must_use]
    pub fn left_jacobian(&self) -> Matrix3<f64> {
        self.combine(1, 1.0)
    }

    /// The right Jacobian: a change `d` of the vector rotates the frame by `J_r d` in its own axes.
    #[must_use]
    pub fn right_jacobian(&self) -> Matrix3<f64> {
        self.combine(1, -1.0)
    }

    /// Inverse of the left Jacobian; `None` near a full turn, where it does not exist.
    #[must_use]
    pub fn left_jacobian_inverse(&self) -> Option<Matrix3<f64>> {
        self.left_jacobian().try_inverse().filter(|inverse| inverse.iter().all(|entry| entry.abs() < 1e6))
    }

    /// Gradient and Hessian of `N : exp(theta)` with respect to the vector.
    #[must_use]
    pub fn contract_rotation(&self, n: &Matrix3<f64>) -> (Vector3<f64>, Matrix3<f64>) {
        self.contract(0, 1.0, n.trace(), &axial(n), n)
    }

    /// Gradient of `N : exp(theta)` with respect to the vector.
    #[must_use]
    pub fn rotation_gradient(&self, n: &Matrix3<f64>) -> Vector3<f64> {
        let v = &self.vector;
        let w = axial(n);
        let g = n * v + n.tr_mul(v);
        let first = self.slope(0) * n.trace() + self.slope(1) * v.dot(&w) + self.slope(2) * 0.5 * v.dot(&g);
        v * (2.0 * first) + w * self.c[1] + g * self.c[2]
    }

    /// Hessian of `m . J_r(theta) rate` with respect to the vector.
    #[must_use]
    pub fn contract_curvature(&self, m: &Vector3<f64>, rate: &Vector3<f64>) -> Matrix3<f64> {
        self.contract(1, -1.0, m.dot(rate), &-m.cross(rate), &(m * rate.transpose())).1
    }

    /// Derivative of `J_l(theta) m` with respect to the vector.
    #[must_use]
    pub fn left_product_derivative(&self, m: &Vector3<f64>) -> Matrix3<f64> {
        self.product_derivative(m, 1.0)
    }

    /// Derivative of `J_r(theta) m` with respect to the vector.
    #[must_use]
    pub fn right_product_derivative(&self, m: &Vector3<f64>) -> Matrix3<f64> {
        self.product_derivative(m, -1.0)
    }

    fn combine(&self, k: usize, sign: f64) -> Matrix3<f64> {
        let v = &self.vector;
        let mut out = v * (v.transpose() * self.c[k + 2]) + hat(v) * (sign * self.c[k + 1]);
        for i in 0..3 {
            out[(i, i)] += self.c[k];
        }
        out
    }

    fn slope(&self, k: usize) -> f64 {
        0.5 * (k as f64 * self.c[k + 2] - self.c[k + 1])
    }

    fn second_slope(&self, k: usize) -> f64 {
        0.5 * (k as f64 * self.slope(k + 2) - self.slope(k + 1))
    }

    fn product_derivative(&self, m: &Vector3<f64>, sign: f64) -> Matrix3<f64> {
        let v = &self.vector;
        let along = v.dot(m);
        let outer = m * (2.0 * self.slope(1))
            + v.cross(m) * (2.0 * sign * self.slope(2))
            + v * (2.0 * self.slope(3) * along);
        let mut out = outer * v.transpose() - hat(m) * (sign * self.c[2]) + v * (m.transpose() * self.c[3]);
        for i in 0..3 {
            out[(i, i)] += self.c[3] * along;
        }
        out
    }

    /// Gradient and Hessian of `c_k t + sign c_{k+1} theta.w + c_{k+2} theta^T M theta`.
    fn contract(
        &self,
        k: usize,
        sign: f64,
        t: f64,
        w: &Vector3<f64>,
        m: &Matrix3<f64>,
    ) -> (Vector3<f64>, Matrix3<f64>) {
        let v = &self.vector;

        let symmetric = m + m.transpose();
        let g = symmetric * v;
        let along = sign * v.dot(w);
        let quadratic = 0.5 * v.dot(&g);

        // By the chain rule, since z = theta.theta: d f(z) = 2 f'(z) theta.d theta.
        let first = self.slope(k) * t + self.slope(k + 1) * along + self.slope(k + 2) * quadratic;
        let second = self.second_slope(k) * t
            + self.second_slope(k + 1) * along
            + self.second_slope(k + 2) * quadratic;

        let linear = w * (sign * self.c[k + 1]) + g * self.c[k + 2];
        let mixed = w * (2.0 * sign * self.slope(k + 1)) + g * (2.0 * self.slope(k + 2)) + v * (2.0 * second);
        let product = v * mixed.transpose();
        let mut hessian = product + product.transpose() + symmetric * self.c[k + 2];
        for i in 0..3 {
            hessian[(i, i)] += 2.0 * first;
        }
        (v * (2.0 * first) + linear, hessian)
    }
}

/// The rotation vector of a rotation matrix, of norm at most pi.
#[must_use]
pub fn rotation_log(rotation: &Matrix3<f64>) -> Vector3<f64> {
    UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(*rotation)).scaled_axis()
}

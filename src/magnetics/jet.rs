//! A field with its first and second derivatives at one point.

use core::ops::{Add, AddAssign, Mul};

use nalgebra::{Matrix3, Vector3};

/// The ten entries of the fully symmetric second derivative of a curl-free field, T/m2, in the order
/// xxx, xxy, xxz, xyy, xyz, xzz, yyy, yyz, yzz, zzz.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct FieldHessian(pub [f64; 10]);

impl FieldHessian {
    /// The indices `i <= j <= k` of the ten entries.
    pub const INDICES: [[usize; 3]; 10] = [
        [0, 0, 0],
        [0, 0, 1],
        [0, 0, 2],
        [0, 1, 1],
        [0, 1, 2],
        [0, 2, 2],
        [1, 1, 1],
        [1, 1, 2],
        [1, 2, 2],
        [2, 2, 2],
    ];

    /// Entry `d2B_i / dx_j dx_k`, indices 0 to 2 in any order.
    ///
    /// ```
    /// use mcm::magnetics::FieldHessian;
    /// let hessian = FieldHessian([0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0]);
    /// assert_eq!(hessian.entry(2, 0, 1), 4.0);
    /// ```
    #[must_use]
    pub fn entry(&self, i: usize, j: usize, k: usize) -> f64 {
        let ys = usize::from(i == 1) + usize::from(j == 1) + usize::from(k == 1);
        let zs = usize::from(i == 2) + usize::from(j == 2) + usize::from(k == 2);
        let not_x = ys + zs;
        self.0[not_x * (not_x + 1) / 2 + zs]
    }

    /// `sum_i d_i d2B_i / dx_j dx_k`: the derivative of `G^T d`, equally that of `G` along `d`.
    #[must_use]
    pub fn along(&self, d: &Vector3<f64>) -> Matrix3<f64> {
        let [xxx, xxy, xxz, xyy, xyz, xzz, yyy, yyz, yzz, zzz] = self.0;
        let xx = d.x * xxx + d.y * xxy + d.z * xxz;
        let xy = d.x * xxy + d.y * xyy + d.z * xyz;
        let xz = d.x * xxz + d.y * xyz + d.z * xzz;
        let yy = d.x * xyy + d.y * yyy + d.z * yyz;
        let yz = d.x * xyz + d.y * yyz + d.z * yzz;
        let zz = d.x * xzz + d.y * yzz + d.z * zzz;
        Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz)
    }
}

/// Field, gradient and second derivative at one point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Jet {
    /// Flux density `B`, T.
    pub field: Vector3<f64>,
    /// `dB_i / dx_j` in row `i`, column `j`, T/m; symmetric and traceless in free space.
    pub gradient: Matrix3<f64>,
    /// `d2B_i / dx_j dx_k`, T/m2.
    pub hessian: FieldHessian,
}

impl Jet {
    /// The jet of a vanishing field.
    #[must_use]
    pub fn zero() -> Self {
        Self { field: Vector3::zeros(), gradient: Matrix3::zeros(), hessian: FieldHessian::default() }
    }

    /// `sum_i d_i d2B_i / dx_j dx_k`, T/m2 times the unit of `d`.
    #[must_use]
    pub fn hessian_along(&self, d: &Vector3<f64>) -> Matrix3<f64> {
        self.hessian.along(d)
    }

    /// The jet in the axes of a frame in which this one's axes are the columns of `rotation`.
    ///
    /// `B' = R B`, `G' = R G R^T`, `H'_kij = sum R_kc R_ia R_jb H_cab`.
    #[must_use]
    pub fn rotated(&self, rotation: &Matrix3<f64>) -> Self {
        let turned = |axis: usize| {
            let row: Vector3<f64> = rotation.row(axis).transpose();
            rotation * self.hessian.along(&row) * rotation.transpose()
        };
        let (x, y, z) = (turned(0), turned(1), turned(2));
        Self {
            field: rotation * self.field,
            gradient: rotation * self.gradient * rotation.transpose(),
            hessian: FieldHessian([
                x[(0, 0)],
                x[(0, 1)],
                x[(0, 2)],
                x[(1, 1)],
                x[(1, 2)],
                x[(2, 2)],
                y[(1, 1)],
                y[(1, 2)],
                y[(2, 2)],
                z[(2, 2)],
            ]),
        }
    }
}

impl AddAssign for Jet {
    fn add_assign(&mut self, other: Self) {
        self.field += other.field;
        self.gradient += other.gradient;
        for (entry, added) in self.hessian.0.iter_mut().zip(other.hessian.0) {
            *entry += added;
        }
    }
}

impl Add for Jet {
    type Output = Self;

    fn add(mut self, other: Self) -> Self {
        self += other;
        self
    }
}

impl Mul<f64> for Jet {
    type Output = Self;

    fn mul(self, factor: f64) -> Self {
        Self {
            field: self.field * factor,
            gradient: self.gradient * factor,
            hessian: FieldHessian(self.hessian.0.map(|entry| entry * factor)),
        }
    }
}

//! Interpolation on a regular grid in space by cubic B-splines, with two continuous derivatives.

use nalgebra::{Matrix3, Vector3};
use serde::{Deserialize, Serialize};

use crate::error::{Error, check};

/// Fewest nodes along an axis: those of a single cell.
const FEWEST: f64 = 4.0;

/// Largest number of nodes: 256 MB in double precision, while the coefficients are computed.
pub const MOST_NODES: usize = 1 << 25;

/// A function in space, given at the nodes of a grid with unit spacing: node `(i, j, k)` lies at the point with these
/// coordinates.
///
/// It is a sum of products of three cubic B-splines: value, gradient and second derivative are continuous, and come from the
/// 64 coefficients around a point. It goes through the values given; its second derivative along an axis vanishes at both ends
/// of that axis. For a smooth function the error is of fourth order in the spacing, that of the gradient of third and
/// that of the second derivative of second order. The effect of a kink falls by 0.27 with every cell of distance from it.
///
/// Coefficients are rounded to single precision: 6e-8 of a value.
///
/// M. Unser, A. Aldroubi, M. Eden, B-spline signal processing, doi 10.1109/78.193220 (part I) and 10.1109/78.193221 (part II).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Stored")]
pub struct Tricubic {
    counts: [usize; 3],
    /// The first coordinate runs fastest.
    coefficients: Vec<f32>,
}

/// Value, gradient and second derivative of a function at a point in space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpacePoint {
    /// The value.
    pub value: f64,
    /// Its gradient.
    pub gradient: Vector3<f64>,
    /// Its second derivative.
    pub hessian: Matrix3<f64>,
}

impl Tricubic {
    /// The function with these values at the nodes, the first coordinate running fastest.
    ///
    /// ```
    /// use mcm::numerics::tricubic::Tricubic;
    /// use nalgebra::Vector3;
    /// let plane = |x: f64, y: f64, z: f64| 1.0 + 2.0 * x - 3.0 * y + 0.5 * z;
    /// let nodes = (0..4 * 5 * 6).map(|n| plane((n % 4) as f64, (n / 4 % 5) as f64, (n / 20) as f64));
    /// let function = Tricubic::new([4, 5, 6], nodes.collect())?;
    /// let told = function.at(&Vector3::new(1.3, 2.5, 1.9));
    /// assert!((told.value - plane(1.3, 2.5, 1.9)).abs() < 1e-5);
    /// assert!((told.gradient - Vector3::new(2.0, -3.0, 0.5)).norm() < 1e-5);
    /// assert!(Tricubic::new([4, 4, 4], vec![0.0; 63]).is_err());
    /// # Ok::<(), mcm::error::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Range`] for fewer than 4 nodes along an axis, for more than [`MOST_NODES`], and for a value that is not finite
    /// in single precision; [`Error::Count`] for another number of values.
    pub fn new(counts: [usize; 3], mut values: Vec<f64>) -> Result<Self, Error> {
        to_coefficients(counts, &mut values)?;
        Self::try_from(Stored { counts, coefficients: rounded(&values) })
    }

    /// Numbers of nodes along the axes.
    #[must_use]
    pub fn counts(&self) -> [usize; 3] {
        self.counts
    }

    /// Value and derivatives at a point whose coordinates are between 1 and two less than the number of nodes along the axis;
    /// beyond that the cubics of the outermost cells go on.
    #[must_use]
    pub fn at(&self, point: &Vector3<f64>) -> SpacePoint {
        let (first, weights) = cell(self.counts, point);
        weighted(&self.around(first), &weights)
    }

    /// The coefficients, the first coordinate running fastest.
    pub(super) fn coefficients(&self) -> &[f32] {
        &self.coefficients
    }

    /// The 64 coefficients from this node on, row by row.
    pub(super) fn around(&self, first: [usize; 3]) -> [[f32; 4]; 16] {
        core::array::from_fn(|row| {
            let [j, k] = [first[1] + row % 4, first[2] + row / 4];
            let start = (k * self.counts[1] + j) * self.counts[0] + first[0];
            core::array::from_fn(|i| self.coefficients[start + i])
        })
    }
}

/// How a function is read.
#[derive(Deserialize)]
struct Stored {
    counts: [usize; 3],
    coefficients: Vec<f32>,
}

impl TryFrom<Stored> for Tricubic {
    type Error = Error;

    fn try_from(Stored { counts, coefficients }: Stored) -> Result<Self, Error> {
        check_length("coefficients of a grid", coefficients.len(), checked_nodes(counts)?)?;
        check_finite(&coefficients)?;
        Ok(Self { counts, coefficients })
    }
}

/// Turns values at nodes into coefficients.
pub(super) fn to_coefficients(counts: [usize; 3], values: &mut [f64]) -> Result<(), Error> {
    check_length("values at the nodes of a grid", values.len(), checked_nodes(counts)?)?;
    let mut stride = 1;
    for count in counts {
        filter(values, stride, count);
        stride *= count;
    }
    Ok(())
}

/// In single precision.
#[expect(clippy::cast_possible_truncation, reason = "said to be rounded")]
pub(super) fn rounded(coefficients: &[f64]) -> Vec<f32> {
    coefficients.iter().map(|coefficient| *coefficient as f32).collect()
}

/// Number of nodes.
pub(super) fn checked_nodes(counts: [usize; 3]) -> Result<usize, Error> {
    for count in counts {
        check("number of nodes along an axis of a grid", count as f64, |v| v >= FEWEST, "at least 4")?;
    }
    let nodes = counts.iter().map(|count| *count as f64).product();
    check("number of nodes of a grid", nodes, |v| v <= MOST_NODES as f64, "at most 2^25")?;
    Ok(counts.iter().product())
}

pub(super) fn check_length(quantity: &str, given: usize, expected: usize) -> Result<(), Error> {
    if given == expected {
        return Ok(());
    }
    Err(Error::Count { quantity: quantity.into(), given, expected: expected.to_string() })
}

pub(super) fn check_finite(coefficients: &[f32]) -> Result<(), Error> {
    for coefficient in coefficients {
        check("coefficient of a grid", f64::from(*coefficient), |_| true, "finite in single precision")?;
    }
    Ok(())
}

/// The B-splines of four nodes along each axis: values, first and second derivatives.
pub(super) type Weights = [[[f64; 4]; 3]; 3];

/// The first of the nodes whose B-splines are not zero at a point, and those B-splines.
pub(super) fn cell(counts: [usize; 3], point: &Vector3<f64>) -> ([usize; 3], Weights) {
    let mut first = [0; 3];
    let mut weights = [[[0.0; 4]; 3]; 3];
    for axis in 0..3 {
        let start = (point[axis].floor() - 1.0).clamp(0.0, counts[axis] as f64 - 4.0);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a node; NaN becomes 0")]
        let node = start as usize;
        first[axis] = node;
        let t = point[axis] - start - 1.0;
        let s = 1.0 - t;
        let inner = |t: f64| 2.0 / 3.0 - t * t * (1.0 - 0.5 * t);
        weights[axis] = [
            [s * s * s / 6.0, inner(t), inner(s), t * t * t / 6.0],
            [-0.5 * s * s, t * (1.5 * t - 2.0), s * (2.0 - 1.5 * s), 0.5 * t * t],
            [s, 3.0 * t - 2.0, 3.0 * s - 2.0, t],
        ];
    }
    (first, weights)
}

/// The sum of 64 B-splines with these coefficients.
pub(super) fn weighted(coefficients: &[[f32; 4]; 16], [x, y, z]: &Weights) -> SpacePoint {
    let mut whole = [0.0; 10];
    for (k, rows) in coefficients.chunks_exact(4).enumerate() {
        // Sums along x and y: the value, derivatives by x and xx, by y and xy, by yy.
        let mut plane = [0.0; 6];
        for (j, row) in rows.iter().enumerate() {
            let line = x.map(|x| (0..4).map(|i| f64::from(row[i]) * x[i]).sum::<f64>());
            for order in 0..3 {
                plane[order] += line[order] * y[0][j];
            }
            plane[3] += line[0] * y[1][j];
            plane[4] += line[1] * y[1][j];
            plane[5] += line[0] * y[2][j];
        }
        for order in 0..6 {
            whole[order] += plane[order] * z[0][k];
        }
        whole[6] += plane[0] * z[1][k];
        whole[7] += plane[1] * z[1][k];
        whole[8] += plane[3] * z[1][k];
        whole[9] += plane[0] * z[2][k];
    }
    let [value, x, xx, y, xy, yy, z, xz, yz, zz] = whole;
    let hessian = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
    SpacePoint { value, gradient: Vector3::new(x, y, z), hessian }
}

/// Turns values at nodes along one axis into coefficients: `c[i-1] + 4 c[i] + c[i+1] = 6 v[i]` inside, `c = v` at both ends.
///
/// Nodes along the axis are `stride` apart. Lines that lie within one another are taken together, so that memory is read in
/// order.
fn filter(values: &mut [f64], stride: usize, count: usize) {
    let mut pivots = vec![0.0; count];
    for i in 1..count - 1 {
        pivots[i] = 1.0 / (4.0 - pivots[i - 1]);
    }
    for block in values.chunks_exact_mut(stride * count) {
        for i in 1..count - 1 {
            let (before, rest) = block.split_at_mut(i * stride);
            for (own, below) in rest[..stride].iter_mut().zip(&before[(i - 1) * stride..]) {
                *own = (6.0 * *own - below) * pivots[i];
            }
        }
        for i in (1..count - 1).rev() {
            let (before, rest) = block.split_at_mut((i + 1) * stride);
            for (own, above) in before[i * stride..].iter_mut().zip(&rest[..stride]) {
                *own -= above * pivots[i];
            }
        }
    }
}

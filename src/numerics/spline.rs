//! Cubic splines through points: curves with two continuous derivatives.

use core::ops::RangeInclusive;

use nalgebra::SVector;

use crate::error::{Error, check};

/// A curve through points in `N` dimensions, a cubic in each of its intervals, with not-a-knot ends: the first two intervals
/// share one cubic, and so do the last two. A cubic is reproduced exactly; the error for a smooth curve is of fourth order.
///
/// C. de Boor, A Practical Guide to Splines, Springer 2001, chapter IV.
#[derive(Debug, Clone, PartialEq)]
pub struct Spline<const N: usize> {
    knots: Vec<f64>,
    values: Vec<SVector<f64, N>>,
    /// Second derivatives at the knots.
    seconds: Vec<SVector<f64, N>>,
}

/// A point of a curve with the first two derivatives by its parameter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CurvePoint<const N: usize> {
    /// The point.
    pub value: SVector<f64, N>,
    /// First derivative.
    pub first: SVector<f64, N>,
    /// Second derivative.
    pub second: SVector<f64, N>,
}

impl<const N: usize> Spline<N> {
    /// The curve with these values at these parameters.
    ///
    /// ```
    /// use mcm::numerics::spline::Spline;
    /// use nalgebra::Vector1;
    /// let knots = [0.0, 1.0, 2.5, 3.0, 5.0];
    /// let cubic = |t: f64| t * t * (t - 3.0);
    /// let spline = Spline::new(knots.to_vec(), knots.map(|t| Vector1::new(cubic(t))).to_vec())?;
    /// assert!((spline.at(4.0).value.x - cubic(4.0)).abs() < 1e-12);
    /// assert!((spline.at(0.5).second.x - (6.0 * 0.5 - 6.0)).abs() < 1e-12);
    /// assert!(Spline::new(vec![0.0, 0.0], vec![Vector1::new(0.0); 2]).is_err());
    /// # Ok::<(), mcm::error::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Count`] for fewer than two points or another number of parameters, [`Error::Range`] for a parameter that does
    /// not increase, and for values that are not finite.
    pub fn new(knots: Vec<f64>, values: Vec<SVector<f64, N>>) -> Result<Self, Error> {
        if knots.len() < 2 || knots.len() != values.len() {
            return Err(Error::Count {
                quantity: "points of the spline".into(),
                given: values.len(),
                expected: "at least 2, one for each parameter".into(),
            });
        }
        for pair in knots.windows(2) {
            check("step of the spline's parameter", pair[1] - pair[0], |step| step > 0.0, "> 0")?;
        }
        for value in values.iter().flat_map(SVector::iter) {
            check("value of the spline", *value, |_| true, "finite")?;
        }
        let seconds = seconds(&knots, &values);
        Ok(Self { knots, values, seconds })
    }

    /// The parameters of the points.
    #[must_use]
    pub fn knots(&self) -> &[f64] {
        &self.knots
    }

    /// Range of the parameter.
    #[must_use]
    pub fn range(&self) -> RangeInclusive<f64> {
        self.knots[0]..=self.knots[self.knots.len() - 1]
    }

    /// The point at parameter `t`; beyond the ends their cubics go on.
    #[must_use]
    pub fn at(&self, t: f64) -> CurvePoint<N> {
        let interval = self.knots.partition_point(|knot| *knot <= t).clamp(1, self.knots.len() - 1) - 1;
        self.within(interval, t)
    }

    /// The point at parameter `t` on the cubic of this interval, counted from 0.
    #[must_use]
    pub fn within(&self, interval: usize, t: f64) -> CurvePoint<N> {
        let [start, end] = [interval, interval + 1];
        let step = self.knots[end] - self.knots[start];
        let (a, b) = ((self.knots[end] - t) / step, (t - self.knots[start]) / step);
        let ([y, z], [m, n]) =
            ([self.values[start], self.values[end]], [self.seconds[start], self.seconds[end]]);
        let sixth = step * step / 6.0;
        CurvePoint {
            value: y * a + z * b + (m * (a * a * a - a) + n * (b * b * b - b)) * sixth,
            first: (z - y) / step + (n * (3.0 * b * b - 1.0) - m * (3.0 * a * a - 1.0)) * (step / 6.0),
            second: m * a + n * b,
        }
    }
}

/// Second derivatives at the knots, by elimination of the tridiagonal equations of continuity.
fn seconds<const N: usize>(knots: &[f64], values: &[SVector<f64, N>]) -> Vec<SVector<f64, N>> {
    let last = knots.len() - 1;
    let step = |i: usize| knots[i + 1] - knots[i];
    let slope = |i: usize| (values[i + 1] - values[i]) / step(i);
    let bend = |i: usize| (slope(i) - slope(i - 1)) * 6.0;
    let mut out = vec![SVector::zeros(); last + 1];
    if last < 2 {
        return out; // a straight line
    }
    if last == 2 {
        let parabola = (slope(1) - slope(0)) * (2.0 / (knots[2] - knots[0]));
        return vec![parabola; 3];
    }
    // Rows of the inner knots: below, on and above the diagonal, and the right-hand side.
    let mut rows: Vec<(f64, f64, f64, SVector<f64, N>)> =
        (1..last).map(|i| (step(i - 1), 2.0 * (step(i - 1) + step(i)), step(i), bend(i))).collect();
    // The third derivative is continuous at the second knot and at the last but one.
    let ends = |outer: f64, inner: f64| (outer * (1.0 + outer / inner), -outer * outer / inner);
    let (on, next) = ends(step(0), step(1));
    (rows[0].1, rows[0].2) = (rows[0].1 + on, rows[0].2 + next);
    let (on, next) = ends(step(last - 1), step(last - 2));
    let end = rows.len() - 1;
    (rows[end].1, rows[end].0) = (rows[end].1 + on, rows[end].0 + next);
    for i in 1..rows.len() {
        let factor = rows[i].0 / rows[i - 1].1;
        let (above, right) = (rows[i - 1].2, rows[i - 1].3);
        rows[i].1 -= factor * above;
        rows[i].3 -= right * factor;
    }
    for i in (0..rows.len()).rev() {
        let above = if i == end { SVector::zeros() } else { out[i + 2] * rows[i].2 };
        out[i + 1] = (rows[i].3 - above) / rows[i].1;
    }
    out[0] = out[1] + (out[1] - out[2]) * (step(0) / step(1));
    out[last] = out[last - 1] + (out[last - 1] - out[last - 2]) * (step(last - 1) / step(last - 2));
    out
}

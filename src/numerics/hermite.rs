//! Cubics given by values and slopes at both ends of an interval.

use super::bisection::bisect;

/// Halvings of an interval with a crossing: to rounding.
const HALVINGS: usize = 50;

/// A cubic on `[0, 1]`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cubic {
    /// Coefficients, lowest power first.
    coefficients: [f64; 4],
}

impl Cubic {
    /// The cubic with these values and slopes at 0 and 1 (Hermite interpolation).
    ///
    /// ```
    /// use mcm::numerics::hermite::Cubic;
    /// let cubic = Cubic::through([1.0, 1.0], [-6.0, 6.0]); // 1 - 6 x + 6 x^2
    /// let [down, up] = cubic.crossings(0.0)[..] else { unreachable!() };
    /// assert!((down + up - 1.0).abs() < 1e-12 && cubic.at(down).abs() < 1e-12);
    /// ```
    #[must_use]
    pub fn through(values: [f64; 2], slopes: [f64; 2]) -> Self {
        let rise = values[1] - values[0];
        let coefficients = [
            values[0],
            slopes[0],
            3.0 * rise - 2.0 * slopes[0] - slopes[1],
            slopes[0] + slopes[1] - 2.0 * rise,
        ];
        Self { coefficients }
    }

    /// Its value at `x`.
    #[must_use]
    pub fn at(&self, x: f64) -> f64 {
        self.coefficients.iter().rev().fold(0.0, |sum, c| sum * x + c)
    }

    /// Where its slope changes sign, on either side of the interval too.
    fn extrema(&self) -> impl Iterator<Item = f64> + use<> {
        let [_, b, c, d] = self.coefficients;
        let discriminant = c * c - 3.0 * b * d;
        let q = -(c + c.signum() * discriminant.max(0.0).sqrt());
        [q / (3.0 * d), b / q].into_iter().filter(move |_| discriminant > 0.0)
    }

    /// Its least value between two places.
    ///
    /// ```
    /// use mcm::numerics::hermite::Cubic;
    /// let cubic = Cubic::through([1.0, 1.0], [-6.0, 6.0]); // 1 - 6 x + 6 x^2
    /// assert!((cubic.least([0.0, 1.0]) + 0.5).abs() < 1e-12);
    /// assert_eq!(cubic.least([0.0, 0.2]), cubic.at(0.2));
    /// ```
    #[must_use]
    pub fn least(&self, [from, to]: [f64; 2]) -> f64 {
        let inside = self.extrema().filter(|x| *x > from && *x < to);
        inside.chain([from, to]).map(|x| self.at(x)).fold(f64::INFINITY, f64::min)
    }

    /// The places inside `(0, 1)`, ascending, where it changes from one side of `level` to the other.
    #[must_use]
    pub fn crossings(&self, level: f64) -> Vec<f64> {
        // Between its extrema it is monotone.
        let mut ends = vec![0.0];
        ends.extend(self.extrema().filter(|x| *x > 0.0 && *x < 1.0));
        ends.push(1.0);
        ends.sort_by(f64::total_cmp);
        let below = |x: f64| self.at(x) < level;
        let monotone = ends.windows(2).filter(|pair| below(pair[0]) != below(pair[1]));
        monotone.map(|pair| bisect([pair[0], pair[1]], HALVINGS, |x| below(x) == below(pair[0]))[0]).collect()
    }
}

//! The interval of numbers that a quantity may have: what is checked, said in errors and written into documents is the same.

use core::f64::consts::PI;
use core::fmt;
use core::ops::Bound::{self, Excluded, Included, Unbounded};
use core::ops::RangeBounds;

use super::Error;

/// The numbers that a quantity may have. Only finite ones are inside.
///
/// ```
/// use mcm::error::Interval;
/// const LENGTH: Interval = Interval::above(0.0).at_most(1.0);
/// assert_eq!(LENGTH.check("length (m)", 0.004), Ok(0.004));
/// let refused = LENGTH.check("length (m)", 4.0).unwrap_err();
/// assert_eq!(refused.to_string(), "length (m) = 4 is not allowed: it must be > 0 and <= 1");
///
/// const INNER_RADIUS: Interval = Interval::at_least(0.0).less_than("the outer radius");
/// assert!(INNER_RADIUS.check_beside("inner radius (m)", 0.003, 0.002).is_err());
/// assert_eq!(INNER_RADIUS.to_string(), ">= 0 and < the outer radius");
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interval {
    /// The lower end.
    pub low: Bound<f64>,
    /// The upper end.
    pub high: Bound<f64>,
    /// The other quantity that must not be exceeded, and whether it must not be reached either.
    pub other: Bound<&'static str>,
}

impl Interval {
    /// Every finite number.
    pub const FINITE: Self = Self { low: Unbounded, high: Unbounded, other: Unbounded };

    /// This number and those above it.
    #[must_use]
    pub const fn at_least(low: f64) -> Self {
        Self { low: Included(low), ..Self::FINITE }
    }

    /// The numbers above this one.
    #[must_use]
    pub const fn above(low: f64) -> Self {
        Self { low: Excluded(low), ..Self::FINITE }
    }

    /// The numbers of at most this size, of either sign.
    #[must_use]
    pub const fn within(size: f64) -> Self {
        Self::at_least(-size).at_most(size)
    }

    /// Those that are not above this number.
    #[must_use]
    pub const fn at_most(self, high: f64) -> Self {
        Self { high: Included(high), ..self }
    }

    /// Those below this number.
    #[must_use]
    pub const fn below(self, high: f64) -> Self {
        Self { high: Excluded(high), ..self }
    }

    /// Those below the quantity with this name.
    #[must_use]
    pub const fn less_than(self, other: &'static str) -> Self {
        Self { other: Excluded(other), ..self }
    }

    /// Those that are not above the quantity with this name.
    #[must_use]
    pub const fn not_above(self, other: &'static str) -> Self {
        Self { other: Included(other), ..self }
    }

    /// The interval with every limit multiplied by a positive factor, as in another unit.
    #[must_use]
    pub fn scaled(self, factor: f64) -> Self {
        let scale = |bound: Bound<f64>| bound.map(|limit| limit * factor);
        Self { low: scale(self.low), high: scale(self.high), ..self }
    }

    /// Whether a number is inside, whatever the other quantity is.
    #[must_use]
    pub fn contains(&self, value: f64) -> bool {
        value.is_finite() && (self.low, self.high).contains(&value)
    }

    /// Returns a value that is inside, whatever the other quantity is.
    ///
    /// # Errors
    /// [`Error::Range`] for any other value.
    pub fn check(&self, quantity: &str, value: f64) -> Result<f64, Error> {
        self.check_beside(quantity, value, f64::INFINITY)
    }

    /// Returns a value that is inside while the other quantity has the value `other`.
    ///
    /// # Errors
    /// [`Error::Range`] for any other value.
    pub fn check_beside(&self, quantity: &str, value: f64, other: f64) -> Result<f64, Error> {
        let beside = match self.other {
            Included(_) => value <= other,
            Excluded(_) => value < other,
            Unbounded => true,
        };
        if self.contains(value) && beside {
            Ok(value)
        } else {
            Err(Error::range(quantity, value, self.to_string()))
        }
    }
}

impl fmt::Display for Interval {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Self { low: Included(low), high: Included(high), other: Unbounded } = self {
            return write!(out, "from {} to {}", Limit(*low), Limit(*high));
        }

        let mut conditions = Vec::new();

        match self.low {
            Included(low) => conditions.push(format!(">= {}", Limit(low))),
            Excluded(low) => conditions.push(format!("> {}", Limit(low))),
            Unbounded => {}
        }

        match self.high {
            Included(high) => conditions.push(format!("<= {}", Limit(high))),
            Excluded(high) => conditions.push(format!("< {}", Limit(high))),
            Unbounded => {}
        }

        match self.other {
            Included(other) => conditions.push(format!("<= {other}")),
            Excluded(other) => conditions.push(format!("< {other}")),
            Unbounded => {}
        }

        if conditions.is_empty() {
            conditions.push("finite".into());
        }

        out.write_str(&conditions.join(" and "))
    }
}

/// A limit in words.
struct Limit(f64);

impl fmt::Display for Limit {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        /// Digits after the point of a limit that is not a short number.
        const DIGITS: f64 = 1e4;
        let Self(limit) = *self;
        for (value, words) in [(PI, "pi"), (2.0 * PI, "2 pi"), (-2.0 * PI, "-2 pi")] {
            if limit.total_cmp(&value).is_eq() {
                return out.write_str(words);
            }
        }
        if limit != 0.0 && !(1.0 / DIGITS..1e6).contains(&limit.abs()) {
            return write!(out, "{limit:e}");
        }
        write!(out, "{}", (limit * DIGITS).round() / DIGITS)
    }
}

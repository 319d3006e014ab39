//! The one public error: what was wrong, with which value, and what is allowed.

mod interval;
mod quantity;

pub use interval::Interval;
pub(crate) use quantity::quantities;
pub use quantity::{Identity, Quantity};

/// Everything that this crate refuses.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A quantity lies outside its allowed range; NaN always does.
    #[error("{quantity} = {value} is not allowed: it must be {allowed}")]
    Range {
        /// Name of the quantity, with its unit.
        quantity: String,
        /// The value that was given.
        value: f64,
        /// The allowed range in words.
        allowed: String,
        /// Which number of a scene it is; `None` for what no scene holds as it is.
        identity: Option<Identity>,
    },
    /// A list has the wrong number of entries.
    #[error("{quantity} has {given} entries, expected {expected}")]
    Count {
        /// Name of the list.
        quantity: String,
        /// Number of entries given.
        given: usize,
        /// Number of entries expected, in words.
        expected: String,
    },
    /// The field was asked for at a point where it is singular: on the edge of a magnet.
    #[error("the field at ({x} m, {y} m, {z} m) is singular: the point lies on an edge of a magnet")]
    OnEdge {
        /// Position of the point, m, in the frame in which it was given.
        x: f64,
        /// See `x`.
        y: f64,
        /// See `x`.
        z: f64,
    },
    /// A scene or resource could not be understood.
    #[error("{what}: {reason}")]
    Syntax {
        /// Which text or file.
        what: String,
        /// Why it was refused.
        reason: String,
    },
    /// Several faults of one text.
    #[error("{}", in_lines(.0))]
    Several(Vec<Error>),
    /// Derivatives were asked for where there are none: at a fold, or before anything is solved.
    #[error("no derivatives: {0}")]
    NoDerivatives(String),
    /// A combination of choices that does not exist.
    #[error("{0}")]
    Unsupported(String),
}

/// One line for each.
fn in_lines(errors: &[Error]) -> String {
    errors.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n")
}

impl Error {
    /// An [`Error::Range`] for `quantity`.
    pub fn range(quantity: impl Into<String>, value: f64, allowed: impl Into<String>) -> Self {
        Self::Range { quantity: quantity.into(), value, allowed: allowed.into(), identity: None }
    }

    /// The error with these coordinates (m) of its point, in the frame in which it was given.
    pub(crate) fn at(self, [x, y, z]: [f64; 3]) -> Self {
        match self {
            Self::OnEdge { .. } => Self::OnEdge { x, y, z },
            other => other,
        }
    }
}

/// Returns `value` when it is finite and `holds`, else an [`Error::Range`]; for an interval see [`Interval::check`].
///
/// ```
/// use mcm::error::check;
/// assert_eq!(check("count", 4.0, |v| v.fract() == 0.0, "a whole number"), Ok(4.0));
/// let refused = check("count", f64::NAN, |v| v.fract() == 0.0, "a whole number").unwrap_err();
/// assert_eq!(refused.to_string(), "count = NaN is not allowed: it must be a whole number");
/// ```
///
/// # Errors
/// [`Error::Range`] for NaN, an infinity, or a value that does not hold.
pub fn check(quantity: &str, value: f64, holds: impl Fn(f64) -> bool, allowed: &str) -> Result<f64, Error> {
    if value.is_finite() && holds(value) { Ok(value) } else { Err(Error::range(quantity, value, allowed)) }
}

//! Bisection for the boundary of a property of one variable.

/// Interval in which `holds` changes, after `halvings` bisections; `holds` is true at its first end and false at its
/// second.
///
/// It is assumed to be true at `from` and false at `to`; if it changes several times between them, one change is found.
///
/// ```
/// use mcm::numerics::bisection::bisect;
/// let [below, above] = bisect([0.0, 2.0], 40, |x| x * x <= 2.0);
/// assert!(below * below <= 2.0 && above * above > 2.0 && above - below < 1e-11);
/// ```
pub fn bisect([mut from, mut to]: [f64; 2], halvings: usize, holds: impl Fn(f64) -> bool) -> [f64; 2] {
    for _ in 0..halvings {
        let middle = 0.5 * (from + to);
        *(if holds(middle) { &mut from } else { &mut to }) = middle;
    }
    [from, to]
}

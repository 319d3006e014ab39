//! Where a property of one variable ends.

/// The ends of the interval in which `holds` stops to, halved so many times: at the first it does, at the second it does not.
///
/// `from` and `to` are taken to do so; of several places between them it finds one.
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

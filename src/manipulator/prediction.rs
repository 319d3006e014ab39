//! Prediction of a snap: the path parameter at which the stability margin vanishes.
//!
//! Towards a fold the margin goes to zero with the square root of the distance; where a symmetric shape loses its stability
//! without a fold, in proportion to it. Nearly symmetric shapes lie in between.

use crate::numerics::bisection::bisect;

/// Margin below which a snap is predicted: farther away it does not yet follow the asymptotic power law.
const LARGEST_MARGIN: f64 = 0.35;

/// Powers of the distance with which the margin vanishes: at a fold, and without one.
const POWERS: [f64; 2] = [0.5, 1.0];

/// Number of bisections of the interval of powers.
const HALVINGS: usize = 40;

/// The path parameter at which the margin vanishes, from those and the margins of the shapes so far, latest last.
///
/// Two shapes assume the power of a fold; three in one direction also determine the power within [`POWERS`]. `None` where the
/// margin grows or is too large.
pub(super) fn predicted(shapes: &[(f64, f64)]) -> Option<f64> {
    let [earlier @ .., (before, first), (here, last)] = shapes else { return None };
    if !(last < first && *last < LARGEST_MARGIN) {
        return None;
    }
    let at = |power: f64| {
        let rest = (last / first).powf(1.0 / power);
        here + (here - before) * rest / (1.0 - rest)
    };
    let earlier = earlier.last().filter(|(value, _)| (before - value) * (here - before) > 0.0);
    let Some((value, margin)) = earlier else { return Some(at(POWERS[0])) };
    // The larger the power, the larger the earlier margin.
    let [low, high] = bisect(POWERS, HALVINGS, |power| {
        let zero = at(power);
        last * ((zero - value) / (zero - here)).powf(power) < *margin
    });
    Some(at(0.5 * (low + high)))
}

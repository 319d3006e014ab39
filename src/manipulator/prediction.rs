//! A snap seen coming: where the stability margin will be zero.
//!
//! Towards a fold the margin goes to zero with the square root of the distance; where a symmetric shape loses its
//! stability without one, in proportion to it. In between lie shapes that are nearly symmetric.

use crate::numerics::bisection::bisect;

/// The margin below which a snap ahead is predicted: further away its course is not yet that of its end.
const LARGEST_MARGIN: f64 = 0.5;

/// Powers of the distance with which the margin goes to zero: at a fold, and without one.
const POWERS: [f64; 2] = [0.5, 1.0];

/// Halvings of their interval.
const HALVINGS: usize = 40;

/// The value at which the margin is zero, from the values and margins of shapes on the way there, the last one last.
///
/// Two tell as much as for a fold, three on one way also the power within [`POWERS`]. `None` where the margin grows or is too large.
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
    // The larger the power, the larger was the margin.
    let [low, high] = bisect(POWERS, HALVINGS, |power| {
        let zero = at(power);
        last * ((zero - value) / (zero - here)).powf(power) < *margin
    });
    Some(at(0.5 * (low + high)))
}

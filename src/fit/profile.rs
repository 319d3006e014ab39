//! Profile likelihood intervals: how far a parameter can go while the others follow.

use statrs::distribution::{ContinuousCDF, StudentsT};

use super::descent::{Minimum, Weighted};
use crate::error::Error;

/// Part of the distribution below the upper limit.
const UPPER: f64 = 0.975;

/// The same in normal deviations.
const NORMAL: f64 = 1.959_963_984_540_054;

/// Most fits for one limit, and how near to it, relative to its distance, is near enough.
const TRIES: usize = 12;
const NEAR: f64 = 1e-3;

/// Intervals of 95 % of all parameters: where the sum of squares has grown by the square of the quantile (Venzon and Moolgavkar 1988,
/// doi 10.2307/2347496), normal where the noise is known, Student's otherwise.
pub(super) fn intervals(
    weighted: &Weighted<'_>,
    best: &Minimum,
    deviations: &[f64],
    known: bool,
) -> Result<Vec<Option<[f64; 2]>>, Error> {
    let freedom = (weighted.weights.len() - deviations.len()) as f64;
    let quantile = match StudentsT::new(0.0, 1.0, freedom) {
        Ok(student) if !known => student.inverse_cdf(UPPER),
        _ => NORMAL,
    };
    // With the weights of the last round the least sum may differ from that of its own minimum.
    let least = weighted.minimum(best.point.clone(), None)?;
    let limit = |index: usize, side: f64| -> Result<Option<f64>, Error> {
        let mut far = quantile * deviations[index];
        let (mut start, mut low, mut high) = (least.point.clone(), 0.0, f64::INFINITY);
        let centre = least.point.values[index];
        for _ in 0..TRIES {
            start.values[index] = centre + side * far;
            let moved = weighted.problem.at(&start.values);
            let grown = match moved.and_then(|moved| weighted.minimum(moved, Some(index))) {
                Ok(found) => {
                    start = found.point;
                    (found.squares - least.squares).max(0.0).sqrt()
                }
                // There is no such device, or it has no shape at some row.
                Err(_) => f64::INFINITY,
            };
            if (grown - quantile).abs() <= NEAR * quantile {
                return Ok(Some(centre + side * far));
            }
            if grown < quantile {
                low = far;
            } else {
                high = far;
            }
            let next = if grown > 0.0 { far * quantile / grown } else { 2.0 * far };
            let within = next > low && next < high;
            far = match (within, high.is_finite()) {
                (true, _) => next,
                (false, true) => 0.5 * (low + high),
                (false, false) => 2.0 * far,
            };
            if high - low <= NEAR * low {
                return Ok((high.is_finite() && grown.is_finite()).then_some(centre + side * far));
            }
        }
        Ok(None)
    };
    let both = |index| Ok(limit(index, -1.0)?.zip(limit(index, 1.0)?).map(|(low, high)| [low, high]));
    (0..deviations.len()).map(both).collect()
}

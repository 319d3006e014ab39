//! The key `design.spiral_start_deg`: a number for all segments, or a list with one for each.

use super::numbers::Numbers;
use super::ranges::SPIRAL_START;
use crate::design::SpiralStart;
use crate::error::Error;

const KEY: &str = "design.spiral_start_deg";

/// The angles in rad, checked for so many segments.
pub(super) fn si(degrees: &Numbers, segments: usize) -> Result<SpiralStart, Error> {
    let angle = |key: &str, degrees: f64| SPIRAL_START.check(key, degrees).map(f64::to_radians);
    Ok(match degrees {
        Numbers::Same(degrees) => SpiralStart::Same(angle(KEY, *degrees)?),
        Numbers::Each(list) if list.len() != segments => {
            return Err(Error::Count {
                quantity: KEY.into(),
                given: list.len(),
                expected: format!("{segments}, one for each segment"),
            });
        }
        Numbers::Each(list) => {
            let angles = (1..).zip(list).map(|(index, degrees)| angle(&format!("{KEY}[{index}]"), *degrees));
            SpiralStart::Each(angles.collect::<Result<_, Error>>()?)
        }
    })
}

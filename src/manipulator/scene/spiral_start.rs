//! The key `design.spiral_start_deg`: a number for all segments, or a list with one for each.

use core::fmt;

use serde::de::{SeqAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::ranges::SPIRAL_START;
use crate::design::SpiralStart;
use crate::error::Error;

const KEY: &str = "design.spiral_start_deg";

#[derive(Debug, Clone, PartialEq)]
pub(super) enum SpiralStartEntry {
    Same(f64),
    Each(Vec<f64>),
}

impl SpiralStartEntry {
    /// The angles in rad, checked for so many segments.
    pub(super) fn si(&self, segments: usize) -> Result<SpiralStart, Error> {
        let angle = |key: &str, degrees: f64| SPIRAL_START.check(key, degrees).map(f64::to_radians);
        Ok(match self {
            Self::Same(degrees) => SpiralStart::Same(angle(KEY, *degrees)?),
            Self::Each(list) if list.len() != segments => {
                return Err(Error::Count {
                    quantity: KEY.into(),
                    given: list.len(),
                    expected: format!("{segments}, one for each segment"),
                });
            }
            Self::Each(list) => {
                let angles =
                    (1..).zip(list).map(|(index, degrees)| angle(&format!("{KEY}[{index}]"), *degrees));
                SpiralStart::Each(angles.collect::<Result<_, Error>>()?)
            }
        })
    }
}

impl Serialize for SpiralStartEntry {
    fn serialize<S: Serializer>(&self, out: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Same(degrees) => degrees.serialize(out),
            Self::Each(list) => list.serialize(out),
        }
    }
}

impl<'de> Deserialize<'de> for SpiralStartEntry {
    fn deserialize<D: Deserializer<'de>>(input: D) -> Result<Self, D::Error> {
        input.deserialize_any(NumberOrList)
    }
}

/// Reads either form; a derived untagged enum would not say what is expected.
struct NumberOrList;

impl<'de> Visitor<'de> for NumberOrList {
    type Value = SpiralStartEntry;

    fn expecting(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str("a number, or a list with one number for each segment")
    }

    fn visit_f64<E>(self, degrees: f64) -> Result<SpiralStartEntry, E> {
        Ok(SpiralStartEntry::Same(degrees))
    }

    fn visit_i64<E: serde::de::Error>(self, degrees: i64) -> Result<SpiralStartEntry, E> {
        let degrees = i32::try_from(degrees).map_err(|_| E::custom("not from -360 to 360"))?;
        Ok(SpiralStartEntry::Same(degrees.into()))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<SpiralStartEntry, A::Error> {
        let mut angles = Vec::new();
        while let Some(degrees) = list.next_element()? {
            angles.push(degrees);
        }
        Ok(SpiralStartEntry::Each(angles))
    }
}

//! A number for all segments or rings, or a list with one for each; of a section, one at its start and one at its end.

use core::fmt;

use serde::de::{SeqAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

#[derive(Debug, Clone, PartialEq)]
pub(super) enum Numbers {
    /// One number for all.
    Same(f64),
    /// One for each.
    Each(Vec<f64>),
}

impl Numbers {
    /// The numbers, one for all as a list of one.
    pub(super) fn all(&self) -> &[f64] {
        match self {
            Self::Same(number) => core::slice::from_ref(number),
            Self::Each(list) => list,
        }
    }

    /// The first number, which stands for all where there is one; 0 of an empty list.
    pub(super) fn first(&self) -> f64 {
        self.all().first().copied().unwrap_or_default()
    }

    /// The list, if it is one.
    pub(super) fn list(&self) -> Option<&[f64]> {
        match self {
            Self::Same(_) => None,
            Self::Each(list) => Some(list),
        }
    }

    /// Makes a number for all a list of so many.
    pub(super) fn spread(&mut self, count: usize) {
        if let Self::Same(number) = *self {
            *self = Self::Each(vec![number; count]);
        }
    }
}

impl Serialize for Numbers {
    fn serialize<S: Serializer>(&self, out: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Same(number) => number.serialize(out),
            Self::Each(list) => list.serialize(out),
        }
    }
}

impl<'de> Deserialize<'de> for Numbers {
    fn deserialize<D: Deserializer<'de>>(input: D) -> Result<Self, D::Error> {
        input.deserialize_any(NumberOrList("a number, or a list with one number for each segment"))
    }
}

/// Reads a number of rings.
pub(super) fn of_rings<'de, D: Deserializer<'de>>(input: D) -> Result<Numbers, D::Error> {
    input.deserialize_any(NumberOrList("a number, or a list with one number for each ring"))
}

/// Reads a number of a section that may change along it.
pub(super) fn of_ends<'de, D: Deserializer<'de>>(input: D) -> Result<Numbers, D::Error> {
    input.deserialize_any(NumberOrList("a number, or one at the start and one at the end: [start, end]"))
}

/// Reads either form; a derived untagged enum would not say what is expected.
struct NumberOrList(&'static str);

impl<'de> Visitor<'de> for NumberOrList {
    type Value = Numbers;

    fn expecting(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(self.0)
    }

    fn visit_f64<E>(self, number: f64) -> Result<Numbers, E> {
        Ok(Numbers::Same(number))
    }

    fn visit_i64<E: serde::de::Error>(self, number: i64) -> Result<Numbers, E> {
        let number = i32::try_from(number).map_err(|_| E::custom("not a number that can be meant here"))?;
        Ok(Numbers::Same(number.into()))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Numbers, A::Error> {
        let mut numbers = Vec::new();
        while let Some(number) = list.next_element()? {
            numbers.push(number);
        }
        Ok(Numbers::Each(numbers))
    }
}

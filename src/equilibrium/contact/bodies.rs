//! Bodies that overlap.

use std::fmt;

use serde::{Deserialize, Serialize};

use crate::magnetics::SourceName;

/// Smallest depth that is printed in numbers, m: half of the last digit in millimetres.
const SHALLOWEST: f64 = 0.5e-6;

/// Two bodies that overlap.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Contact {
    /// A body of the manipulator.
    pub first: Body,
    /// The body that it touches.
    pub second: Body,
    /// Penetration depth, m.
    pub depth: f64,
}

/// A body, numbered from 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Body {
    /// A ring magnet, counted from the base.
    Ring(usize),
    /// The soft part of a segment between two rings (of a plain cylinder, one of its elements), counted from the base.
    Segment(usize),
    /// A cylinder of a magnet, by its number, or the winding of a coil.
    Source(SourceName, usize),
}

impl fmt::Display for Contact {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.depth < SHALLOWEST {
            return write!(out, "{} touches {}", self.first, self.second);
        }
        write!(out, "{} is {:.3} mm deep in {}", self.first, 1e3 * self.depth, self.second)
    }
}

/// Counted from 1, as in the FMU and in scene files.
impl fmt::Display for Body {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Ring(number) => write!(out, "ring {}", number + 1),
            Self::Segment(number) => write!(out, "segment {}", number + 1),
            Self::Source(name, body) => out.write_str(&name.body(*body)),
        }
    }
}

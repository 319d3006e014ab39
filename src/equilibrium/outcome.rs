//! Outcome of a solve, and what to do about it.

use std::fmt;

use serde::{Deserialize, Serialize};

use crate::magnetics::SourceName;

/// Smallest depth that is printed in numbers, m: half of the last digit in millimetres.
const SHALLOWEST: f64 = 0.5e-6;

/// Outcome of a search for an equilibrium.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum Outcome {
    /// An equilibrium was found; whether it is stable is reported separately.
    Solved,
    /// An equilibrium of neutral stability: one direction is determined only by rounding, as where a bent manipulator may
    /// turn about the axis of an axisymmetric scene.
    Neutral,
    /// The branch ends at a fold, and no stable shape was found beyond it.
    BranchEnds,
    /// Two bodies would overlap.
    Contact(Contact),
    /// What the settings allow a solve was used up.
    OutOfBudget(Budget),
    /// Friction and the normal forces that it depends on did not settle, as where the manipulator is wedged.
    Wedged,
}

/// What the settings allow a solve.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Budget {
    /// The number of iterations.
    Iterations,
    /// The processor time.
    Time,
}

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

impl Outcome {
    /// Whether an equilibrium was found at the requested inputs.
    #[must_use]
    pub fn is_solved(self) -> bool {
        matches!(self, Self::Solved | Self::Neutral)
    }

    /// The name of the outcome in JSON.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Solved => "solved",
            Self::Neutral => "neutral",
            Self::BranchEnds => "branch_ends",
            Self::Contact(_) => "contact",
            Self::OutOfBudget(_) => "out_of_budget",
            Self::Wedged => "wedged",
        }
    }
}

/// What happened and what to do about it, as a sentence without a full stop.
impl fmt::Display for Outcome {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Solved => write!(out, "an equilibrium was found"),
            Self::Neutral => write!(
                out,
                "the equilibrium is neutral: one direction is free, as about the axis of an axisymmetric scene; a slight \
                 asymmetry of the inputs decides where it settles"
            ),
            Self::BranchEnds => write!(
                out,
                "the branch ends at a fold and no stable shape was found beyond it; go back or take another way; where \
                 bending_stop is off, touching windings may end it later"
            ),
            Self::Contact(contact) => write!(out, "bodies touch: {contact}; keep them apart"),
            Self::OutOfBudget(budget) => {
                let (spent, key) = match budget {
                    Budget::Iterations => ("iterations allowed were", "model.iterations"),
                    Budget::Time => ("processor time allowed was", "model.time_budget_s"),
                };
                write!(out, "the {spent} used up; allow more ({key}), or take shorter steps")
            }
            Self::Wedged => write!(
                out,
                "friction and normal forces do not settle: the manipulator is wedged; go back, turn it or take shorter steps"
            ),
        }
    }
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

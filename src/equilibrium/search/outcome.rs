//! Outcome of a solve, and what to do about it.

use std::fmt;

use serde::{Deserialize, Serialize};

use crate::equilibrium::contact::Contact;

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

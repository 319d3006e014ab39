//! What the search for an equilibrium has come to: the values of `solver.*` and `stability.snaps`, which are always readable.

use crate::manipulator::{Outcome, Outputs, Status};

/// The number of `solver.status` where an equilibrium was not found or not sought.
const NOT_SOLVED: i32 = 3;
/// The number of `solver.outcome` where inputs or parameters were refused.
const INPUT_REFUSED: i32 = 6;

/// How the last search for an equilibrium ended.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SearchReport {
    /// `solver.status`; an Integer and no Enumeration because some hosts hide enumerations.
    pub status: i32,
    /// `solver.outcome`.
    pub outcome: i32,
    /// Newton iterations of the last solve.
    pub iterations: u32,
    /// Fraction of the last change of inputs that was solved.
    pub progress: f64,
    /// Residual of the last solve relative to the elastic forces.
    pub residual: f64,
    /// Jumps to another branch since initialisation.
    pub snaps: u32,
}

impl SearchReport {
    /// The report on the last solve, which left these outputs (`None`: nothing was solved yet); `refused` says whether the host has
    /// set inputs or parameters since that are not allowed.
    pub(super) fn of(outputs: Option<&Outputs>, refused: bool) -> Self {
        let report = outputs.map_or(Self::NOTHING_SOLVED, |outputs| Self {
            status: status_number(outputs.status),
            outcome: outcome_number(outputs.outcome),
            iterations: outputs.iterations,
            progress: outputs.progress,
            // The residual is infinite when a solve could not begin; FMI has no infinity.
            residual: outputs.residual.min(f64::MAX),
            snaps: outputs.snaps,
        });
        if refused {
            Self { status: NOT_SOLVED, outcome: INPUT_REFUSED, progress: 0.0, ..report }
        } else {
            report
        }
    }

    /// Without a device there was no solve, and only refused parameters leave an instance without one.
    const NOTHING_SOLVED: Self = Self {
        status: NOT_SOLVED,
        outcome: INPUT_REFUSED,
        iterations: 0,
        progress: 0.0,
        residual: f64::MAX,
        snaps: 0,
    };
}

fn status_number(status: Status) -> i32 {
    match status {
        Status::Solved => 0,
        Status::NearFold => 1,
        Status::Snapped => 2,
        Status::NotSolved => NOT_SOLVED,
    }
}

fn outcome_number(outcome: Outcome) -> i32 {
    match outcome {
        Outcome::Solved => 0,
        Outcome::Neutral => 1,
        Outcome::BranchEnds => 2,
        Outcome::Contact(_) => 3,
        Outcome::OutOfBudget(_) => 4,
        Outcome::Wedged => 5,
    }
}

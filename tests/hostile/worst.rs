//! What is kept of the answers of many random runs: how they ended, the worst numbers and the broken promises.

use std::fmt;

use mcm::manipulator::{Outcome, Outputs, Status};

/// How many of the worst are told.
const WORST: usize = 5;

/// A number, and the run and step where it was met.
pub(crate) type Place = (f64, u64, usize);

/// A promise that was broken in a step of a run.
#[derive(Debug, Clone)]
pub(crate) struct Defect {
    pub(crate) index: u64,
    pub(crate) step: usize,
    pub(crate) what: String,
}

impl fmt::Display for Defect {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "{} step {}: {}", self.index, self.step, self.what)
    }
}

/// Keeps the largest.
pub(crate) fn keep(list: &mut Vec<Place>, more: &[Place]) {
    list.extend_from_slice(more);
    list.sort_by(|a, b| b.0.total_cmp(&a.0));
    list.truncate(WORST);
}

/// The numbers, each with its run and step.
pub(crate) fn listed(places: &[Place]) -> String {
    let each = places.iter().map(|(value, index, step)| format!("{value:.1e} ({index}.{step})"));
    each.collect::<Vec<_>>().join(", ")
}

/// Writes the number of defects and each of them; `run` is the word for a run.
pub(crate) fn write_defects(out: &mut fmt::Formatter<'_>, run: &str, defects: &[Defect]) -> fmt::Result {
    write!(out, "defects: {}", defects.len())?;
    defects.iter().try_for_each(|defect| write!(out, "\n  {run} {defect}"))
}

/// How a solve ended, in words.
pub(crate) fn ending(out: &Outputs) -> &'static str {
    match (out.outcome, out.status) {
        (Outcome::Solved, Status::Snapped) => "solved after a snap",
        (Outcome::Solved, Status::NearFold) => "solved near a fold",
        (outcome, _) => outcome.name(),
    }
}

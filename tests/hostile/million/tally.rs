//! Counts of many walks.

use std::collections::BTreeMap;
use std::fmt;

use mcm::manipulator::{Outputs, Status};

use super::promises::Figures;
use super::scenes::Walk;
use super::worst::{Defect, Place, ending, keep, listed, write_defects};

/// Solves that ended alike.
#[derive(Debug, Default, Clone)]
struct Ending {
    count: u64,
    seconds: f64,
    /// The longest ones.
    slowest: Vec<Place>,
}

impl Ending {
    fn add(&mut self, more: &Self) {
        self.count += more.count;
        self.seconds += more.seconds;
        keep(&mut self.slowest, &more.slowest);
    }
}

/// What was done and found.
#[derive(Debug, Default, Clone)]
pub(crate) struct Tally {
    pub(crate) walks: u64,
    /// By level and ending.
    endings: BTreeMap<(&'static str, &'static str), Ending>,
    snaps: u64,
    verified: u64,
    pub(crate) defects: Vec<Defect>,
    farthest: Vec<Place>,
    softest: Vec<Place>,
}

impl Tally {
    /// Of a walk that begins.
    pub(crate) fn of_one_walk() -> Self {
        Self { walks: 1, ..Self::default() }
    }

    /// Adds an answer.
    pub(crate) fn count(&mut self, walk: &Walk, out: &Outputs, seconds: f64, (index, step): (u64, usize)) {
        let one = Ending { count: 1, seconds, slowest: vec![(seconds, index, step)] };
        self.endings.entry((walk.level, ending(out))).or_default().add(&one);
        self.snaps += u64::from(out.status == Status::Snapped);
    }

    /// Adds a verification.
    pub(crate) fn verified(&mut self, figures: Figures, (index, step): (u64, usize)) {
        self.verified += 1;
        keep(&mut self.farthest, &[(figures.distance * figures.margin.min(1.0), index, step)]);
        keep(&mut self.softest, &[(-figures.margin, index, step)]);
    }

    /// Both.
    pub(crate) fn with(mut self, more: Self) -> Self {
        self.walks += more.walks;
        for (key, ending) in more.endings {
            self.endings.entry(key).or_default().add(&ending);
        }
        self.snaps += more.snaps;
        self.verified += more.verified;
        self.defects.extend(more.defects);
        keep(&mut self.farthest, &more.farthest);
        keep(&mut self.softest, &more.softest);
        self
    }
}

impl fmt::Display for Tally {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let solves: u64 = self.endings.values().map(|ending| ending.count).sum();
        let seconds: f64 = self.endings.values().map(|ending| ending.seconds).sum();
        writeln!(out, "{} walks, {solves} solves in {seconds:.0} s of processor time", self.walks)?;
        for ((level, name), ending) in &self.endings {
            let Ending { count, seconds, slowest } = ending;
            writeln!(out, "{level:>10} {name:<20} {count:>8} {seconds:>8.1} s: {}", listed(slowest))?;
        }
        writeln!(out, "solves with a snap: {}; answers verified: {}", self.snaps, self.verified)?;
        writeln!(
            out,
            "tip off the finer model's over the length, times the margin: {}",
            listed(&self.farthest)
        )?;
        writeln!(out, "least margin by the finer model, negated: {}", listed(&self.softest))?;
        write_defects(out, "walk", &self.defects)
    }
}

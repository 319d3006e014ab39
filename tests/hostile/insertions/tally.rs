//! Counts of many insertions.

use std::collections::BTreeMap;
use std::fmt;

use mcm::manipulator::{Inputs, Outputs, Status};

use super::promises::Repeated;
use super::scenes::Insertion;
use super::worst::{Defect, Place, ending, keep, listed, write_defects};

/// What was done and found.
#[derive(Debug, Default, Clone)]
pub(crate) struct Tally {
    pub(crate) insertions: u64,
    /// By vessel, first or later solve, and ending.
    endings: BTreeMap<(&'static str, &'static str, &'static str), u64>,
    /// Steps by how far the shaft was pushed in, and how many of them found no shape.
    by_push: BTreeMap<&'static str, [u64; 2]>,
    repeated: BTreeMap<Repeated, u64>,
    seconds: Vec<f64>,
    slowest: Vec<Place>,
    latest: Vec<Place>,
    /// Depth beyond the one told, of soft parts, rims, and rings between their rims.
    deeper: [Vec<Place>; 3],
    unbalanced: Vec<Place>,
    pub(crate) defects: Vec<Defect>,
}

impl Tally {
    /// Of an insertion that begins.
    pub(crate) fn of_one() -> Self {
        Self { insertions: 1, ..Self::default() }
    }

    /// Adds an answer; `last` are the inputs before.
    pub(crate) fn count(&mut self, own: &Insertion, out: &Outputs, last: Option<&Inputs>, inputs: &Inputs) {
        let when = if last.is_some() { "step" } else { "first" };
        *self.endings.entry((own.vessel, when, ending(out))).or_default() += 1;
        if let Some(last) = last {
            let by = 1e3 * (inputs.insertion - last.insertion);
            let push = match by {
                by if by < -1.0 => "back by more than 1 mm",
                by if by < 1.0 => "by less than 1 mm",
                by if by < 5.0 => "by 1 to 5 mm",
                _ => "by more than 5 mm",
            };
            let counts = self.by_push.entry(push).or_default();
            counts[0] += 1;
            counts[1] += u64::from(out.status == Status::NotSolved);
        }
    }

    /// Adds the processor time of a solve.
    pub(crate) fn time(&mut self, seconds: f64, budget: f64, (index, step): (u64, usize)) {
        self.seconds.push(seconds);
        keep(&mut self.slowest, &[(seconds, index, step)]);
        keep(&mut self.latest, &[(seconds - budget, index, step)]);
    }

    /// Adds depths beyond the one told.
    pub(crate) fn depths(&mut self, beyond: [f64; 3], (index, step): (u64, usize)) {
        for (list, value) in self.deeper.iter_mut().zip(beyond) {
            keep(list, &[(value, index, step)]);
        }
    }

    /// Adds a sum of forces.
    pub(crate) fn balance(&mut self, unbalanced: f64, (index, step): (u64, usize)) {
        keep(&mut self.unbalanced, &[(unbalanced, index, step)]);
    }

    /// Adds a step that was done again.
    pub(crate) fn repeated(&mut self, how: Repeated) {
        *self.repeated.entry(how).or_default() += 1;
    }

    /// Both.
    pub(crate) fn with(mut self, more: Self) -> Self {
        self.insertions += more.insertions;
        for (key, count) in more.endings {
            *self.endings.entry(key).or_default() += count;
        }
        for (key, counts) in more.by_push {
            let own = self.by_push.entry(key).or_default();
            *own = [own[0] + counts[0], own[1] + counts[1]];
        }
        for (key, count) in more.repeated {
            *self.repeated.entry(key).or_default() += count;
        }
        self.seconds.extend(more.seconds);
        keep(&mut self.slowest, &more.slowest);
        keep(&mut self.latest, &more.latest);
        for (list, more) in self.deeper.iter_mut().zip(&more.deeper) {
            keep(list, more);
        }
        keep(&mut self.unbalanced, &more.unbalanced);
        self.defects.extend(more.defects);
        self
    }

    /// Answers with this ending.
    #[cfg(test)]
    pub(crate) fn ended(&self, name: &str) -> u64 {
        self.endings.iter().filter(|row| row.0.2 == name).map(|row| row.1).sum()
    }

    /// All answers.
    pub(crate) fn solves(&self) -> u64 {
        self.endings.values().sum()
    }
}

impl fmt::Display for Tally {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut seconds = self.seconds.clone();
        seconds.sort_by(f64::total_cmp);
        // The longest of all, but for one in so many.
        let but_for = |many: usize| {
            seconds.len().checked_sub(1 + seconds.len() / many).map_or(f64::NAN, |at| seconds[at])
        };
        let whole: f64 = seconds.iter().sum();
        writeln!(
            out,
            "{} insertions, {} solves in {whole:.0} s of processor time",
            self.insertions,
            self.solves()
        )?;
        for ((vessel, when, name), count) in &self.endings {
            writeln!(out, "{vessel:>14} {when:<6} {name:<20} {count:>8}")?;
        }
        for (push, [count, without]) in &self.by_push {
            writeln!(out, "pushed {push:<24} {count:>8}, without a shape {without}")?;
        }
        writeln!(
            out,
            "times: median {:.1} ms, 99 % {:.1} ms; slowest {} s; beyond its budget {} s",
            1e3 * but_for(2),
            1e3 * but_for(100),
            listed(&self.slowest),
            listed(&self.latest)
        )?;
        for (name, places) in ["soft parts", "rims", "rings between their rims"].iter().zip(&self.deeper) {
            writeln!(out, "{name} deeper than told: {} m", listed(places))?;
        }
        writeln!(out, "unbalanced, of all forces: {}", listed(&self.unbalanced))?;
        let again: Vec<String> = self.repeated.iter().map(|(how, count)| format!("{how} {count}")).collect();
        writeln!(out, "steps done again in small parts: {}", again.join(", "))?;
        write_defects(out, "insertion", &self.defects)
    }
}

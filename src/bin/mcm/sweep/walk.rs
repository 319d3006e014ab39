//! The walks of a sweep: one for each combination of the other keys.

use std::path::Path;
use std::time::{Duration, Instant};

use indicatif::ProgressBar;
use mcm::error::Error;
use mcm::manipulator::{Branch, Fold, Followed, Inputs, Scene, SceneFile};
use mcm::methods::Device;
use rayon::prelude::*;

use super::journal::{Identity, Journal, Kept, Stage, State};
use super::range::Range;
use super::rows::{Columns, Row};
use super::way::Way;
use crate::failure::Failure;
use crate::interrupt;

/// Longest step between two solves, relative to the first key's range: a field that turns by half a circle moves along
/// chords of two degrees.
const LONGEST_STEP: f64 = 0.01;

/// How often the state of a walk is written: what a sweep that is killed computes again.
const BETWEEN_STATES: Duration = Duration::from_secs(1);

/// Results for one combination of the other keys.
pub(super) struct Walk {
    pub(super) others: Vec<f64>,
    pub(super) rows: Vec<Row>,
    pub(super) folds: Vec<(Fold, Way)>,
}

/// All walks of a sweep, not yet walked.
pub(super) struct Plan<'a> {
    file: SceneFile,
    along: &'a Range,
    others: &'a [Range],
    combinations: Vec<Vec<f64>>,
    back: bool,
    /// Whether the values of the first key are inputs of one device.
    same_device: bool,
    columns: Columns,
}

impl<'a> Plan<'a> {
    /// Checks every key and every value of the ranges, of which the first is walked along; `checked` is called after each.
    pub(super) fn new(
        file: SceneFile,
        vary: &'a [Range],
        back: bool,
        checked: impl Fn() + Sync,
    ) -> Result<Self, Failure> {
        let (along, others) = vary.split_at(1);
        let along = &along[0];
        let combinations = super::range::grid(others);
        let columns = Columns::of(&file.scene()?);
        let mut plan = Self { file, along, others, combinations, back, same_device: true, columns };

        let same = |combination: &Vec<f64>| {
            let varied = plan.with(combination)?;
            let mut first: Option<Scene> = None;
            let mut same = true;
            for &value in &along.values {
                let scene = varied.with(&along.key, value)?.scene()?;
                same &= is_same_device(first.get_or_insert_with(|| scene.clone()), &scene);
                checked();
            }
            Ok(same)
        };

        let same = plan.combinations.par_iter().map(same).collect::<Result<Vec<_>, Failure>>()?;
        plan.same_device = same.into_iter().all(|same| same);

        if back && !plan.same_device {
            return Err(Failure(format!(
                "--back does not apply to {}: each of its values is a separate device, which starts unloaded",
                along.key
            )));
        }

        Ok(plan)
    }

    /// Which columns the table has.
    pub(super) fn columns(&self) -> Columns {
        self.columns
    }

    /// Number of rows of one walk, and of all.
    pub(super) fn rows(&self) -> [usize; 2] {
        let forth = self.along.values.len();
        let each = if self.back { 2 * forth - 1 } else { forth };
        [each, each * self.combinations.len()]
    }

    /// What is known of each walk before the first row.
    pub(super) fn nothing_kept(&self) -> Vec<Kept> {
        Kept::nothing(self.combinations.len())
    }

    /// Opens the file that keeps the rows until all are there.
    pub(super) fn journal(&self, path: &Path, resume: bool) -> Result<(Journal, Vec<Kept>), Failure> {
        let mut stamp = crc32fast::Hasher::new();
        stamp.update(self.file.to_toml()?.as_bytes());
        let lumen = self.file.scene()?.vessel.map_or(0, |vessel| vessel.lumen.checksum());
        stamp.update(&lumen.to_le_bytes());
        stamp.update(&[u8::from(self.back)]);
        for range in std::iter::once(self.along).chain(self.others) {
            stamp.update(range.key.as_bytes());
            range.values.iter().for_each(|value| stamp.update(&value.to_bits().to_le_bytes()));
        }
        let keys: Vec<&str> =
            std::iter::once(self.along).chain(self.others).map(|range| range.key.as_str()).collect();
        let header = self.columns.header(keys.iter().copied());
        let identity = Identity {
            stamp: stamp.finalize(),
            header: &header,
            keys: keys.len(),
            columns: self.columns,
            walks: self.combinations.len(),
            rows_per_walk: self.rows()[0],
        };
        Journal::open(path, resume, &identity)
    }

    /// All walks in parallel, on from what is `kept` of them; `None` if they were stopped before the end.
    pub(super) fn run(
        &self,
        journal: Option<&Journal>,
        kept: Vec<Kept>,
        bar: &ProgressBar,
    ) -> Result<Option<Vec<Walk>>, Failure> {
        let walk = |(number, kept): (usize, Kept)| {
            let steps = Steps { plan: self, number, journal, bar };
            if self.same_device { steps.walk(kept) } else { steps.devices(kept) }
        };
        kept.into_par_iter().enumerate().map(walk).collect()
    }

    /// The scene with these values of the other keys.
    fn with(&self, values: &[f64]) -> Result<SceneFile, Failure> {
        let mut varied = self.file.clone();
        for (range, &value) in self.others.iter().zip(values) {
            varied = varied.with(&range.key, value)?;
        }
        Ok(varied)
    }
}

/// One walk under way.
struct Steps<'a> {
    plan: &'a Plan<'a>,
    number: usize,
    journal: Option<&'a Journal>,
    bar: &'a ProgressBar,
}

impl Steps<'_> {
    /// Follows one branch along the first key, and back.
    fn walk(&self, kept: Kept) -> Result<Option<Walk>, Failure> {
        let Plan { along, back, .. } = self.plan;
        let others = &self.plan.combinations[self.number];
        let file = self.plan.with(others)?;
        let manipulator = Device::of(&file.with(&along.key, along.values[0])?.scene()?, 2)?;
        let inputs = |value| Ok(file.with(&along.key, value)?.scene()?.inputs);
        // With a single value, or equal ones, any span will do.
        let span = if along.span() > 0.0 { along.span() } else { 1.0 };
        let mut branch = Branch::new(manipulator, inputs, span, LONGEST_STEP * span)?;
        let (mut rows, mut ways) = (Vec::new(), Vec::new());
        if let Some(state) = kept.state {
            rows = in_order(kept.rows, state.rows).into_iter().map_while(|row| row).collect();
            self.bar.inc(rows.len() as u64);
            ways = state.ways;
            match state.stage {
                Stage::UnderWay(snapshot) => branch.restore(&snapshot)?,
                Stage::Complete(folds) => {
                    let folds = folds.into_iter().zip(ways).collect();
                    return Ok(Some(Walk { others: others.clone(), rows, folds }));
                }
            }
        }
        let forth = along.values.iter().map(|&value| (value, Way::Forth));
        let backwards = along.values.iter().rev().skip(1).map(|&value| (value, Way::Back));
        let mut saved = Instant::now();
        for (value, way) in forth.chain(backwards.filter(|_| *back)).skip(rows.len()) {
            if interrupt::requested() {
                self.save(&branch, rows.len(), &ways)?;
                return Ok(None);
            }
            branch.to(value)?;
            let row = Row::new(
                self.plan.columns,
                [&[value], &others[..]].concat(),
                way,
                branch.outputs(),
                branch.predicted_fold(),
            )
            .leaving_out(branch.left_out());
            ways.resize(branch.folds().len(), way);
            self.keep(rows.len(), &row)?;
            rows.push(row);
            if saved.elapsed() > BETWEEN_STATES {
                self.save(&branch, rows.len(), &ways)?;
                saved = Instant::now();
            }
        }
        self.save(&branch, rows.len(), &ways)?;
        let folds = branch.folds().iter().cloned().zip(ways).collect();
        Ok(Some(Walk { others: others.clone(), rows, folds }))
    }

    /// Solves each value of the first key on a separate device, from its unloaded shape.
    fn devices(&self, kept: Kept) -> Result<Option<Walk>, Failure> {
        let along = self.plan.along;
        let others = &self.plan.combinations[self.number];
        let file = self.plan.with(others)?;

        let solve = |(index, (value, known)): (usize, (&f64, Option<Row>))| {
            if let Some(row) = known {
                self.bar.inc(1);
                return Ok(Some(row));
            }
            if interrupt::requested() {
                return Ok(None);
            }
            let scene = file.with(&along.key, *value)?.scene()?;
            let mut manipulator = Device::of(&scene, 2)?;
            manipulator.solve(&scene.inputs)?;
            let row = Row::new(
                self.plan.columns,
                [&[*value], &others[..]].concat(),
                Way::Forth,
                manipulator.measure_margin(),
                None,
            );
            self.keep(index, &row)?;
            Ok(Some(row))
        };

        let known = in_order(kept.rows, along.values.len());
        let rows = along.values.par_iter().zip(known).enumerate().map(solve);
        let rows = rows.collect::<Result<Option<Vec<_>>, Failure>>()?;
        Ok(rows.map(|rows| Walk { others: others.clone(), rows, folds: Vec::new() }))
    }

    /// Keeps a row for the case that the sweep does not come to its end.
    fn keep(&self, index: usize, row: &Row) -> Result<(), Failure> {
        self.bar.inc(1);
        let number = self.number * self.plan.rows()[0] + index;
        self.journal.map_or(Ok(()), |journal| journal.row(number, row))
    }

    /// Keeps the state after that many rows; a method without a state walks again from its first row.
    fn save<F: Fn(f64) -> Result<Inputs, Error>>(
        &self,
        branch: &Branch<F, Device>,
        rows: usize,
        ways: &[Way],
    ) -> Result<(), Failure> {
        let Some(journal) = self.journal else { return Ok(()) };
        let stage = if rows == self.plan.rows()[0] {
            Stage::Complete(branch.folds().to_vec())
        } else {
            let Some(snapshot) = branch.snapshot() else { return Ok(()) };
            Stage::UnderWay(Box::new(snapshot))
        };
        journal.state(self.number, &State { rows, ways: ways.to_vec(), stage })
    }
}

/// The first rows by their numbers; `None` where one is not known. Of two with the same number the later counts.
fn in_order(rows: Vec<(usize, Row)>, count: usize) -> Vec<Option<Row>> {
    let mut out: Vec<Option<Row>> = (0..count).map(|_| None).collect();
    for (number, row) in rows {
        if let Some(place) = out.get_mut(number) {
            *place = Some(row);
        }
    }
    out
}

/// Whether two scenes differ in their inputs alone.
fn is_same_device(a: &Scene, b: &Scene) -> bool {
    (&a.specification, &a.sources, &a.settings, &a.method, &a.vessel, &a.shaft, &a.guidewire)
        == (&b.specification, &b.sources, &b.settings, &b.method, &b.vessel, &b.shaft, &b.guidewire)
}

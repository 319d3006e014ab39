//! `mcm sweep`: equilibria while numbers of the scene vary.

mod range;
mod rows;
mod summary;

use std::io::Write;
use std::path::PathBuf;
use std::process::ExitCode;

use indicatif::{ProgressBar, ProgressStyle};
use mcm::manipulator::{Branch, Fold, Scene, SceneFile};
use rayon::prelude::*;
use serde::Serialize;

use super::failure::{Failure, NOT_CONVERGED};
use super::files::{create_table, read_scene};
use range::{Range, grid};
use rows::{Row, header};

/// Follows one branch along the first key, for every combination of the other keys.
#[derive(clap::Args)]
#[command(
    after_help = "KEY is a path in the scene file with indices from 1. Along the first key each solve starts from \
the shape of the one before, as the device would, in steps of at most a hundredth of the range; the combinations of the \
others run in parallel, each from the unloaded shape. Where the branch folds and the shape snaps, the value is located \
to 1e-5 of the range and reported, with the angles before and after. Forces and fields are in the world frame, units \
are in the column names.\n\n\
Examples, a field that grows, for three core lengths; a field that turns there and back; a magnet that turns:\n    \
mcm sweep scene.toml --vary 'field.uniform_mt[2]=0:25:26' --vary design.helix.length_mm=3:5:3 --out sweep.csv\n    \
mcm sweep scene.toml --vary field.turn_deg=0:170:171 --back --folds folds.csv --out sweep.csv\n    \
mcm sweep scene.toml --vary magnet.turn_deg=0:90:91 --out sweep.csv\n\n\
Rows that did not converge have no shape: outcome says why, progress how far the last step to them got.\n\n\
Exit status: 0 done, 1 bad input, 2 some rows did not converge (all files are written)."
)]
pub(crate) struct Sweep {
    /// Scene file (TOML)
    scene: PathBuf,
    /// A key and its values: COUNT values from START to STOP, both included
    #[arg(long, value_name = "KEY=START:STOP:COUNT", required = true)]
    vary: Vec<Range>,
    /// Then vary the first key back from its last value to its first, starting on the branch reached
    #[arg(long)]
    back: bool,
    /// CSV file for the results
    #[arg(long, value_name = "OUT.csv")]
    out: PathBuf,
    /// CSV file for the folds: the value of each, and the angles before and after
    #[arg(long, value_name = "FOLDS.csv")]
    folds: Option<PathBuf>,
}

/// Longest step between two solves, relative to the first key's range: a field that turns by half a circle moves along
/// chords of two degrees.
const LONGEST_STEP: f64 = 0.01;

/// Direction in which the first key varies.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
enum Way {
    Forth,
    Back,
}

impl std::fmt::Display for Way {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        out.write_str(if *self == Self::Forth { "forth" } else { "back" })
    }
}

/// Results for one combination of the other keys.
struct Walk {
    others: Vec<f64>,
    rows: Vec<Row>,
    folds: Vec<(Fold, Way)>,
}

impl Sweep {
    /// Runs the command.
    pub(crate) fn run(&self) -> Result<ExitCode, Failure> {
        let file = read_scene(&self.scene)?;
        let Some((along, others)) = self.vary.split_first() else { return Ok(ExitCode::SUCCESS) };
        let grid = grid(others);
        // Every key and value is checked before the first solve.
        let mut same_device = true;
        for combination in &grid {
            let varied = with(&file, others, combination)?;
            let mut first: Option<Scene> = None;
            for &value in &along.values {
                let scene = varied.with(&along.key, value)?.scene()?;
                same_device &= is_same_device(first.get_or_insert_with(|| scene.clone()), &scene);
            }
        }
        if self.back && !same_device {
            return Err(Failure::Message(format!(
                "--back does not apply to {}: each of its values is a separate device, which starts unloaded",
                along.key
            )));
        }
        let mut table = create_table(&self.out)?;
        let ways = if self.back { 2 } else { 1 };
        let bar = progress_bar((ways * grid.len() * along.values.len()) as u64);
        let walks: Vec<Walk> = grid
            .par_iter()
            .map(|combination| {
                let file = with(&file, others, combination)?;
                if same_device {
                    self.walk(&file, along, combination, &bar)
                } else {
                    devices(&file, along, combination, &bar)
                }
            })
            .collect::<Result<_, Failure>>()?;
        bar.finish_and_clear();
        let keys: Vec<&str> = self.vary.iter().map(|range| range.key.as_str()).collect();
        table.write_record(header(keys.iter().copied()))?;
        for row in walks.iter().flat_map(|walk| &walk.rows) {
            table.serialize(row.cells())?;
        }
        table.flush()?;
        if let Some(path) = &self.folds {
            summary::write_folds(path, &keys, &walks)?;
        }
        self.report(&keys, &walks)
    }

    /// Follows one branch along the first key, and back.
    fn walk(
        &self,
        file: &SceneFile,
        along: &Range,
        others: &[f64],
        bar: &ProgressBar,
    ) -> Result<Walk, Failure> {
        let manipulator = file.with(&along.key, along.values[0])?.scene()?.device(2)?;
        let inputs = |value| Ok(file.with(&along.key, value)?.scene()?.inputs);
        // With a single value, or equal ones, any span will do.
        let span = if along.span() > 0.0 { along.span() } else { 1.0 };
        let mut branch = Branch::new(manipulator, inputs, span, LONGEST_STEP * span)?;
        let forth = along.values.iter().map(|&value| (value, Way::Forth));
        let back = along.values.iter().rev().skip(1).map(|&value| (value, Way::Back));
        let (mut rows, mut folds) = (Vec::new(), Vec::new());
        for (value, way) in forth.chain(back.filter(|_| self.back)) {
            branch.to(value)?;
            rows.push(Row::new([&[value], others].concat(), way, branch.outputs(), branch.predicted_fold()));
            folds.resize(branch.folds().len(), way);
            bar.inc(1);
        }
        let folds = branch.folds().iter().cloned().zip(folds).collect();
        Ok(Walk { others: others.to_vec(), rows, folds })
    }

    /// Prints a summary and returns the exit status.
    fn report(&self, keys: &[&str], walks: &[Walk]) -> Result<ExitCode, Failure> {
        let rows = || walks.iter().flat_map(|walk| &walk.rows);
        let folds: usize = walks.iter().map(|walk| walk.folds.len()).sum();
        let mut stdout = std::io::stdout().lock();
        writeln!(stdout, "{}: {} rows, folds met: {folds}", self.out.display(), rows().count())?;
        for walk in walks {
            write!(stdout, "{}", summary::describe(keys, walk))?;
        }
        stdout.flush()?;
        let lost = rows().filter(|row| !row.converged());
        let Some(first) = lost.clone().next() else { return Ok(ExitCode::SUCCESS) };
        writeln!(
            std::io::stderr(),
            "warning: {} of {} rows did not converge and hold no shape; at {} = {}: {}",
            lost.count(),
            rows().count(),
            keys[0],
            first.value(),
            first.outcome()
        )?;
        Ok(NOT_CONVERGED.into())
    }
}

/// Whether two scenes differ in their inputs alone.
fn is_same_device(a: &Scene, b: &Scene) -> bool {
    (&a.specification, &a.magnets, &a.settings, &a.solver)
        == (&b.specification, &b.magnets, &b.settings, &b.solver)
}

/// Solves each value of the first key on a separate device, from its unloaded shape.
fn devices(file: &SceneFile, along: &Range, others: &[f64], bar: &ProgressBar) -> Result<Walk, Failure> {
    let solve = |&value: &f64| {
        let scene = file.with(&along.key, value)?.scene()?;
        let mut manipulator = scene.device(2)?;
        manipulator.solve(&scene.inputs)?;
        bar.inc(1);
        Ok(Row::new([&[value], others].concat(), Way::Forth, manipulator.measure_margin(), None))
    };
    let rows = along.values.par_iter().map(solve).collect::<Result<_, Failure>>()?;
    Ok(Walk { others: others.to_vec(), rows, folds: Vec::new() })
}

fn with(file: &SceneFile, ranges: &[Range], values: &[f64]) -> Result<SceneFile, Failure> {
    let mut varied = file.clone();
    for (range, &value) in ranges.iter().zip(values) {
        varied = varied.with(&range.key, value)?;
    }
    Ok(varied)
}

/// Progress bar on standard error; hidden where that is not a terminal.
fn progress_bar(solves: u64) -> ProgressBar {
    let bar = ProgressBar::new(solves);
    if let Ok(style) = ProgressStyle::with_template("{bar:40} {pos}/{len} solves, {eta} left") {
        bar.set_style(style);
    }
    bar
}

//! `mcm sweep`: equilibria while numbers of the scene vary.

use std::path::PathBuf;
use std::process::ExitCode;
use std::str::FromStr;

use indicatif::{ProgressBar, ProgressStyle};
use mcm::manipulator::{Outputs, Scene, SceneFile, Status};
use rayon::prelude::*;

use super::failure::Failure;
use super::files::{create_table, read_scene};

/// Follows one branch of equilibria along the first key, for every combination of the other keys.
#[derive(clap::Args)]
#[command(
    after_help = "KEY is a path in the scene file with indices from 1. Along the first key each solve starts from \
the shape of the one before, as the device would; the combinations of the others run in parallel, each from the \
unloaded shape. Forces and fields are in the world frame, units are in the column names.\n\n\
Example, a field that grows, for three core lengths:\n    \
mcm sweep scene.toml --vary 'field.uniform_mt[2]=0:25:26' --vary design.helix.length_mm=3:5:3 --out sweep.csv"
)]
pub(crate) struct Sweep {
    /// Scene file (TOML)
    scene: PathBuf,
    /// A key and its values: COUNT values from START to STOP, both included
    #[arg(long, value_name = "KEY=START:STOP:COUNT", required = true)]
    vary: Vec<Range>,
    /// Where the results go, CSV
    #[arg(long, value_name = "OUT.csv")]
    out: PathBuf,
}

/// More values of one key are a slip of the pen: their table would not fit into memory.
const MOST_VALUES: u32 = 1_000_000;

/// Values of one key.
#[derive(Clone)]
struct Range {
    key: String,
    values: Vec<f64>,
}

impl FromStr for Range {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let form = || format!("\"{text}\" is not of the form KEY=START:STOP:COUNT");
        let (key, range) = text.split_once('=').ok_or_else(form)?;
        let [start, stop, count] = range.split(':').collect::<Vec<_>>()[..] else { return Err(form()) };
        let number = |text: &str| match text.trim().parse::<f64>() {
            Ok(number) if number.is_finite() => Ok(number),
            _ => Err(format!("\"{text}\" is no finite number")),
        };
        let (start, stop) = (number(start)?, number(stop)?);
        let count: u32 = count.trim().parse().map_err(|_| format!("\"{count}\" is no count"))?;
        if !(1..=MOST_VALUES).contains(&count) {
            return Err(format!("COUNT = {count} is not allowed: it must be from 1 to {MOST_VALUES}"));
        }
        let last = f64::from(count - 1);
        let value = |i: u32| if i == 0 { start } else { start + (stop - start) * (f64::from(i) / last) };
        Ok(Self { key: key.trim().into(), values: (0..count).map(value).collect() })
    }
}

impl Sweep {
    /// Runs the command.
    pub(crate) fn run(&self) -> Result<ExitCode, Failure> {
        let file = read_scene(&self.scene)?;
        let Some((along, others)) = self.vary.split_first() else { return Ok(ExitCode::SUCCESS) };
        let grid = grid(others);
        // Every key and value is tried before the first solve.
        for combination in &grid {
            for &value in &along.values {
                with(&file, others, combination)?.with(&along.key, value)?.scene()?;
            }
        }
        let mut table = create_table(&self.out)?;
        let bar = progress_bar((grid.len() * along.values.len()) as u64);
        let branches: Vec<Vec<Row>> = grid
            .par_iter()
            .map(|combination| branch(&with(&file, others, combination)?, along, combination, &bar))
            .collect::<Result<_, Failure>>()?;
        bar.finish_and_clear();
        let keys = self.vary.iter().map(|range| range.key.as_str());
        table.write_record(keys.chain(NUMBERS).chain(FLAGS))?;
        for row in branches.iter().flatten() {
            table.serialize(row)?;
        }
        table.flush()?;
        Ok(ExitCode::SUCCESS)
    }
}

/// Every combination of the ranges' values, the last range fastest.
fn grid(ranges: &[Range]) -> Vec<Vec<f64>> {
    ranges.iter().fold(vec![Vec::new()], |grid, range| {
        let extended = |start: &Vec<f64>| {
            let start = start.clone();
            range.values.iter().map(move |&value| [&start[..], &[value]].concat())
        };
        grid.iter().flat_map(extended).collect()
    })
}

fn with(file: &SceneFile, ranges: &[Range], values: &[f64]) -> Result<SceneFile, Failure> {
    let mut varied = file.clone();
    for (range, &value) in ranges.iter().zip(values) {
        varied = varied.with(&range.key, value)?;
    }
    Ok(varied)
}

/// Follows one branch along the first key.
fn branch(file: &SceneFile, along: &Range, others: &[f64], bar: &ProgressBar) -> Result<Vec<Row>, Failure> {
    let mut last: Option<(Scene, mcm::manipulator::Manipulator)> = None;
    let mut rows = Vec::with_capacity(along.values.len());
    for &value in &along.values {
        let scene = file.with(&along.key, value)?.scene()?;
        // Another design, magnet or model is another device, which starts unloaded; other inputs are the same device.
        let same = last.take().filter(|(before, _)| {
            (&before.specification, &before.magnets, &before.settings)
                == (&scene.specification, &scene.magnets, &scene.settings)
        });
        let mut manipulator = match same {
            Some((_, manipulator)) => manipulator,
            None => scene.manipulator(2)?,
        };
        manipulator.solve(&scene.inputs)?;
        let outputs = manipulator.measure_margin();
        let varied = [&[value], others].concat();
        rows.push(row(varied, outputs));
        last = Some((scene, manipulator));
        bar.inc(1);
    }
    Ok(rows)
}

/// Hidden when standard error is no terminal.
fn progress_bar(solves: u64) -> ProgressBar {
    let bar = ProgressBar::new(solves);
    if let Ok(style) = ProgressStyle::with_template("{bar:40} {pos}/{len} solves, {eta} left") {
        bar.set_style(style);
    }
    bar
}

const NUMBERS: [&str; 29] = [
    "alpha_deg",
    "tip_x_mm",
    "tip_y_mm",
    "tip_z_mm",
    "largest_core_angle_deg",
    "magnetic_force_x_n",
    "magnetic_force_y_n",
    "magnetic_force_z_n",
    "magnetic_torque_x_nm",
    "magnetic_torque_y_nm",
    "magnetic_torque_z_nm",
    "base_reaction_force_x_n",
    "base_reaction_force_y_n",
    "base_reaction_force_z_n",
    "base_reaction_moment_x_nm",
    "base_reaction_moment_y_nm",
    "base_reaction_moment_z_nm",
    "magnet_reaction_force_x_n",
    "magnet_reaction_force_y_n",
    "magnet_reaction_force_z_n",
    "magnet_reaction_torque_x_nm",
    "magnet_reaction_torque_y_nm",
    "magnet_reaction_torque_z_nm",
    "tip_field_x_mt",
    "tip_field_y_mt",
    "tip_field_z_mt",
    "energy_j",
    "residual",
    "stability_margin",
];

const FLAGS: [&str; 4] = ["stable", "snaps", "converged", "iterations"];

/// Varied values, [`NUMBERS`], [`FLAGS`].
type Row = (Vec<f64>, Vec<f64>, (Option<bool>, u32, bool, u32));

fn row(varied: Vec<f64>, outputs: &Outputs) -> Row {
    const MM_PER_M: f64 = 1e3;
    const MT_PER_T: f64 = 1e3;
    let largest = outputs.core_angles.iter().copied().fold(0.0, f64::max);
    let mut numbers = vec![outputs.tip_angle.to_degrees()];
    numbers.extend(&(outputs.tip.position * MM_PER_M));
    numbers.push(largest.to_degrees());
    for vector in [
        &outputs.magnetic_force,
        &outputs.magnetic_torque,
        &outputs.base_reaction_force,
        &outputs.base_reaction_moment,
        &outputs.magnet_reaction_force,
        &outputs.magnet_reaction_torque,
        &(outputs.tip_field * MT_PER_T),
    ] {
        numbers.extend(vector);
    }
    numbers.extend([outputs.energy, outputs.residual, outputs.stability_margin]);
    let converged = outputs.status != Status::NotSolved;
    (varied, numbers, (outputs.stable, outputs.snaps, converged, outputs.iterations))
}

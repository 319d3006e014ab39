//! `mcm study accuracy`: errors and times of all methods as a table and a chart, and the Pareto fronts in Markdown.

use std::path::Path;
use std::process::ExitCode;

use mcm::studies::{PEERS, Point, Series, Stroke, accuracy, accuracy_picture, front};
use serde::Deserialize;

use super::failure::Failure;
use super::files::{bad_table, open_table};
use super::progress::Parts;
use super::study_files::leave;

const HEADER: &str = "\
| field | segments | level | start | method | resolution | time (us) | tip error over length | angle (deg) | force and torque |
| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |
";

/// A row of the table of peers: a result of other software.
#[derive(Debug, Deserialize)]
struct Peer {
    case: String,
    solver: String,
    /// Kind of start, or whether the field comes with its gradient.
    variant: String,
    time_us: f64,
    error: f64,
}

/// Variants that are plotted dashed.
const DASHED: [&str; 2] = ["cold", "with gradient"];

/// Measures and writes accuracy.csv, accuracy.md and accuracy.png to `out`; prints the fronts as well.
pub(super) fn run(out: &Path, peers: Option<&Path>) -> Result<ExitCode, Failure> {
    let peers = peers.map(read_peers).transpose()?.unwrap_or_default();
    let scenes = Parts::of("scenes");
    let points = accuracy(&scenes)?;
    scenes.0.finish_and_clear();
    leave(out, "accuracy", &points, &accuracy_picture(&points, peers), &fronts(&points))
}

/// The Pareto fronts of all scenes and starts, in Markdown.
fn fronts(points: &[Point]) -> String {
    let firsts = points.iter().enumerate().filter(|(i, point)| !points[..*i].iter().any(|p| p.beside(point)));
    let rows = firsts.flat_map(|(_, first)| front(points.iter().filter(|point| point.beside(first))));
    format!("{HEADER}{}", rows.map(row).collect::<String>())
}

fn row(point: &Point) -> String {
    let number = |value: Option<f64>| value.map_or_else(String::new, |value| format!("{value:.0e}"));
    let time = point.time_us.map_or_else(String::new, |time| format!("{time:.0}"));
    let Point { field, segments, interaction, start, name, resolution, .. } = point;
    let errors = [point.tip_over_length, point.angle_deg, point.wrench_relative].map(number).join(" | ");
    format!(
        "| {field} | {segments} | {interaction} | {start} | {name} | {resolution} | {time} | {errors} |\n"
    )
}

/// Reads the series by case, solver and variant; a solver has one colour and one label.
fn read_peers(path: &Path) -> Result<[Vec<Series>; PEERS.len()], Failure> {
    let mut cases: [Vec<Series>; PEERS.len()] = Default::default();
    let mut solvers: [Vec<String>; PEERS.len()] = Default::default();
    for peer in open_table(path)?.deserialize() {
        let Peer { case, solver, variant, time_us, error } = peer.map_err(|error| bad_table(path, &error))?;
        let Some(index) = PEERS.iter().position(|known| known.name == case) else {
            return Err(Failure(format!("{}: there is no case {case}", path.display())));
        };
        let (series, solvers) = (&mut cases[index], &mut solvers[index]);
        let stroke = if DASHED.contains(&variant.as_str()) { Stroke::Dashed } else { Stroke::Solid };
        let place = [time_us, error];
        let known = solvers.iter().position(|known| *known == solver);
        let colour = known.unwrap_or(solvers.len());
        if let Some(own) = series.iter_mut().find(|own| (own.colour, own.stroke) == (colour, stroke)) {
            own.places.push(place);
        } else {
            let label = if known.is_some() { String::new() } else { solver.clone() };
            series.push(Series { label, colour, stroke, places: vec![place] });
        }
        if known.is_none() {
            solvers.push(solver);
        }
    }
    // A single point has no line.
    for series in cases.iter_mut().flatten().filter(|series| series.places.len() == 1) {
        series.stroke = Stroke::Dots;
    }
    Ok(cases)
}

//! `mcm study accuracy`: points of error and time as a table, the picture, the fronts in Markdown.

use std::path::Path;
use std::process::ExitCode;

use mcm::studies::{Point, Series, Stroke, accuracy, accuracy_cases, accuracy_picture, front};
use serde::Deserialize;

use super::failure::Failure;
use super::study::{leave, progress_bar};

const HEADER: &str = "\
| field | segments | level | start | method | resolution | time (us) | tip error over length | angle (deg) | force and torque |
| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |
";

/// A row of the table of peers.
#[derive(Debug, Deserialize)]
struct Peer {
    solver: String,
    start: String,
    time_us: f64,
    error_rad: f64,
}

/// Measures, and leaves accuracy.csv, accuracy.md and accuracy.png in `out`; the fronts are printed, too.
pub(super) fn run(out: &Path, peers: Option<&Path>) -> Result<ExitCode, Failure> {
    let peers = peers.map_or(Ok(Vec::new()), read_peers)?;
    let bar = progress_bar(accuracy_cases() as u64, "scenes");
    let points = accuracy(|| bar.inc(1))?;
    bar.finish_and_clear();
    leave(out, "accuracy", &points, &accuracy_picture(&points, peers), &fronts(&points))
}

/// The fronts of all scenes and starts.
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

/// Series by solver and start.
fn read_peers(path: &Path) -> Result<Vec<Series>, Failure> {
    let failure = |error: csv::Error| Failure::Message(format!("cannot read {}: {error}", path.display()));
    let mut series: Vec<Series> = Vec::new();
    let (mut solvers, mut reader) = (Vec::<String>::new(), csv::Reader::from_path(path).map_err(failure)?);
    for peer in reader.deserialize() {
        let Peer { solver, start, time_us, error_rad } = peer.map_err(failure)?;
        let label = format!("{solver}, {start}");
        let colour = solvers.iter().position(|known| *known == solver).unwrap_or_else(|| {
            solvers.push(solver);
            solvers.len() - 1
        });
        let stroke = if start == "cold" { Stroke::Dashed } else { Stroke::Solid };
        let place = [time_us, error_rad];
        match series.iter_mut().find(|known| known.label == label) {
            Some(known) => known.places.push(place),
            None => series.push(Series { label, colour, stroke, places: vec![place] }),
        }
    }
    Ok(series)
}

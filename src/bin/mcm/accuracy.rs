//! `mcm study accuracy`: errors and times of all methods as a table, and the Pareto fronts in Markdown.

use std::path::Path;
use std::process::ExitCode;

use mcm::studies::{Point, accuracy, front};

use super::failure::Failure;
use super::progress::Parts;
use super::study_files::leave;

const HEADER: &str = "\
| field | segments | level | start | method | resolution | time (us) | tip error over length | angle (deg) | force and torque |
| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |
";

/// Measures and writes accuracy.csv and accuracy.md to `out`; prints the fronts as well.
pub(super) fn run(out: &Path) -> Result<ExitCode, Failure> {
    let scenes = Parts::of("scenes");
    let points = accuracy(&scenes)?;
    scenes.0.finish_and_clear();
    leave(out, "accuracy", &points, &fronts(&points))
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

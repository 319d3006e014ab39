//! `mcm study bifurcation`: diagrams as tables, folds and predictions in Markdown.

use std::fmt::Write as _;
use std::path::Path;
use std::process::ExitCode;

use mcm::studies::{Bifurcation, DISTANCES, Place, Prediction, bifurcation};

use super::failure::Failure;
use super::progress::Parts;
use super::study_files::{leave_study, tell};

/// Writes bifurcation.csv, bifurcation-marks.csv and bifurcation.md to `out`; prints the Markdown tables as well.
pub(super) fn run(out: &Path) -> Result<ExitCode, Failure> {
    let diagrams = Parts::of("branches");
    let Bifurcation { study, places, predictions } = bifurcation(&diagrams)?;
    diagrams.0.finish_and_clear();
    leave_study(out, "bifurcation", &study)?;
    tell(out, "bifurcation", &format!("{}\n{}", table_of_places(&places), table_of_predictions(&predictions)))
}

fn table_of_places(places: &[Place]) -> String {
    let mut out =
        "| what happens | continuation | bisection | closed form |\n| --- | --- | --- | --- |\n".to_owned();
    for Place { what, continuation, bisection, closed_form } in places {
        let number =
            |value: &Option<f64>, digits| value.map_or_else(String::new, |value| format!("{value:.digits$}"));
        let (bisection, closed_form) = (number(bisection, 3), number(closed_form, 6));
        let _ = writeln!(out, "| {what} | {continuation:.6} | {bisection} | {closed_form} |");
    }
    out
}

fn table_of_predictions(predictions: &[Prediction]) -> String {
    let row = |first: &str, cells: &[String]| format!("| {first} | {} |\n", cells.join(" | "));
    let mut out =
        row("snap, and distance before it", &DISTANCES.map(|distance| format!("{} %", 100.0 * distance)));
    out += &row("---", &DISTANCES.map(|_| "---".to_owned()));
    for Prediction { what, errors } in predictions {
        let cell = |error: &Option<f64>| {
            error.map_or_else(|| "none".into(), |error| format!("{:+.1} %", 100.0 * error))
        };
        out += &row(what, &errors.iter().map(cell).collect::<Vec<_>>());
    }
    out
}

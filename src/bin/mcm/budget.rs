//! `mcm study budget`: what changes the tip angle and by how much, as a table and Markdown.

use std::path::Path;
use std::process::ExitCode;

use mcm::studies::{Contribution, budget};

use super::failure::Failure;
use super::progress::Parts;
use super::study_files::leave;

const HEADER: &str = "\
| kind | quantity | change | scene | tip angle (deg) | least change (%) | largest change (%) |
| --- | --- | --- | --- | --- | --- | --- |
";

/// Computes and writes budget.csv and budget.md to `out`; prints the table as well.
pub(super) fn run(out: &Path) -> Result<ExitCode, Failure> {
    let changes = Parts::of("changes");
    let rows = budget(&changes)?;
    changes.0.finish_and_clear();
    let table = rows.iter().map(row).collect::<String>();
    leave(out, "budget", &rows, &format!("{HEADER}{table}"))
}

fn row(row: &Contribution) -> String {
    let written = |value: Option<f64>| value.map_or_else(String::new, |value| format!("{value:+.2}"));
    let angle = row.tip_angle_deg.map_or_else(String::new, |angle| format!("{angle:.2}"));
    format!(
        "| {:?} | {} | {} | {} | {angle} | {} | {} |\n",
        row.kind,
        row.quantity,
        row.change,
        row.scene.unwrap_or_default(),
        written(row.least_percent),
        if row.pulled_shut { "pulled shut".into() } else { written(row.largest_percent) }
    )
}

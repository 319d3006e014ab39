//! `mcm study fidelity`: what the level `auto` saves, as a table, a picture and Markdown.

use std::path::Path;
use std::process::ExitCode;

use mcm::studies::{Fidelity, fidelity, fidelity_picture, fidelity_scenes};

use super::failure::Failure;
use super::study::{leave, progress_bar};

const HEADER: &str = "\
| scene | model | tolerance over length | time (us) | over the richest | tip error over length | angle (deg) | steps by the richest |
| --- | --- | --- | --- | --- | --- | --- | --- |
";

/// Measures, and leaves fidelity.csv, fidelity.md and fidelity.png in `out`; the table is printed, too.
pub(super) fn run(out: &Path) -> Result<ExitCode, Failure> {
    let bar = progress_bar(fidelity_scenes() as u64, "scenes");
    let rows = fidelity(|| bar.inc(1))?;
    bar.finish_and_clear();
    let table = rows.iter().map(row).collect::<String>();
    leave(out, "fidelity", &rows, &fidelity_picture(&rows), &format!("{HEADER}{table}"))
}

fn row(row: &Fidelity) -> String {
    let tolerance = row.tolerance.map_or_else(String::new, |tolerance| format!("{tolerance:.0e}"));
    format!(
        "| {} | {} | {tolerance} | {:.0} | {:.3} | {:.0e} | {:.0e} | {:.0} % |\n",
        row.scene,
        row.model,
        row.time_us,
        row.time_relative,
        row.tip_over_length,
        row.angle_deg,
        100.0 * row.by_richest
    )
}

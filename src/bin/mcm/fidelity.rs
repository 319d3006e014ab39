//! `mcm study fidelity`: time saved and error made by the level `auto`, as a table and Markdown.

use std::path::Path;
use std::process::ExitCode;

use mcm::studies::{Fidelity, Omission, fidelity, omissions};

use super::failure::Failure;
use super::progress::Parts;
use super::study_files::leave;

const HEADER: &str = "\
| scene | model | tolerance over length | time (us) | over the richest | tip error over length | angle (deg) |
| --- | --- | --- | --- | --- | --- | --- |
";

const LEFT_OUT: &str = "\
| scene | left out of `rings` | time (us) | over that of `rings` | tip error over length | angle (deg) |
| --- | --- | --- | --- | --- | --- |
";

/// Measures and writes fidelity.csv and fidelity.md to `out`; prints the tables as well.
pub(super) fn run(out: &Path) -> Result<ExitCode, Failure> {
    let walks = Parts::of("models along a path");
    let rows = fidelity(&walks)?;
    let table = rows.iter().map(row).collect::<String>();
    let left_out = omissions(&walks)?.iter().map(left_out).collect::<String>();
    walks.0.finish_and_clear();
    let tables = format!("{HEADER}{table}\n{LEFT_OUT}{left_out}");
    leave(out, "fidelity", &rows, &tables)
}

fn left_out(row: &Omission) -> String {
    format!(
        "| {} | {} | {:.0} | {:.2} | {:.0e} | {:.0e} |\n",
        row.scene, row.what, row.time_us, row.time_relative, row.tip_over_length, row.angle_deg
    )
}

fn row(row: &Fidelity) -> String {
    let tolerance = row.tolerance.map_or_else(String::new, |tolerance| format!("{tolerance:.0e}"));
    format!(
        "| {} | {} | {tolerance} | {:.0} | {:.3} | {:.0e} | {:.0e} |\n",
        row.scene, row.model, row.time_us, row.time_relative, row.tip_over_length, row.angle_deg
    )
}

//! Output files of studies.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use mcm::studies::Study;
use serde::Serialize;

use super::failure::Failure;
use super::output::{Output, Table, print};

/// Writes a study's columns to NAME.csv and its marks, if it has any, to NAME-marks.csv in `out`; a missing value is an empty cell.
pub(super) fn leave_study(out: &Path, name: &str, study: &Study) -> Result<(), Failure> {
    let mut table = Table::at(&file(out, name, "csv"))?;
    table.header(study.columns.iter().map(|column| &column.name))?;
    let rows = study.columns.first().map_or(0, |column| column.values.len());
    for row in 0..rows {
        let cells = study.columns.iter().map(|column| Some(column.values[row]).filter(|v| !v.is_nan()));
        table.row(cells.collect::<Vec<_>>())?;
    }
    table.complete()?;
    if study.marks.is_empty() {
        return Ok(());
    }
    let mut table = Table::at(&file(out, &format!("{name}-marks"), "csv"))?;
    table.header(["mark", "x", "y"])?;
    study.marks.iter().try_for_each(|mark| table.row((&mark.name, mark.x, mark.y)))?;
    table.complete()
}

/// Writes rows and Markdown tables to NAME.csv and NAME.md in `out`, and prints the Markdown.
pub(super) fn leave(
    out: &Path,
    name: &str,
    rows: &[impl Serialize],
    markdown: &str,
) -> Result<ExitCode, Failure> {
    let mut table = Table::at(&file(out, name, "csv"))?;
    rows.iter().try_for_each(|row| table.row(row))?;
    table.complete()?;
    tell(out, name, markdown)
}

/// Writes Markdown tables to NAME.md in `out` and prints them.
pub(super) fn tell(out: &Path, name: &str, markdown: &str) -> Result<ExitCode, Failure> {
    Output::at(&file(out, name, "md"))?.fill(markdown.as_bytes())?;
    print(markdown)?;
    Ok(ExitCode::SUCCESS)
}

fn file(out: &Path, name: &str, ending: &str) -> PathBuf {
    out.join(name).with_extension(ending)
}

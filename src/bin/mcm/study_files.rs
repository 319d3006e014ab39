//! Output files of studies.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use mcm::studies;
use serde::Serialize;

use super::failure::Failure;
use super::output::{Output, Table, print};
use super::picture;

/// Writes a study's columns and chart to NAME.csv and NAME.png in `out`; a missing value is an empty cell.
pub(super) fn leave_drawn(out: &Path, name: &str, study: &studies::Study) -> Result<(), Failure> {
    let mut table = Table::at(&file(out, name, "csv"))?;
    table.header(study.columns.iter().map(|column| &column.name))?;
    let rows = study.columns.first().map_or(0, |column| column.values.len());
    for row in 0..rows {
        let cells = study.columns.iter().map(|column| Some(column.values[row]).filter(|v| !v.is_nan()));
        table.row(cells.collect::<Vec<_>>())?;
    }
    table.complete()?;
    picture::write(study, &file(out, name, "png"))
}

/// Writes rows, chart and Markdown tables to NAME.csv, NAME.png and NAME.md in `out`, and prints the Markdown.
pub(super) fn leave(
    out: &Path,
    name: &str,
    rows: &[impl Serialize],
    picture: &studies::Study,
    markdown: &str,
) -> Result<ExitCode, Failure> {
    let mut table = Table::at(&file(out, name, "csv"))?;
    rows.iter().try_for_each(|row| table.row(row))?;
    table.complete()?;
    picture::write(picture, &file(out, name, "png"))?;
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

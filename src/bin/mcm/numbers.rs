//! Tables of numbers under titles.

use std::path::Path;

use super::failure::Failure;
use super::files::{bad_table, open_table};
use super::nearest::nearest;

/// A table with a finite number in every cell.
pub(crate) struct Numbers {
    pub(crate) titles: Vec<String>,
    pub(crate) rows: Vec<Line>,
}

/// A row, and where it stands.
pub(crate) struct Line {
    pub(crate) cells: Vec<f64>,
    place: String,
}

impl Line {
    /// The failure for this reason.
    pub(crate) fn failure(&self, reason: impl std::fmt::Display) -> Failure {
        Failure(format!("{}: {reason}", self.place))
    }
}

impl Numbers {
    /// Reads a table; `fault` says what is wrong with a title.
    pub(crate) fn read(path: &Path, fault: impl Fn(&str) -> Option<String>) -> Result<Self, Failure> {
        let name = path.display();
        let mut table = open_table(path)?;
        let header = table.headers().map_err(|error| bad_table(path, &error))?.clone();
        let titles: Vec<String> = header.iter().map(str::to_owned).collect();

        for (number, title) in titles.iter().enumerate() {
            if titles[..number].contains(title) {
                return Err(Failure(format!("{name} has two columns {title}")));
            }
            if let Some(fault) = fault(title) {
                return Err(Failure(format!("{name}: {fault}")));
            }
        }

        let mut rows = Vec::new();
        for record in table.records() {
            let record = record.map_err(|error| bad_table(path, &error))?;
            let line = record.position().map_or(0, csv::Position::line);
            let mut row = Line { cells: Vec::new(), place: format!("{name}, line {line}") };
            for (text, title) in record.iter().zip(&titles) {
                let number = text.parse().ok().filter(|number: &f64| number.is_finite());
                let wrong = || row.failure(format_args!("{title} = \"{text}\" is not a finite number"));
                row.cells.push(number.ok_or_else(wrong)?);
            }
            rows.push(row);
        }

        if rows.is_empty() {
            return Err(Failure(format!("{name} has no rows")));
        }
        Ok(Self { titles, rows })
    }
}

/// The known name that is nearest to a wrong one, as a question; empty where none is near.
pub(crate) fn did_you_mean(wrong: &str, known: impl IntoIterator<Item = String>) -> String {
    nearest(wrong, known).map_or(String::new(), |name| format!("; did you mean {name}?"))
}

//! A table with columns of numbers, in which cells may be empty, and of words.

use std::path::Path;

use crate::failure::Failure;
use crate::files::{bad_table, open_table};
use crate::numbers::did_you_mean;

/// A table.
pub(super) struct Sheet {
    name: String,
    pub(super) titles: Vec<String>,
    /// The cells of each row, and the line on which it stands.
    rows: Vec<(u64, Vec<String>)>,
}

impl Sheet {
    /// Reads a table that has rows, and at least one column of numbers.
    pub(super) fn read(path: &Path) -> Result<Self, Failure> {
        let mut table = open_table(path)?;
        let bad = |error: csv::Error| bad_table(path, &error);
        let titles: Vec<String> = table.headers().map_err(bad)?.iter().map(str::to_owned).collect();

        let mut rows = Vec::new();
        for record in table.records() {
            let record = record.map_err(bad)?;
            let line = record.position().map_or(0, csv::Position::line);
            rows.push((line, record.iter().map(str::to_owned).collect()));
        }

        let sheet = Self { name: path.display().to_string(), titles, rows };

        let twice =
            (1..sheet.titles.len()).find(|number| sheet.titles[..*number].contains(&sheet.titles[*number]));
        if let Some(number) = twice {
            return Err(sheet.failure(format_args!("two columns are called {}", sheet.titles[number])));
        }
        if sheet.rows.is_empty() {
            return Err(sheet.failure("there are no rows"));
        }

        let has_numbers =
            |column| sheet.numbers(column).is_ok_and(|numbers| numbers.iter().any(Option::is_some));
        if !(0..sheet.titles.len()).any(has_numbers) {
            return Err(sheet.failure("there is no column of numbers under a title"));
        }

        Ok(sheet)
    }

    /// The failure for this reason.
    pub(super) fn failure(&self, reason: impl std::fmt::Display) -> Failure {
        Failure(format!("{}: {reason}", self.name))
    }

    /// Number of rows.
    pub(super) fn len(&self) -> usize {
        self.rows.len()
    }

    /// The column with this title.
    pub(super) fn find(&self, title: &str) -> Result<usize, Failure> {
        self.titles.iter().position(|known| known == title).ok_or_else(|| {
            let suggested = did_you_mean(title, self.titles.iter().cloned());
            self.failure(format_args!("there is no column {title}{suggested}"))
        })
    }

    /// The cells of a column.
    pub(super) fn cells(&self, column: usize) -> impl Iterator<Item = &str> {
        self.rows.iter().map(move |(_, cells)| cells[column].as_str())
    }

    /// The numbers of a column; `None` in an empty cell.
    pub(super) fn numbers(&self, column: usize) -> Result<Vec<Option<f64>>, Failure> {
        let number = |(line, cells): &(u64, Vec<String>)| {
            let cell = &cells[column];
            if cell.is_empty() {
                return Ok(None);
            }
            let number = cell.parse().ok().filter(|number: &f64| number.is_finite());
            let title = &self.titles[column];
            let wrong =
                || self.failure(format_args!("line {line}: {title} = \"{cell}\" is not a finite number"));
            number.map(Some).ok_or_else(wrong)
        };
        self.rows.iter().map(number).collect()
    }

    /// The columns of numbers that do not have the same value everywhere.
    pub(super) fn varied(&self) -> impl Iterator<Item = usize> {
        (0..self.titles.len()).filter(|column| {
            let numbers = self.numbers(*column).unwrap_or_default();
            let mut known = numbers.iter().flatten();
            known.next().is_some_and(|first| known.any(|other| (other - first).abs() > 0.0))
        })
    }

    /// Whether the cell of each row in the column with this title, if there is one, is this word.
    pub(super) fn says(&self, title: &str, word: &str) -> Vec<bool> {
        match self.titles.iter().position(|known| known == title) {
            Some(column) => self.cells(column).map(|cell| cell == word).collect(),
            None => vec![false; self.len()],
        }
    }
}

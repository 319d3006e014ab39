//! The rows of an unfinished sweep: a table beside its own place, to which each row is added as soon as it is known.
//!
//! Its first line says of which sweep. The column `row` counts through the whole table. A comment
//! `# at WALK STATE` holds what a walk needs to go on from its last row.

use std::fs::{self, File};
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use mcm::manipulator::{Fold, PathSnapshot};
use serde::{Deserialize, Serialize};

use super::rows::{Columns, Row};
use super::way::Way;
use crate::failure::Failure;
use crate::output::warn;

/// What the file begins with.
const TITLE: &str = "# mcm";

/// What the comments with states begin with.
const AT: &str = "# at ";

/// The file of an unfinished sweep.
pub(super) struct Journal {
    path: PathBuf,
    file: Mutex<File>,
}

/// What is known of a walk.
#[derive(Default)]
pub(super) struct Kept {
    /// Its rows with their numbers within the walk.
    pub(super) rows: Vec<(usize, Row)>,
    /// Its last state; `None` where there is none to go on from.
    pub(super) state: Option<State>,
}

impl Kept {
    /// What is known of so many walks before the first row.
    pub(super) fn nothing(walks: usize) -> Vec<Self> {
        (0..walks).map(|_| Self::default()).collect()
    }
}

/// State of a walk from which it goes on.
#[derive(Serialize, Deserialize)]
pub(super) struct State {
    /// Number of rows until there.
    pub(super) rows: usize,
    /// The direction in which each fold was met.
    pub(super) ways: Vec<Way>,
    pub(super) stage: Stage,
}

/// How far a walk has come.
#[derive(Serialize, Deserialize)]
pub(super) enum Stage {
    /// To this state of its branch.
    UnderWay(Box<PathSnapshot>),
    /// To its end, past these folds.
    Complete(Vec<Fold>),
}

/// What identifies a sweep and its table.
pub(super) struct Identity<'a> {
    /// A number that differs for every other sweep.
    pub(super) stamp: u32,
    pub(super) header: &'a [String],
    /// Number of keys that are varied.
    pub(super) keys: usize,
    pub(super) columns: Columns,
    pub(super) walks: usize,
    pub(super) rows_per_walk: usize,
}

impl Journal {
    /// Begins the file at `path`, or takes up the one that is there. Returns what is known of each walk.
    pub(super) fn open(path: &Path, resume: bool, sweep: &Identity) -> Result<(Self, Vec<Kept>), Failure> {
        let name = path.display();
        let foreign =
            || Failure(format!("{name} is of no sweep, or damaged: delete it, or choose another --out"));

        let old = match fs::read(path) {
            Ok(bytes) => {
                Some(String::from_utf8(bytes).map_err(|_| foreign())?).filter(|text| !text.is_empty())
            }
            Err(error) if error.kind() == ErrorKind::NotFound => None,
            Err(error) => return Err(Failure(format!("cannot read {name}: {error}"))),
        };

        if old.as_ref().is_some_and(|text| !text.starts_with(TITLE)) {
            return Err(foreign());
        }

        let failure = |error| Failure::writing(path.display(), error);

        // Locked before anything is read from it: two sweeps would mix their rows.
        let file = File::options().create(true).append(true).open(path).map_err(failure)?;
        if file.try_lock().is_err() {
            return Err(Failure(format!("{name} is being written by another sweep")));
        }

        if old.is_some() && !resume {
            return Err(Failure(format!(
                "{name} holds the rows of an unfinished sweep: go on with --resume, or delete it"
            )));
        }
        if old.is_none() && resume {
            warn(&format!("there is no unfinished sweep {name}: this one starts at its first row"));
        }

        let (length, kept) = match &old {
            Some(text) => sweep.read(text).ok_or_else(|| {
                Failure(format!("{name} is of another sweep or version: delete it, or choose another --out"))
            })?,
            None => (0, Kept::nothing(sweep.walks)),
        };

        // A row that was being written when the sweep was stopped is cut off.
        file.set_len(length).map_err(failure)?;
        let journal = Self { path: path.to_owned(), file: Mutex::new(file) };
        if length == 0 {
            journal.add(format!("{}\nrow,{}\n", sweep.title(), sweep.header.join(",")).as_bytes())?;
        }

        Ok((journal, kept))
    }

    /// Adds a row, with its number in the whole table.
    pub(super) fn row(&self, number: usize, row: &Row) -> Result<(), Failure> {
        let mut line = csv::Writer::from_writer(Vec::new());
        line.serialize((number, row.cells()))
            .map_err(|error| Failure::writing(self.path.display(), error))?;
        let bytes =
            line.into_inner().map_err(|error| Failure::writing(self.path.display(), error.error()))?;
        self.add(&bytes)
    }

    /// Adds the state of a walk.
    pub(super) fn state(&self, walk: usize, state: &State) -> Result<(), Failure> {
        let bytes =
            postcard::to_stdvec(state).map_err(|error| Failure::writing(self.path.display(), error))?;
        self.add(format!("{AT}{walk} {}\n", in_digits(&bytes)).as_bytes())
    }

    /// Adds whole lines at once, so that rows of several walks do not mix.
    fn add(&self, lines: &[u8]) -> Result<(), Failure> {
        let mut file = self.file.lock().unwrap_or_else(PoisonError::into_inner);
        file.write_all(lines).map_err(|error| Failure::writing(self.path.display(), error))
    }

    /// Removes the file: the table is complete.
    pub(super) fn remove(self) -> Result<(), Failure> {
        drop(self.file);
        fs::remove_file(&self.path)
            .map_err(|error| Failure(format!("cannot remove {}: {error}", self.path.display())))
    }

    /// Its path.
    pub(super) fn path(&self) -> &Path {
        &self.path
    }
}

impl Identity<'_> {
    fn title(&self) -> String {
        format!(
            "{TITLE} {} sweep {:08x}, unfinished: --resume goes on",
            env!("CARGO_PKG_VERSION"),
            self.stamp
        )
    }

    /// The length of what is whole, bytes, and what it says of each walk; `None` for the file of another sweep.
    fn read(&self, text: &str) -> Option<(u64, Vec<Kept>)> {
        // What was cut off has no end of line.
        let whole = &text[..=text.rfind('\n')?];
        let lines = whole.strip_prefix(&self.title())?;
        let mut kept = Kept::nothing(self.walks);
        let table =
            csv::ReaderBuilder::new().comment(Some(b'#')).from_reader(lines.as_bytes()).into_records();
        for record in table {
            let (number, row) = numbered(&record.ok()?, self.keys, self.columns)?;
            kept.get_mut(number / self.rows_per_walk)?.rows.push((number % self.rows_per_walk, row));
        }
        for line in lines.lines().filter_map(|line| line.strip_prefix(AT)) {
            let (walk, state) = line.split_once(' ')?;
            let state: State = postcard::from_bytes(&from_digits(state)?).ok()?;
            kept.get_mut(walk.parse::<usize>().ok()?)?.state = Some(state);
        }
        Some((whole.len() as u64, kept))
    }
}

/// The number of a row and the row itself.
fn numbered(record: &csv::StringRecord, keys: usize, columns: Columns) -> Option<(usize, Row)> {
    let mut cells = record.iter();
    Some((cells.next()?.parse().ok()?, Row::read(cells, keys, columns)?))
}

/// Bytes as hexadecimal digits.
fn in_digits(bytes: &[u8]) -> String {
    const DIGITS: &[u8; 16] = b"0123456789abcdef";
    let digit = |half: u8| char::from(DIGITS[usize::from(half)]);
    bytes.iter().flat_map(|byte| [digit(byte >> 4), digit(byte & 15)]).collect()
}

fn from_digits(digits: &str) -> Option<Vec<u8>> {
    let byte = |pair: &[u8]| u8::from_str_radix(std::str::from_utf8(pair).ok()?, 16).ok();
    digits.as_bytes().chunks(2).map(byte).collect()
}

//! Output files: written beside their place, and moved there when they are complete.

use std::fs::{self, File};
use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use serde::Serialize;
use tempfile::TempPath;

use super::failure::Failure;

/// Files beside their places, which a signal would leave there.
static UNFINISHED: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// Removes what has been begun: the program ends now.
pub(crate) fn remove_unfinished() {
    for path in UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner).drain(..) {
        // One that has been completed is no longer there.
        drop(fs::remove_file(path));
    }
}

/// A file that is being written. Unless it is completed, nothing is left of it, and an older file stays as it was.
pub(crate) struct Output {
    name: PathBuf,
    file: Place,
}

/// Where the bytes go.
enum Place {
    /// To a file beside `target`, which it replaces when it is complete.
    Beside { target: PathBuf, file: BufWriter<File>, place: TempPath },
    /// To a device or a pipe, which cannot be replaced.
    There(BufWriter<File>),
}

impl Output {
    /// Begins the file at `path`; fails at once if it cannot be written there.
    pub(crate) fn at(path: &Path) -> Result<Self, Failure> {
        let file = place(path).map_err(|error| Failure::writing(path.display(), reason(path, &error)))?;
        Ok(Self { name: path.to_owned(), file })
    }

    /// Moves the complete file to its place.
    pub(crate) fn complete(self) -> Result<(), Failure> {
        let Self { name, file } = self;
        let done = match file {
            Place::There(mut file) => file.flush(),
            Place::Beside { target, mut file, place } => {
                file.flush().and_then(|()| place.persist(target).map_err(|error| error.error))
            }
        };
        done.map_err(|error| Failure::writing(name.display(), error))
    }

    /// Writes the whole file.
    pub(crate) fn fill(mut self, content: &[u8]) -> Result<(), Failure> {
        self.write_all(content).map_err(|error| Failure::writing(self.name.display(), error))?;
        self.complete()
    }
}

impl Write for Output {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match &mut self.file {
            Place::Beside { file, .. } => file.write(bytes),
            Place::There(file) => file.write(bytes),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        match &mut self.file {
            Place::Beside { file, .. } => file.flush(),
            Place::There(file) => file.flush(),
        }
    }
}

fn place(path: &Path) -> io::Result<Place> {
    // A link stays a link; the file that it names is replaced.
    let target = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
    let old = fs::metadata(&target).ok();
    if old.as_ref().is_some_and(|old| !old.is_file()) {
        return Ok(Place::There(BufWriter::new(File::options().write(true).open(&target)?)));
    }
    // A file that may not be written is not replaced either.
    if old.is_some() {
        File::options().append(true).open(&target)?;
    }
    let mut beside = tempfile::Builder::new();
    beside.prefix(".mcm-").suffix(".part");
    #[cfg(unix)]
    let usual = std::os::unix::fs::PermissionsExt::from_mode(0o666);
    #[cfg(unix)]
    beside.permissions(usual);
    let (file, place) = beside.tempfile_in(folder(&target))?.into_parts();
    if let Some(old) = old {
        file.set_permissions(old.permissions())?;
    }
    UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner).push(place.to_path_buf());
    Ok(Place::Beside { target, file: BufWriter::new(file), place })
}

/// The folder of a file.
pub(crate) fn folder(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

fn reason(path: &Path, error: &io::Error) -> String {
    let folder = folder(path);
    if path.is_dir() {
        "it is a folder".into()
    } else if !folder.is_dir() {
        format!("there is no folder {}", folder.display())
    } else {
        // Only the reason: the name is that of the file beside.
        io::Error::from(error.kind()).to_string()
    }
}

/// A table that is being written.
pub(crate) struct Table {
    name: PathBuf,
    rows: csv::Writer<Output>,
}

impl Table {
    /// Begins the table at `path`.
    pub(crate) fn at(path: &Path) -> Result<Self, Failure> {
        Ok(Self { name: path.to_owned(), rows: csv::Writer::from_writer(Output::at(path)?) })
    }

    /// Writes the names of the columns, unless the rows are structures with named fields.
    pub(crate) fn header<T: AsRef<[u8]>>(
        &mut self,
        names: impl IntoIterator<Item = T>,
    ) -> Result<(), Failure> {
        self.rows.write_record(names).map_err(|error| Failure::writing(self.name.display(), error))
    }

    /// Writes a row; a missing value is an empty cell.
    pub(crate) fn row(&mut self, cells: impl Serialize) -> Result<(), Failure> {
        self.rows.serialize(cells).map_err(|error| Failure::writing(self.name.display(), error))
    }

    /// Moves the complete table to its place.
    pub(crate) fn complete(self) -> Result<(), Failure> {
        let output =
            self.rows.into_inner().map_err(|error| Failure::writing(self.name.display(), error.error()))?;
        output.complete()
    }
}

/// Writes to standard output. A reader that has closed the pipe has read what it wanted: that is no failure.
pub(crate) fn print(text: impl AsRef<[u8]>) -> Result<(), Failure> {
    let mut out = io::stdout().lock();
    match out.write_all(text.as_ref()).and_then(|()| out.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(Failure::writing("to standard output", error))
        }
        _ => Ok(()),
    }
}

/// Writes a warning to standard error; where that is closed, the exit status still tells.
pub(crate) fn warn(message: &str) {
    let _ = writeln!(io::stderr(), "warning: {message}");
}

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
    file: BufWriter<File>,
    /// The place of the file beside its target, which it replaces when it is complete, and that target; `None` for a device or
    /// a pipe, which is written at once.
    beside: Option<(TempPath, PathBuf)>,
}

impl Output {
    /// Begins the file at `path`; fails at once if it cannot be written there.
    pub(crate) fn at(path: &Path) -> Result<Self, Failure> {
        let (file, beside) =
            begin(path).map_err(|error| Failure::writing(path.display(), reason(path, &error)))?;
        Ok(Self { name: path.to_owned(), file: BufWriter::new(file), beside })
    }

    /// Moves the complete file to its place.
    pub(crate) fn complete(self) -> Result<(), Failure> {
        let Self { name, mut file, beside } = self;
        let moved = |(place, target): (TempPath, PathBuf)| place.persist(target).map_err(|error| error.error);
        let done = file.flush().and_then(|()| beside.map_or(Ok(()), moved));
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
        self.file.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

/// The file to write to, and where it goes.
fn begin(path: &Path) -> io::Result<(File, Option<(TempPath, PathBuf)>)> {
    // A link stays a link; the file that it names is replaced.
    let target = place(path);
    if is_stream(path) {
        return Ok((File::options().write(true).open(&target)?, None));
    }
    let old = fs::metadata(&target).ok();
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
    Ok((file, Some((place, target))))
}

/// Where a file is or would be, links resolved.
pub(crate) fn place(path: &Path) -> PathBuf {
    let beside = || Some(fs::canonicalize(folder(path)).ok()?.join(path.file_name()?));
    fs::canonicalize(path).ok().or_else(beside).unwrap_or_else(|| path.to_owned())
}

/// Whether it is there and no file that could be replaced: a device, a pipe, a folder.
pub(crate) fn is_stream(path: &Path) -> bool {
    fs::metadata(path).is_ok_and(|old| !old.is_file())
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

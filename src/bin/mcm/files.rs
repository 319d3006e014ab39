//! Reading scenes and tables, writing tables.

use std::fs::File;
use std::path::Path;

use mcm::manipulator::SceneFile;

use super::failure::Failure;

/// Smallest similarity (1: equal) at which another file's name is suggested as a correction.
const PLAUSIBLE: f64 = 0.5;

/// Reads a scene file.
pub(crate) fn read_scene(path: &Path) -> Result<SceneFile, Failure> {
    Ok(SceneFile::parse(&read_text(path)?, &path.display().to_string())?)
}

/// Reads a text file.
pub(crate) fn read_text(path: &Path) -> Result<String, Failure> {
    std::fs::read_to_string(path).map_err(|error| unreadable(path, &error))
}

/// Opens a table; lines that start with `#` are comments.
pub(crate) fn open_table(path: &Path) -> Result<csv::Reader<File>, Failure> {
    let file = File::open(path).map_err(|error| unreadable(path, &error))?;
    Ok(csv::ReaderBuilder::new().comment(Some(b'#')).trim(csv::Trim::All).from_reader(file))
}

/// Creates a table.
pub(crate) fn create_table(path: &Path) -> Result<csv::Writer<File>, Failure> {
    let file = File::create(path)
        .map_err(|error| Failure::Message(format!("cannot write {}: {error}", path.display())))?;
    Ok(csv::Writer::from_writer(file))
}

fn unreadable(path: &Path, error: &std::io::Error) -> Failure {
    let hint = match nearest_file(path) {
        Some(name) if error.kind() == std::io::ErrorKind::NotFound => format!("; did you mean {name}?"),
        _ => String::new(),
    };
    Failure::Message(format!("cannot read {}: {error}{hint}", path.display()))
}

/// The file in the same folder whose name is most similar to that of a missing file.
fn nearest_file(path: &Path) -> Option<String> {
    let wanted = path.file_name()?.to_string_lossy().into_owned();
    let folder = path.parent()?;
    let here = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    std::fs::read_dir(here)
        .ok()?
        .filter_map(|entry| {
            let name = entry.ok()?.file_name().to_string_lossy().into_owned();
            let similarity = strsim::normalized_damerau_levenshtein(&wanted, &name);
            (similarity >= PLAUSIBLE).then(|| (similarity, folder.join(name).display().to_string()))
        })
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, name)| name)
}

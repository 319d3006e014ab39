//! Reading scenes and tables.

use std::fs::{self, File};
use std::io::Read;
use std::path::Path;

use mcm::manipulator::SceneFile;

use super::doing::Doing;
use super::failure::Failure;
use super::nearest::nearest;
use super::output::{folder, place, warn};

/// Largest length of a scene, bytes.
const LONGEST_TEXT: u64 = 10_000_000;

/// Reads a scene file, and the mesh that it may name; warns of what is odd about it.
pub(crate) fn read_scene(path: &Path) -> Result<SceneFile, Failure> {
    let text = read_text(path)?;
    let _doing = Doing::now(format!("reading {} and its vessel", path.display()));
    let file = SceneFile::parse_in(&text, &path.display().to_string(), folder(path))?;
    for odd in file.warnings()? {
        warn(&format!("{}: {odd}", path.display()));
    }
    Ok(file)
}

/// Reads a text file, or as much from a pipe.
fn read_text(path: &Path) -> Result<String, Failure> {
    let mut text = String::new();
    let file = File::open(path).map_err(|error| unreadable(path, &error))?;
    file.take(LONGEST_TEXT + 1).read_to_string(&mut text).map_err(|error| unreadable(path, &error))?;
    if text.len() as u64 > LONGEST_TEXT {
        return Err(Failure(format!(
            "{} is no scene: it has more than {LONGEST_TEXT} bytes",
            path.display()
        )));
    }
    Ok(text)
}

/// Opens a table; lines that start with `#` are comments.
pub(crate) fn open_table(path: &Path) -> Result<csv::Reader<File>, Failure> {
    let file = File::open(path).map_err(|error| unreadable(path, &error))?;
    Ok(csv::ReaderBuilder::new().comment(Some(b'#')).trim(csv::Trim::All).from_reader(file))
}

/// Refuses to write over what is read or a scene, and to write two outputs into one file.
pub(crate) fn refuse_same(read: &[&Path], written: &[&Path]) -> Result<(), Failure> {
    match written.iter().find(|out| is_scene(out)) {
        Some(out) => Err(Failure(format!("{} is called like a scene: choose another name", out.display()))),
        None => refuse_over(read, written),
    }
}

/// Whether a file is called like a scene.
pub(crate) fn is_scene(path: &Path) -> bool {
    path.extension().is_some_and(|ending| ending == "toml")
}

/// Refuses to write over what is read, and to write two outputs into one file.
pub(crate) fn refuse_over(read: &[&Path], written: &[&Path]) -> Result<(), Failure> {
    for (number, out) in written.iter().enumerate() {
        let own = place(out);
        if let Some(input) = read.iter().find(|input| place(input) == own) {
            return Err(Failure(format!(
                "{} would be written over {}, which is read",
                out.display(),
                input.display()
            )));
        }
        if let Some(other) = written[..number].iter().find(|other| place(other) == own) {
            return Err(Failure(format!("{} and {} would be the same file", other.display(), out.display())));
        }
    }
    Ok(())
}

/// The failure of reading a table.
pub(crate) fn bad_table(path: &Path, error: &csv::Error) -> Failure {
    Failure(format!("cannot read {}: {error}", path.display()))
}

fn unreadable(path: &Path, error: &std::io::Error) -> Failure {
    let hint = match nearest_file(path) {
        Some(name) if error.kind() == std::io::ErrorKind::NotFound => format!("; did you mean {name}?"),
        _ => String::new(),
    };
    Failure(format!("cannot read {}: {error}{hint}", path.display()))
}

/// The file in the same folder whose name is most similar to that of a missing file.
fn nearest_file(path: &Path) -> Option<String> {
    let wanted = path.file_name()?.to_string_lossy();
    let named = path.parent()?;
    let entries = fs::read_dir(folder(path)).ok()?;
    let names = entries.filter_map(|entry| Some(entry.ok()?.file_name().to_string_lossy().into_owned()));
    Some(named.join(nearest(&wanted, names)?).display().to_string())
}

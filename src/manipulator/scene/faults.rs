//! Reading a scene text: all its faults at once, each with its line, its key and what is wrong.

use std::ops::Range;

use serde::Deserialize;
use toml::de::{DeTable, DeValue, Deserializer};
use toml::{Spanned, Value};

use super::SceneFile;
use super::path::{entry, numbers, suggestion};
use crate::error::Error;
use crate::vessel::Lumen;

/// Largest number of faults that are told of one text.
const MOST: usize = 20;

/// Reads the scene of a text called `what`.
///
/// An entry at fault is left out, and the rest read again, until no more faults are found. `mesh_of` gives the mesh of a name, `lumen_of`
/// its lumen, `text_of` the text of another file that is named.
pub(super) fn read<Mesh>(
    text: &str,
    what: &str,
    mesh_of: impl FnOnce(&str) -> Result<Mesh, Error>,
    lumen_of: impl FnOnce(&str, Mesh) -> Result<Lumen, Error>,
    text_of: impl Fn(&str) -> Result<String, Error>,
) -> Result<SceneFile, Error> {
    let mut faults = Faults { text, what, found: Vec::new() };
    let (root, broken) = DeTable::parse_recoverable(text);
    for error in &broken {
        let span = error.span().unwrap_or(0..0);
        let reason = error.message().replace('\n', ", ");
        let key = text.get(span.clone()).filter(|_| reason == "duplicate key").unwrap_or_default();
        let key = if key.is_empty() { String::new() } else { format!(" `{key}`") };
        faults.add(Some(span.start), reason + &key);
    }
    if !broken.is_empty() {
        return Err(faults.all());
    }
    let file = faults.types_and_keys(&root);
    let Some(mut file) = file else { return Err(faults.all()) };
    if let Err(error) = file.find_multipoles(text_of) {
        let named = root.get_ref().get("coil").map(|coils| coils.span().start);
        faults.add(named, error.to_string());
        return Err(faults.all());
    }
    if let Some(name) = file.mesh_stl().map(str::to_owned) {
        let lumen = match mesh_of(&name) {
            Ok(mesh) => {
                // To sample a mesh may take half a minute: what is wrong besides is told before.
                faults.values(root.get_ref(), &file, SceneFile::check_before_mesh)?;
                if !faults.found.is_empty() {
                    return Err(faults.all());
                }
                lumen_of(&name, mesh)
            }
            Err(error) => Err(error),
        };
        file.set_mesh(lumen);
    }
    faults.values(root.get_ref(), &file, |file| file.scene().map(|_| ()))?;
    if faults.found.is_empty() { Ok(file) } else { Err(faults.all()) }
}

/// The faults found so far in a text.
struct Faults<'a> {
    text: &'a str,
    what: &'a str,
    /// With where they begin.
    found: Vec<(usize, Error)>,
}

impl Faults<'_> {
    /// Adds the fault that begins at `start`; `None` for one that is nowhere in the text.
    fn add(&mut self, start: Option<usize>, reason: String) {
        let start = start.unwrap_or(usize::MAX);
        let line = self.text.get(..start).map(|before| before.matches('\n').count() + 1);
        let line = line.map_or_else(String::new, |line| format!(", line {line}"));
        self.found.push((start, Error::Syntax { what: format!("{}{line}", self.what), reason }));
    }

    /// All of them, in the order of the text.
    fn all(mut self) -> Error {
        self.found.sort_by_key(|(start, _)| *start);
        let mut errors: Vec<Error> = self.found.into_iter().map(|(_, error)| error).collect();
        if errors.len() == 1 { errors.remove(0) } else { Error::Several(errors) }
    }

    /// Finds keys that do not exist, values of another type and arrays of another length. What is left of the file without
    /// them; `None` where nothing can be read without them.
    fn types_and_keys(&mut self, root: &Spanned<DeTable<'_>>) -> Option<SceneFile> {
        let mut kept = root.clone();
        let mut file = loop {
            let error = match SceneFile::deserialize(Deserializer::from(kept.clone())) {
                Ok(file) => break file,
                Err(error) => error,
            };

            // The deserialiser stops at its first error: note it, take the entry out and read again.
            let span = error.span().unwrap_or(0..0);
            let path = entries(root.get_ref()).into_iter().rfind(|entry| entry.is_at(&span));
            let path = path.map(|entry| entry.path);
            let kind = kind_of(root.get_ref());
            self.add(Some(span.start), explained(error.message().trim_end(), path.as_deref(), &kind));
            if !remove(kept.get_mut(), &span) || self.found.len() == MOST {
                return None;
            }
        };

        file.complete();
        let mut written = Value::Table(file.table().ok()?);

        // Arrays of fixed length are read without complaint when they are too long: compare with what was
        // kept.
        for Entry { path, span, value, .. } in entries(kept.get_ref()) {
            if let DeValue::Array(given) = value
                && let Ok(Value::Array(kept)) = entry(&mut written, &path)
                && given.len() > kept.len()
            {
                self.add(
                    Some(span.start),
                    format!("{path} has {} entries, expected {}", given.len(), kept.len()),
                );
            }
        }

        Some(file)
    }

    /// Finds values out of their range, those that `check` refuses.
    fn values(
        &mut self,
        root: &DeTable<'_>,
        file: &SceneFile,
        check: impl Fn(&SceneFile) -> Result<(), Error>,
    ) -> Result<(), Error> {
        let mut table = Value::Table(file.table()?);
        let mut rest = file.clone();
        for (path, number) in numbers(&table, "").into_iter().filter(|(_, number)| !number.is_finite()) {
            self.add(start_of(root, &path), Error::range(path.as_str(), number, "finite").to_string());
            forget(&mut table, &path);
            // Nothing can be read without an entry that has no default.
            let Ok(next) = self.reread(&table, file) else { return Ok(()) };
            rest = next;
        }
        let mut told: Vec<String> = Vec::new();
        while self.found.len() < MOST {
            let Err(error) = check(&rest) else { return Ok(()) };
            // A combination proves nothing once a part of it has been left out, nor a count where the design is not known.
            let proves = match error {
                // A syntax error is that of a mesh, which depends on nothing else.
                Error::Range { .. } | Error::Syntax { .. } => true,
                Error::Count { .. } => {
                    !self.found.iter().any(|(_, fault)| fault.to_string().contains("`design."))
                }
                _ => self.found.is_empty(),
            };
            let reason = error.to_string();
            let mut words = reason.split(' ').map(|word| word.trim_end_matches(':'));
            let key = words.find(|word| entry(&mut table.clone(), word).is_ok());
            let path = key.unwrap_or("design").to_owned();
            if proves && !told.contains(&path) {
                self.add(start_of(root, &path), reason);
                told.push(path.clone());
            }
            if !forget(&mut table, &path) {
                return Ok(());
            }
            let Ok(next) = self.reread(&table, file) else { return Ok(()) };
            rest = next;
        }
        Ok(())
    }

    /// The file with these entries, and the mesh of `whole`.
    fn reread(&self, table: &Value, whole: &SceneFile) -> Result<SceneFile, Error> {
        let mut file: SceneFile = table.clone().try_into().map_err(|error: toml::de::Error| {
            Error::Syntax { what: self.what.into(), reason: error.message().into() }
        })?;
        file.complete();
        file.mesh.clone_from(&whole.mesh);
        Ok(file)
    }
}

/// The kind of the device that the text states; empty where it states none.
fn kind_of(root: &DeTable<'_>) -> String {
    let stated = entries(root).into_iter().find(|entry| entry.path == "design.kind");
    match stated.map(|entry| entry.value) {
        Some(DeValue::String(name)) => name.to_string(),
        _ => String::new(),
    }
}

/// The reason of an error of serde, with the full path of the key, in a scene of a device of this kind.
fn explained(message: &str, path: Option<&str>, kind: &str) -> String {
    // serde writes the key in backquotes, then the known keys.
    match (message.strip_prefix("unknown field `"), path) {
        (Some(rest), path) => {
            let (key, mut known) = given_and_known(rest);
            if path.is_some_and(|path| path.strip_prefix("design.") == Some(key)) {
                known = SceneFile::keys_of_device(kind);
            }
            format!("unknown key `{}`{}", path.unwrap_or(key), suggestion(key, &known))
        }
        (None, Some(path)) => format!("`{path}`: {}", in_words(message)),
        (None, None) => message.replace('\n', ", "),
    }
}

/// What serde says, in words of the file.
fn in_words(message: &str) -> String {
    let Some(rest) = message.strip_prefix("unknown variant `") else {
        return message.replace("expected usize", "expected a whole number from 0");
    };
    let (given, known) = given_and_known(rest);
    format!("\"{given}\" is not known here: choose one of {}", known.join(", "))
}

/// The name that serde does not know, whose first backquote is taken off already, and those that it knows, each in backquotes.
fn given_and_known(rest: &str) -> (&str, Vec<&str>) {
    let mut quoted = rest.split('`').step_by(2);
    (quoted.next().unwrap_or_default(), quoted.collect())
}

/// A key or an entry of an array.
struct Entry<'a> {
    path: String,
    /// Where its key is in the text, or the value of an entry of an array.
    span: Range<usize>,
    value: &'a DeValue<'a>,
    value_span: Range<usize>,
}

impl Entry<'_> {
    fn is_at(&self, span: &Range<usize>) -> bool {
        self.span == *span || self.value_span == *span
    }
}

/// All keys and entries of arrays; those within another come after it.
fn entries<'a>(root: &'a DeTable<'a>) -> Vec<Entry<'a>> {
    fn add<'a>(path: String, span: Range<usize>, value: &'a Spanned<DeValue<'a>>, out: &mut Vec<Entry<'a>>) {
        let inside = path.clone();
        out.push(Entry { path, span, value: value.get_ref(), value_span: value.span() });
        match value.get_ref() {
            DeValue::Table(table) => {
                for (key, value) in table {
                    add(format!("{inside}.{}", key.get_ref()), key.span(), value, out);
                }
            }
            DeValue::Array(array) => {
                for (index, value) in array.iter().enumerate() {
                    add(format!("{inside}[{}]", index + 1), value.span(), value, out);
                }
            }
            _ => {}
        }
    }
    let mut out = Vec::new();
    for (key, value) in root {
        add(key.get_ref().to_string(), key.span(), value, &mut out);
    }
    out
}

/// Where the text gives a key, or the nearest table around it.
fn start_of(root: &DeTable<'_>, path: &str) -> Option<usize> {
    let known = entries(root);
    let mut path = path;
    loop {
        if let Some(entry) = known.iter().find(|entry| entry.path == path) {
            return Some(entry.span.start);
        }
        path = &path[..path.rfind(['.', '['])?];
    }
}

/// Removes the key at `span`, or the one whose value is there.
fn remove(table: &mut DeTable<'_>, span: &Range<usize>) -> bool {
    let mut own = None;
    for (key, value) in table.iter_mut() {
        let here = key.span() == *span;
        match if here { Some(false) } else { remove_in(value, span) } {
            Some(true) => return true,
            Some(false) => own = Some(key.clone()),
            None => {}
        }
    }
    own.is_some_and(|key| table.remove(&key).is_some())
}

/// Removes the key at `span` within a value: whether that is done, or the whole value is meant; `None` for neither.
fn remove_in(value: &mut Spanned<DeValue<'_>>, span: &Range<usize>) -> Option<bool> {
    let meant = (value.span() == *span).then_some(false);
    let inside = match value.get_mut() {
        DeValue::Table(table) => remove(table, span).then_some(true),
        DeValue::Array(array) => array.iter_mut().find_map(|value| remove_in(value, span)),
        _ => None,
    };
    inside.or(meant)
}

/// Removes a key, so that its default takes its place; an array as a whole. Where there is no such key, the table around it.
fn forget(file: &mut Value, path: &str) -> bool {
    let path = path.split('[').next().unwrap_or_default();
    let (table, key) = path.rsplit_once('.').unwrap_or(("", path));
    let inside = if table.is_empty() { Ok(&mut *file) } else { entry(file, table) };
    let removed = inside.ok().and_then(Value::as_table_mut).and_then(|inside| inside.remove(key));
    removed.is_some() || (!table.is_empty() && forget(file, table))
}

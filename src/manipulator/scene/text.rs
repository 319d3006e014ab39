//! Reading and writing scene text, with the place and reason of errors.

use toml::{Table, Value};

use super::mesh::unplaced;
use super::path::entry;
use super::{SceneFile, faults};
use crate::error::Error;
use crate::vessel::Lumen;

impl SceneFile {
    /// The JSON schema of a scene (draft 7): types, defaults, ranges and descriptions of all tables and keys.
    ///
    /// It is made from the code; relations between numbers, such as that of an inner to an outer radius, are in its `$comment`s.
    pub const SCHEMA: &str = include_str!("schema.json");

    /// Reads a scene file's text; `what` names it in error messages.
    ///
    /// # Errors
    /// [`Error::Syntax`] with line, key and reason for the one fault of a text, [`Error::Several`] of these for several: what
    /// is no TOML, unknown keys, values of another type, numbers that are not finite or out of range. A mesh is not found from a
    /// text alone: see [`SceneFile::parse_in`].
    pub fn parse(text: &str, what: &str) -> Result<Self, Error> {
        Self::parse_with(text, what, |name| Err(unplaced(name)))
    }

    /// Reads a scene where `lumen_of` gives the lumen of the mesh that a scene names as `vessel.mesh_stl`.
    ///
    /// # Errors
    /// As [`SceneFile::parse`]; those of `lumen_of` with their place.
    pub fn parse_with(
        text: &str,
        what: &str,
        lumen_of: impl FnOnce(&str) -> Result<Lumen, Error>,
    ) -> Result<Self, Error> {
        faults::read(text, what, |_| Ok(()), |name, ()| lumen_of(name), |name| Err(unplaced(name)))
    }

    /// The text of this file with every default written out.
    ///
    /// # Errors
    /// [`Error::Syntax`] for a number of segments beyond what TOML can write.
    pub fn to_toml(&self) -> Result<String, Error> {
        toml::to_string(self).map_err(|error| unwritable(&error))
    }

    /// This file with the number at `key` replaced.
    ///
    /// `key` is a path in the file with indices from 1: `field.uniform_mt[2]`, `magnet.cylinders[1].radius_mm`.
    ///
    /// # Errors
    /// [`Error::Unsupported`] for a key that does not exist (naming the nearest one) or holds no number,
    /// [`Error::Range`] for a number that is not finite, or not whole where a count is wanted.
    pub fn with(&self, key: &str, value: f64) -> Result<Self, Error> {
        let mut file = self.clone();
        file.complete_for(key)?;
        let mut root = Value::Table(file.table()?);
        let entry = match entry(&mut root, key) {
            Ok(entry) => entry,
            // The key may be one that the file does not state.
            Err(unknown) => {
                let varied = with_optional(Value::Table(file.table()?), key, value);
                return varied.map(|varied| Self { mesh: file.mesh, ..varied }).ok_or(unknown);
            }
        };
        *entry = match entry {
            Value::Float(_) if value.is_finite() => Value::Float(value),
            // Exact: below 2^32 every whole f64 is an i64.
            #[expect(clippy::cast_possible_truncation, reason = "whole and below 2^32")]
            Value::Integer(_) if value.fract() == 0.0 && value.abs() < 4_294_967_296.0 => {
                Value::Integer(value as i64)
            }
            Value::Float(_) => return Err(Error::range(key, value, "finite")),
            Value::Integer(_) => return Err(Error::range(key, value, "a whole number")),
            _ => return Err(Error::Unsupported(format!("`{key}` holds no number"))),
        };
        let varied: Self = root.try_into().map_err(|error: toml::de::Error| Error::Syntax {
            what: format!("`{key}` = {value}"),
            reason: error.message().into(),
        })?;
        Ok(Self { mesh: file.mesh, ..varied })
    }

    /// The number at `key`, in the unit of the file; a default where the file does not state it.
    ///
    /// # Errors
    /// [`Error::Unsupported`] for a key that does not exist (naming the nearest one), holds no number, or holds a whole one.
    pub fn number(&self, key: &str) -> Result<f64, Error> {
        let mut file = self.clone();
        file.complete_for(key)?;
        let mut root = Value::Table(file.table()?);
        match entry(&mut root, key)? {
            Value::Float(number) => Ok(*number),
            Value::Integer(_) => Err(Error::Unsupported(format!("`{key}` is a whole number"))),
            _ => Err(Error::Unsupported(format!("`{key}` holds no number"))),
        }
    }

    pub(super) fn table(&self) -> Result<Table, Error> {
        Table::try_from(self).map_err(|error| unwritable(&error))
    }
}

fn unwritable(error: &toml::ser::Error) -> Error {
    Error::Syntax { what: "scene".into(), reason: error.to_string() }
}

/// The file with a number that it may hold but does not; `None` for any other key.
fn with_optional(mut root: Value, key: &str, value: f64) -> Option<SceneFile> {
    let (table, last) = key.rsplit_once('.')?;
    let Value::Table(table) = entry(&mut root, table).ok()? else { return None };
    if table.contains_key(last) || !value.is_finite() {
        return None;
    }
    table.insert(last.into(), Value::Float(value));
    root.try_into().ok()
}

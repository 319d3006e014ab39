//! Reading and writing scene text, with the place and reason of errors.

use std::ops::Range;

use toml::de::{DeTable, DeValue};
use toml::{Spanned, Table, Value};

use super::SceneFile;
use crate::error::Error;

/// Similarity (1: equal) below which no correction is suggested; lower values suggest nonsense.
const PLAUSIBLE: f64 = 0.5;

impl SceneFile {
    /// Reads a scene file's text; `what` names it in error messages.
    ///
    /// # Errors
    /// [`Error::Syntax`] with line and key, [`Error::Range`] for NaN or an infinity.
    pub fn parse(text: &str, what: &str) -> Result<Self, Error> {
        let mut file: Self = toml::from_str(text).map_err(|error| explain(text, what, &error))?;
        file.design.complete();
        refuse_infinite(&file.table()?, "")?;
        Ok(file)
    }

    /// The text of this file with every default written out.
    ///
    /// # Errors
    /// [`Error::Syntax`] for a number of segments beyond what TOML can write.
    pub fn to_toml(&self) -> Result<String, Error> {
        toml::to_string(self).map_err(|error| unwritable(&error))
    }

    /// The same file with the number at `key` replaced.
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
        let entry = entry(&mut root, key)?;
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
        root.try_into().map_err(|error: toml::de::Error| Error::Syntax {
            what: format!("`{key}` = {value}"),
            reason: error.message().into(),
        })
    }

    fn table(&self) -> Result<Table, Error> {
        Table::try_from(self).map_err(|error| unwritable(&error))
    }
}

fn unwritable(error: &toml::ser::Error) -> Error {
    Error::Syntax { what: "scene".into(), reason: error.to_string() }
}

/// The error with its line and the full path of the key.
fn explain(text: &str, what: &str, error: &toml::de::Error) -> Error {
    let span = error.span().unwrap_or(0..0);
    let line = text.get(..span.start).unwrap_or(text).matches('\n').count() + 1;
    let path = DeTable::parse(text).ok().and_then(|root| path_in_table(root.get_ref(), &span, ""));
    let message = error.message().trim_end();
    // serde writes the key in backquotes, then the known keys.
    let reason = match (message.strip_prefix("unknown field `"), path) {
        (Some(rest), path) => {
            let mut quoted = rest.split('`').step_by(2);
            let key = quoted.next().unwrap_or_default();
            let path = path.unwrap_or_else(|| key.into());
            let known: Vec<&str> = rest.split('`').skip(2).step_by(2).collect();
            format!("unknown key `{path}`{}", suggestion(key, &known))
        }
        (None, Some(path)) => format!("`{path}`: {message}"),
        (None, None) => message.replace('\n', ", "),
    };
    Error::Syntax { what: format!("{what}, line {line}"), reason }
}

/// Suggests the nearest of the known keys, or lists all of them when none is near.
fn suggestion(key: &str, known: &[&str]) -> String {
    let similarity = |other: &str| strsim::normalized_damerau_levenshtein(key, other);
    let nearest = known.iter().max_by(|a, b| similarity(a).total_cmp(&similarity(b)));
    match nearest {
        Some(nearest) if similarity(nearest) >= PLAUSIBLE => format!("; did you mean `{nearest}`?"),
        Some(_) => format!("; known here: {}", known.join(", ")),
        None => String::new(),
    }
}

/// Path of the key or value at `span`; the innermost value that contains it when there is no exact match.
fn path_in_table(table: &DeTable<'_>, span: &Range<usize>, prefix: &str) -> Option<String> {
    table.iter().find_map(|(key, value)| {
        let path =
            if prefix.is_empty() { key.get_ref().to_string() } else { format!("{prefix}.{}", key.get_ref()) };
        if key.span() == *span { Some(path) } else { path_in_value(value, span, &path) }
    })
}

fn path_in_value(value: &Spanned<DeValue<'_>>, span: &Range<usize>, path: &str) -> Option<String> {
    let inner = match value.get_ref() {
        DeValue::Table(table) => path_in_table(table, span, path),
        DeValue::Array(entries) => entries
            .iter()
            .enumerate()
            .find_map(|(index, entry)| path_in_value(entry, span, &format!("{path}[{}]", index + 1))),
        _ => None,
    };
    inner.or_else(|| (value.span() == *span).then(|| path.to_string()))
}

fn refuse_infinite(table: &Table, prefix: &str) -> Result<(), Error> {
    for (key, value) in table {
        let path = if prefix.is_empty() { key.clone() } else { format!("{prefix}.{key}") };
        refuse_infinite_value(value, &path)?;
    }
    Ok(())
}

fn refuse_infinite_value(value: &Value, path: &str) -> Result<(), Error> {
    match value {
        Value::Float(number) if !number.is_finite() => Err(Error::range(path, *number, "finite")),
        Value::Table(table) => refuse_infinite(table, path),
        Value::Array(entries) => entries
            .iter()
            .enumerate()
            .try_for_each(|(index, entry)| refuse_infinite_value(entry, &format!("{path}[{}]", index + 1))),
        _ => Ok(()),
    }
}

/// The entry at `path`, such as `magnet.cylinders[1].radius_mm`.
fn entry<'a>(root: &'a mut Value, path: &str) -> Result<&'a mut Value, Error> {
    let mut here = root;
    for part in path.split('.') {
        let (key, indices) = part.split_once('[').map_or((part, None), |(key, rest)| (key, Some(rest)));
        let Value::Table(table) = here else {
            return Err(Error::Unsupported(format!("unknown key `{path}`: `{key}` is not in a table")));
        };
        if !table.contains_key(key) {
            let known: Vec<&str> = table.keys().map(String::as_str).collect();
            return Err(Error::Unsupported(format!("unknown key `{path}`{}", suggestion(key, &known))));
        }
        here = &mut table[key];
        if let Some(rest) = indices {
            here = indexed(here, rest, path)?;
        }
    }
    Ok(here)
}

/// The entry of an array at `1]` or `1][3]`.
fn indexed<'a>(array: &'a mut Value, indices: &str, path: &str) -> Result<&'a mut Value, Error> {
    let mut here = array;
    for index in indices.split('[') {
        let count = here.as_array().map_or(0, Vec::len);
        let number: Option<usize> = index.strip_suffix(']').and_then(|digits| digits.parse().ok());
        here = match (here, number) {
            (Value::Array(entries), Some(number)) if (1..=entries.len()).contains(&number) => {
                &mut entries[number - 1]
            }
            _ => {
                return Err(Error::Unsupported(format!(
                    "no entry `{path}`: indices go from 1 to {count} there"
                )));
            }
        };
    }
    Ok(here)
}

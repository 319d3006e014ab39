//! Entries of a scene file by their path, such as `magnet.cylinders[1].radius_mm`.

use toml::Value;

use super::SceneFile;
use crate::error::Error;

/// Similarity (1: equal) below which no correction is suggested; lower values suggest nonsense.
const PLAUSIBLE: f64 = 0.5;

/// Tables that are missing where there is no such part.
const OPTIONAL: [&str; 3] = ["magnet", "coil", "design.backbone"];

/// Suggests the nearest of the known keys, or lists all of them when none is near.
pub(super) fn suggestion(key: &str, known: &[&str]) -> String {
    let similarity = |other: &str| strsim::normalized_damerau_levenshtein(key, other);
    let nearest = known.iter().max_by(|a, b| similarity(a).total_cmp(&similarity(b)));
    match nearest {
        Some(nearest) if similarity(nearest) >= PLAUSIBLE => format!("; did you mean `{nearest}`?"),
        Some(_) => format!("; known here: {}", known.join(", ")),
        None => String::new(),
    }
}

/// The entry at `path`, such as `magnet.cylinders[1].radius_mm`; of several magnets, `magnet` alone names the first one.
pub(super) fn entry<'a>(root: &'a mut Value, path: &str) -> Result<&'a mut Value, Error> {
    let first = path.strip_prefix("magnet.").filter(|_| root.get("magnet").is_some_and(Value::is_array));
    let of_first = first.map(|rest| format!("magnet[1].{rest}"));
    let path = of_first.as_deref().unwrap_or(path);

    let mut here = root;
    for part in path.split('.') {
        let (key, indices) = part.split_once('[').map_or((part, None), |(key, rest)| (key, Some(rest)));
        let Value::Table(table) = here else {
            return Err(Error::Unsupported(format!("unknown key `{path}`: `{key}` is not in a table")));
        };

        if !table.contains_key(key) {
            if let Some(optional) = OPTIONAL
                .iter()
                .find(|table| path.strip_prefix(**table).is_some_and(|rest| rest.starts_with('.')))
            {
                return Err(Error::Unsupported(format!(
                    "no key `{path}`: this scene has no table [{optional}]"
                )));
            }
            let known: Vec<&str> = match table.get("kind").and_then(Value::as_str) {
                Some(kind) => SceneFile::keys_of_device(kind),
                None => table.keys().map(String::as_str).collect(),
            };
            return Err(Error::Unsupported(format!("unknown key `{path}`{}", suggestion(key, &known))));
        }

        here = &mut table[key];
        if let Some(rest) = indices {
            here = indexed(here, rest, path)?;
        }
    }
    Ok(here)
}

/// Paths and values of all numbers that are not whole.
pub(super) fn numbers(value: &Value, path: &str) -> Vec<(String, f64)> {
    match value {
        Value::Float(number) => vec![(path.to_owned(), *number)],
        Value::Table(table) => {
            let inside = |key: &String| if path.is_empty() { key.clone() } else { format!("{path}.{key}") };
            table.iter().flat_map(|(key, value)| numbers(value, &inside(key))).collect()
        }
        Value::Array(array) => {
            let numbered = array.iter().enumerate();
            numbered.flat_map(|(index, value)| numbers(value, &format!("{path}[{}]", index + 1))).collect()
        }
        _ => Vec::new(),
    }
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

//! The scene of `mcm init`: a template of its keys, with the defaults and descriptions of the scene's schema.

use std::collections::BTreeSet;

use mcm::manipulator::SceneFile;
use serde_json::Value;

use crate::failure::Failure;

/// Column at which remarks begin.
const COLUMN: usize = 33;

/// The template with the value of every key that it states without one, and a remark on every table and key where it stands first.
pub(super) fn completed(template: &str) -> Result<String, Failure> {
    let schema: Value = serde_json::from_str(SceneFile::SCHEMA)
        .map_err(|error| Failure(format!("the schema of scenes: {error}")))?;
    let mut table = String::new();
    let mut told = BTreeSet::new();
    let mut out = String::new();

    for line in template.lines() {
        let start = if line.starts_with('#') { line.find(' ').map_or(0, |space| space + 1) } else { 0 };
        let (mark, rest) = line.split_at(start);
        let (key, value) = rest.split_once(" = ").map_or((rest, None), |(key, value)| (key, Some(value)));

        let path = match key.strip_prefix('[') {
            Some(header) => {
                header.trim_matches(['[', ']']).clone_into(&mut table);
                table.clone()
            }
            None => format!("{table}.{key}"),
        };

        let Some(entry) = Entry::at(&schema, &path) else {
            out += line;
            out.push('\n');
            continue;
        };

        let stated = match value {
            None if key == rest && !key.starts_with('[') => format!("{mark}{key} = {}", entry.default()?),
            _ => line.to_owned(),
        };

        if told.insert(path) {
            out += &entry.remarked(&stated, if mark.is_empty() { "" } else { "#" });
        } else {
            out += &stated;
            out.push('\n');
        }
    }
    Ok(out)
}

/// What the schema says of a table or a key.
struct Entry<'a> {
    node: &'a Value,
    required: bool,
}

impl<'a> Entry<'a> {
    fn at(root: &'a Value, path: &str) -> Option<Self> {
        path.split('.')
            .try_fold(Self { node: root, required: false }, |here, key| Self::inside(here.node, key))
    }

    /// The entry of a table, or of each of a list of tables.
    fn inside(node: &'a Value, key: &str) -> Option<Self> {
        if let Some(inside) = node["properties"].get(key) {
            let required = node["required"].as_array().is_some_and(|keys| keys.iter().any(|own| own == key));
            return Some(Self { node: inside, required });
        }
        let alternatives = node["anyOf"].as_array().into_iter().flatten();
        alternatives.chain(node.get("items")).find_map(|one| Self::inside(one, key))
    }

    fn default(&self) -> Result<String, Failure> {
        self.node.get("default").map(toml).ok_or_else(|| Failure(format!("no default in {}", self.node)))
    }

    /// The line with its remark, and what each of the values of a choice means in lines of their own, each after `begin`.
    fn remarked(&self, line: &str, begin: &str) -> String {
        let short = first_sentences(&self.node["description"]);
        let none = if self.required { "; no default" } else { "" };
        let mut out = aside(line, &format!("{short}{none}"));
        for choice in self.node["oneOf"].as_array().into_iter().flatten() {
            let meaning = first_sentences(&choice["description"]);
            out += &aside(begin, &format!("  {}: {meaning}", choice["const"]));
        }
        if let Some(names) = self.node["enum"].as_array() {
            let names: Vec<&str> = names.iter().filter_map(Value::as_str).collect();
            out += &aside(begin, &format!("  {}", names.join(", ")));
        }
        out
    }
}

/// A line with something beside it.
fn aside(line: &str, remark: &str) -> String {
    let gap = if line.len() < COLUMN { COLUMN } else { line.len() + 3 };
    format!("{line:gap$}# {remark}\n")
}

/// The first paragraph of a description, as plain text.
fn first_sentences(description: &Value) -> String {
    let all = description.as_str().unwrap_or_default();
    all.split("\n\n").next().unwrap_or_default().trim_end_matches('.').replace('`', "").replace('\n', " ")
}

/// A value as TOML has it.
fn toml(value: &Value) -> String {
    match value {
        Value::Array(entries) => format!("[{}]", entries.iter().map(toml).collect::<Vec<_>>().join(", ")),
        other => other.to_string(),
    }
}

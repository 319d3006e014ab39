//! The tables of the scene's reference: every table and key in the order of `mcm init`, from the schema of scenes.

use core::ops::Bound;
use std::fmt::Write;

use mcm::error::Interval;
use mcm::manipulator::SceneFile;
use serde_json::Value;

use super::{folder, mcm, stdout};

const PAGE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/src/manipulator/scene/README.md");

/// Around what is written into the page.
const BEGIN: &str = "<!-- made by: MCM_WRITE=1 cargo test --release --test mcm reference -->\n";
const END: &str = "<!-- end of what is made -->\n";

/// Units by the end of a key, the longest first.
const UNITS: [(&str, &str); 11] = [
    ("_t_per_m", "T/m"),
    ("_kg_m3", "kg/m³"),
    ("_m_s2", "m/s²"),
    ("_deg", "deg"),
    ("_mpa", "MPa"),
    ("_mm", "mm"),
    ("_mt", "mT"),
    ("_nm", "N m"),
    ("_t", "T"),
    ("_n", "N"),
    ("_s", "s"),
];

fn unit(key: &str) -> &'static str {
    match key {
        "current_a" => "A",
        _ => UNITS.iter().find(|(end, _)| key.ends_with(end)).map_or("", |(_, unit)| unit),
    }
}

/// The node of an entry of a table, or of each of a list of tables, and whether it must be there.
fn inside<'a>(node: &'a Value, key: &str) -> Option<(&'a Value, bool)> {
    if let Some(inside) = node["properties"].get(key) {
        return Some((
            inside,
            node["required"].as_array().is_some_and(|keys| keys.iter().any(|own| own == key)),
        ));
    }
    let alternatives = node["anyOf"].as_array().into_iter().flatten();
    alternatives.chain(node.get("items")).find_map(|one| inside(one, key))
}

fn table<'a>(root: &'a Value, path: &str) -> &'a Value {
    path.split('.').fold(root, |node, key| inside(node, key).unwrap_or_else(|| panic!("no table {path}")).0)
}

/// Tables and their keys, in the order of the scene that `mcm init` prints.
fn tables(printed: &str) -> Vec<(String, Vec<String>)> {
    let mut tables: Vec<(String, Vec<String>)> = Vec::new();
    for line in printed.lines() {
        let line = line.trim_start_matches("#|").trim_start_matches('#').trim_start();
        if let Some((header, _)) = line.strip_prefix('[').and_then(|rest| rest.split_once(']')) {
            tables.push((header.trim_start_matches('[').into(), Vec::new()));
        } else if let (Some((key, _)), Some((_, keys))) = (line.split_once(" = "), tables.last_mut())
            && key.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
        {
            keys.push(key.into());
        }
    }
    tables
}

fn toml(value: &Value) -> String {
    match value {
        Value::Array(entries) => format!("[{}]", entries.iter().map(toml).collect::<Vec<_>>().join(", ")),
        other => other.to_string(),
    }
}

/// The interval that a schema states.
fn interval(node: &Value) -> Interval {
    let bound = |including: &str, excluding: &str| match (node[including].as_f64(), node[excluding].as_f64())
    {
        (Some(limit), _) => Bound::Included(limit),
        (None, Some(limit)) => Bound::Excluded(limit),
        (None, None) => Bound::Unbounded,
    };
    Interval {
        low: bound("minimum", "exclusiveMinimum"),
        high: bound("maximum", "exclusiveMaximum"),
        other: Bound::Unbounded,
    }
}

/// What values a key may have, in words.
fn allowed(node: &Value) -> String {
    if let Some(alternatives) = node["anyOf"].as_array() {
        return alternatives.iter().map(allowed).collect::<Vec<_>>().join(", or ");
    }
    if let Some(choices) = node["oneOf"].as_array() {
        return choices.iter().map(|one| format!("`{}`", one["const"])).collect::<Vec<_>>().join(", ");
    }
    if let Some(names) = node["enum"].as_array() {
        return names.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ");
    }
    match node["type"].as_str().unwrap() {
        "boolean" => "`true`, `false`".into(),
        "string" => "text".into(),
        "array" => {
            let count = match (node["minItems"].as_u64(), node["maxItems"].as_u64()) {
                (Some(least), Some(most)) if least == most => format!("{least} entries"),
                (Some(least), Some(most)) => format!("list of {least} to {most}"),
                (Some(least), None) => format!("list of at least {least}"),
                _ => "list".into(),
            };
            match allowed(&node["items"]).as_str() {
                "any number" => count,
                each => format!("{count}, each {each}"),
            }
        }
        kind => {
            let range = interval(node);
            let mut words = if range == Interval::FINITE { String::new() } else { range.to_string() };
            if kind == "integer" {
                words = format!("whole, {words}");
            }
            if let Some(other) = node["$comment"].as_str() {
                words = format!("{words}, {other}");
            }
            if words.is_empty() { "any number".into() } else { words }
        }
    }
}

/// A row of the table of a key.
fn row(key: &str, node: &Value, required: bool) -> String {
    let default = match node.get("default") {
        Some(value) => format!("`{}`", toml(value)),
        None if required => "must be given".into(),
        None => String::new(),
    };
    let mut meaning =
        node["description"].as_str().unwrap_or_else(|| panic!("no description of {key}")).to_owned();
    for choice in node["oneOf"].as_array().into_iter().flatten() {
        let own = choice["description"].as_str().unwrap_or_else(|| panic!("{choice} without description"));
        write!(meaning, "<br>`{}`: {own}", choice["const"].as_str().unwrap()).unwrap();
    }
    let cells = [format!("`{key}`"), unit(key).into(), default, allowed(node), meaning];
    let cells = cells.map(|cell| cell.replace("\n\n", "<br>").replace('\n', " ").replace('|', "\\|"));
    format!("| {} |\n", cells.join(" | "))
}

/// All tables as Markdown.
fn markdown(root: &Value, printed: &str) -> String {
    let mut out = String::new();
    let mut told: Vec<String> = Vec::new();
    for (name, keys) in tables(printed) {
        let node = table(root, &name);
        let again = told.contains(&format!("{name}."));
        told.push(format!("{name}."));
        let rows: String = keys
            .iter()
            .filter_map(|key| {
                let (own, required) = inside(node, key)?;
                let path = format!("{name}.{key}");
                let new = !told.contains(&path);
                told.push(path);
                new.then(|| row(key, own, required))
            })
            .collect();
        let listed = node["type"] == "array" && node["items"]["type"] == "object";
        let brackets = if listed { ["[[", "]]"] } else { ["[", "]"] };
        if again && rows.is_empty() {
            continue;
        }
        if again {
            writeln!(out, "\n### `{}{name}{}` of a rod\n", brackets[0], brackets[1]).unwrap();
            out += "These keys belong to `kind = \"cylinder\"`, those above to `kind = \"segments\"`.\n";
        } else {
            writeln!(out, "\n### `{}{name}{}`\n", brackets[0], brackets[1]).unwrap();
            out += node["description"].as_str().unwrap_or_else(|| panic!("no description of {name}"));
            out += "\n";
        }
        match (node["minItems"].as_u64().filter(|_| listed), node["maxItems"].as_u64().filter(|_| listed)) {
            (Some(0), Some(most)) => writeln!(out, "\nAt most {most}.").unwrap(),
            (Some(least), Some(most)) => writeln!(out, "\nFrom {least} to {most}.").unwrap(),
            _ => {}
        }
        let inside = [&node["additionalProperties"], &node["items"]["additionalProperties"]];
        if let Some(each) = inside.into_iter().find(|each| each.is_object()) {
            writeln!(out, "\nAllowed: {}.", allowed(each)).unwrap();
        } else {
            out += "\n| key | unit | default | allowed | meaning |\n| --- | --- | --- | --- | --- |\n";
            out += &rows;
        }
    }
    out
}

/// `MCM_WRITE=1 cargo test --release --test mcm reference` writes them anew.
#[test]
fn reference_is_that_of_the_code() {
    let root: Value = serde_json::from_str(SceneFile::SCHEMA).unwrap();
    let printed = stdout(&mcm(&folder("reference"), &["init"]));
    let made = markdown(&root, &printed);
    let page = std::fs::read_to_string(PAGE).unwrap();
    let (before, rest) = page.split_once(BEGIN).expect(BEGIN);
    let (kept, after) = rest.split_once(END).expect(END);
    if std::env::var_os("MCM_WRITE").is_some() {
        std::fs::write(PAGE, format!("{before}{BEGIN}{made}\n{END}{after}")).unwrap();
    } else {
        assert!(
            kept == format!("{made}\n"),
            "{PAGE} differs: MCM_WRITE=1 cargo test --release --test mcm reference"
        );
    }
}

/// Paths of all keys of a schema.
fn keys(node: &Value, path: &str, out: &mut Vec<String>) {
    for (key, value) in node["properties"].as_object().into_iter().flatten() {
        let path = if path.is_empty() { key.clone() } else { format!("{path}.{key}") };
        keys(value, &path, out);
        out.push(path);
    }
    for alternative in node["anyOf"].as_array().into_iter().flatten().chain(node.get("items")) {
        keys(alternative, path, out);
    }
}

#[test]
fn every_key_of_the_schema_has_a_description_and_is_shown() {
    let root: Value = serde_json::from_str(SceneFile::SCHEMA).unwrap();
    let mut all = Vec::new();
    keys(&root, "", &mut all);
    assert!(all.len() > 80, "only {} keys", all.len());
    let printed = tables(&stdout(&mcm(&folder("reference_keys"), &["init"])));
    let shown: Vec<String> = printed
        .iter()
        .flat_map(|(table, keys)| keys.iter().map(move |key| format!("{table}.{key}")).chain([table.clone()]))
        .collect();
    for key in &all {
        assert!(shown.contains(key), "mcm init does not show {key}");
        assert!(table(&root, key)["description"].is_string(), "no description of {key}");
    }
}

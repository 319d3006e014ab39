//! The JSON schema of a scene, `schema.json`: types, descriptions and defaults from the structures that read a scene, ranges from the
//! constants that check it.
#![allow(clippy::expect_used, reason = "a test that meets something unexpected must stop")]

use core::ops::Bound::{Excluded, Included, Unbounded};
use std::borrow::Cow;

use schemars::generate::SchemaSettings;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde_json::{Value, json};

use super::device::DesignKey;
use super::file::DesignEntries;
use super::numbers::Numbers;
use super::sources::{MagnetEntries, Magnets};
use super::{SceneFile, magnet_shape, names, ranges};
use crate::design::MOST_SECTIONS;
use crate::error::Interval;
use crate::magnetics::{Cylinders, MultipoleTable, Sources};

impl JsonSchema for Magnets {
    fn schema_name() -> Cow<'static, str> {
        "Magnets".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let one = generator.subschema_for::<MagnetEntries>();
        json_schema!({ "anyOf": [one, { "type": "array", "items": one }] })
    }
}

impl JsonSchema for Numbers {
    fn schema_name() -> Cow<'static, str> {
        "Numbers".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "anyOf": [{ "type": "number" }, { "type": "array", "items": { "type": "number" } }] })
    }
}

/// Keys whose list has a smallest and a largest number of entries.
const COUNTS: [(&str, usize, Option<usize>); 7] = [
    ("design.section", 0, Some(MOST_SECTIONS)),
    ("design.group.sections", 1, None),
    ("magnet", 0, Some(Sources::MOST)),
    ("magnet.cylinders", 1, Some(Cylinders::MOST)),
    ("coil", 0, Some(Sources::MOST - 1)),
    ("coil.multipoles", 1, Some(MultipoleTable::MOST_DEGREES)),
    ("vessel.branch.points_mm", 2, None),
];

/// The schema, draft 7, which editors understand.
pub(super) fn schema() -> Value {
    let settings = SchemaSettings::draft07().with(|settings| settings.inline_subschemas = true);
    let mut root = settings.into_generator().into_root_schema_for::<SceneFile>().to_value();
    tidy(&mut root);
    let mut file = SceneFile::default();
    file.complete();
    set_defaults(&mut root, &serde_json::to_value(&file).expect("a scene can be written"));
    for (key, range) in names::ranges().chain(ranges::KEYS) {
        set_range(&mut root, key, range);
    }
    for (key, least, most) in COUNTS {
        let set = visit(&mut root, &parts(key), &mut |node| {
            // Not that of an entry which is a list itself.
            if node["type"] == "array" && node.get("minItems").is_none() {
                node["minItems"] = json!(least);
                if let Some(most) = most {
                    node["maxItems"] = json!(most);
                }
            }
        });
        assert!(set > 0, "no list {key}");
    }
    for (key, kind, conditions) in conditions() {
        let set = visit(&mut root, &parts(key), &mut |node| {
            if node["type"] == kind {
                node["allOf"] = conditions.clone();
            }
        });
        assert!(set > 0, "no table {key}");
    }
    root["title"] = json!("Scene of mcm");
    root["description"] =
        json!("The device, what acts on it and how it is computed. Units are in the names of the keys.");
    root
}

/// What one key says of others: the table or list, whether it is one or the other, and what holds there.
fn conditions() -> Vec<(&'static str, &'static str, Value)> {
    let none_of =
        |keys: &[DesignKey]| keys.iter().map(|(key, _)| ((*key).to_owned(), json!(false))).collect::<Value>();
    let has = |key: &str, value: Value| json!({ "properties": { key: value }, "required": [key] });
    let one_stiffness =
        json!([{ "oneOf": [{ "required": ["shore_a"] }, { "required": ["elastic_modulus_mpa"] }] }]);
    let bulk = ["elastic_modulus_mpa", "remanence_t"];
    let pushed = has("mode", json!({ "enum": ["insertion", "force"] }));
    let pushed_without_shaft = json!({ "allOf": [pushed, { "not": { "required": ["shaft"] } }] });

    vec![
        (
            "",
            "object",
            json!([{ "if": has("feed", pushed_without_shaft), "then": has("design", json!({ "required": ["backbone"] })) }]),
        ),
        (
            "design",
            "object",
            json!([
                {
                    "if": has("kind", json!({ "const": "cylinder" })),
                    "then": { "required": ["length_mm", "radius_mm"] },
                    "else": { "properties": none_of(&DesignEntries::OF_CYLINDER) },
                },
                {
                    "if": has("kind", json!({ "const": "sections" })),
                    "then": { "required": ["section"] },
                    "else": { "properties": none_of(&DesignEntries::OF_SECTIONS) },
                },
                {
                    "if": has("kind", json!({ "enum": ["cylinder", "sections"] })),
                    "then": { "properties": none_of(&DesignEntries::OF_SEGMENTS) },
                },
                {
                    "if": { "anyOf": bulk.map(|key| json!({ "required": [key] })) },
                    "then": { "required": bulk, "properties": none_of(&DesignEntries::OF_COMPOSITE) },
                },
            ]),
        ),
        ("design.section", "object", of_section()),
        ("design.backbone", "object", one_stiffness.clone()),
        ("feed.shaft", "object", one_stiffness),
        ("magnet", "object", json!(magnet_shape::conditions())),
        ("magnet", "array", json!([{ "items": [{}], "additionalItems": { "required": ["position_mm"] } }])),
        (
            "feed",
            "object",
            json!([
                { "if": has("mode", json!({ "const": "force" })), "else": { "properties": { "force_n": { "const": 0 } } } },
                { "if": pushed, "else": { "properties": { "shaft": false, "insertion_mm": { "const": 0 } } } },
            ]),
        ),
        (
            "coil",
            "object",
            json!([
                { "not": { "required": ["multipoles", "multipoles_csv"] } },
                {
                    "if": { "required": ["reach_mm"] },
                    "then": { "anyOf": [{ "required": ["multipoles"] }, { "required": ["multipoles_csv"] }] },
                },
            ]),
        ),
        (
            "vessel",
            "object",
            json!([{
                "if": { "required": ["mesh_stl"] },
                "then": { "properties": { "branch": { "maxItems": 0 } } },
                "else": has("branch", json!({ "minItems": 1 })),
            }]),
        ),
    ]
}

/// Which keys of a section exclude or need one another.
fn of_section() -> Value {
    let required = |key: &&str| json!({ "required": [key] });
    let none_of = |keys: &[&str]| keys.iter().map(|key| ((*key).to_owned(), json!(false))).collect::<Value>();
    let stiffness = ["shore_a", "elastic_modulus_mpa", "bending_stiffness_n_m2"];
    let measured = ["torsional_stiffness_n_m2", "axial_stiffness_n", "shear_stiffness_n"];
    let has =
        |key: &str, value: Value| json!({ "properties": { key: { "const": value } }, "required": [key] });
    let rigid = json!({ "anyOf": [has("rigid", json!(true)), has("shape", json!("ball"))] });
    let elastic: Vec<Value> = stiffness.iter().map(required).collect();
    let all = [&stiffness[..], &measured[..], &["poisson"]].concat();
    json!([
        { "if": rigid, "then": { "properties": none_of(&all) }, "else": { "oneOf": elastic } },
        {
            "if": { "required": ["bending_stiffness_n_m2"] },
            "then": { "required": measured[..2], "properties": none_of(&["poisson"]) },
            "else": { "properties": none_of(&measured) },
        },
        { "if": { "required": ["particle_remanence_t"] }, "then": { "required": ["volume_fraction"] } },
        { "not": { "required": ["remanence_t", "volume_fraction"] } },
        { "if": has("shape", json!("ball")), "else": { "required": ["length_mm"] } },
    ])
}

fn parts(key: &str) -> Vec<String> {
    key.split('.').filter(|part| !part.is_empty()).map(|part| part.replace("[*]", "")).collect()
}

/// Does something with every alternative and every entry of the key; how many these were.
fn visit(node: &mut Value, key: &[String], act: &mut impl FnMut(&mut Value)) -> usize {
    let mut met = 0;
    if key.is_empty() {
        act(node);
        met += 1;
    }
    for alternative in node.get_mut("anyOf").and_then(Value::as_array_mut).into_iter().flatten() {
        met += visit(alternative, key, act);
    }
    if let Some(each) = node.get_mut("items") {
        met += visit(each, key, act);
    }
    let Some((first, rest)) = key.split_first() else { return met };
    let inside = if first == "*" {
        node.get_mut("additionalProperties")
    } else {
        node.get_mut("properties").and_then(|keys| keys.get_mut(first))
    };
    met + inside.map_or(0, |inside| visit(inside, rest, act))
}

/// A limit without what the change of its unit left in its last digits.
fn unrounded(limit: f64) -> f64 {
    let short: f64 = format!("{limit:.12e}").parse().expect("a number");
    if (short - limit).abs() <= 4.0 * f64::EPSILON * limit.abs() { short } else { limit }
}

/// States the range of a key.
fn set_range(root: &mut Value, key: &str, range: Interval) {
    let mut set = 0;
    visit(root, &parts(key), &mut |node| {
        if node["type"] != "number" && node["type"] != "integer" {
            return;
        }
        for (bound, including, excluding) in
            [(range.low, "minimum", "exclusiveMinimum"), (range.high, "maximum", "exclusiveMaximum")]
        {
            match bound {
                Included(limit) => node[including] = json!(unrounded(limit)),
                Excluded(limit) => node[excluding] = json!(unrounded(limit)),
                Unbounded => {}
            }
        }
        if let Included(other) | Excluded(other) = range.other {
            let than = if matches!(range.other, Included(_)) { "not above" } else { "less than" };
            node["$comment"] = json!(format!("{than} {other}"));
        }
        set += 1;
    });
    assert!(set > 0, "no number {key}");
}

/// Adds the values of keys that are filled in where they are left out.
fn set_defaults(node: &mut Value, value: &Value) {
    match value {
        Value::Object(table) => {
            for (key, value) in table {
                set_defaults(&mut node["properties"][key], value);
            }
        }
        value => node["default"] = value.clone(),
    }
}

/// Takes out what TOML does not have, and what says nothing: null, formats of numbers, and defaults of tables.
fn tidy(node: &mut Value) {
    match node {
        Value::Object(map) => {
            map.remove("format");
            if map.get("default").is_some_and(Value::is_object) {
                map.remove("default");
            }

            if let Some(Value::Array(types)) = map.get("type")
                && let Some(own) = types.iter().find(|own| *own != "null").cloned()
            {
                map.insert("type".into(), own);
            }

            // An alternative beside null alone is no choice: its entries take the place of the list.
            if let Some(Value::Array(alternatives)) = map.get_mut("anyOf") {
                alternatives.retain(|own| own["type"] != "null");
                if let [only] = &alternatives[..] {
                    let only = only.clone();
                    map.remove("anyOf");
                    for (key, value) in only.as_object().into_iter().flatten() {
                        map.entry(key.clone()).or_insert_with(|| value.clone());
                    }
                }
            }

            map.values_mut().for_each(tidy);
        }
        Value::Array(list) => list.iter_mut().for_each(tidy),
        _ => {}
    }
}

const CHECKED_IN: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/src/manipulator/scene/schema.json");

/// `MCM_WRITE=1 cargo test --release --lib schema` writes it anew.
#[test]
fn checked_in_schema_is_that_of_the_code() {
    let written = serde_json::to_string_pretty(&schema()).expect("a schema can be written") + "\n";
    if std::env::var_os("MCM_WRITE").is_some() {
        std::fs::write(CHECKED_IN, &written).expect("the schema can be kept");
    }
    let kept = std::fs::read_to_string(CHECKED_IN).expect("the schema is there");
    assert!(written == kept, "{CHECKED_IN} differs: MCM_WRITE=1 cargo test --release --lib schema");
}

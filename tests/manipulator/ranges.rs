//! Every range that the schema of scenes states, at the door: just inside it is accepted, just outside refused.

use std::collections::BTreeMap;

use mcm::manipulator::SceneFile;
use serde_json::Value as Json;
use toml::{Table, Value};

/// Relative distance from a limit that is just inside or outside.
const JUST: f64 = 1e-6;

/// Tables that are in the scene while a key of theirs, or of tables inside, is tried; the first that fits counts.
const SURROUNDINGS: [(&str, &str); 25] = [
    ("design.section.shore_a", SOFT),
    ("design.section.bending_stiffness_n_m2", MEASURED),
    ("design.section.torsional_stiffness_n_m2", MEASURED),
    ("design.section.axial_stiffness_n", MEASURED),
    ("design.section.shear_stiffness_n", MEASURED),
    (
        "design.group.",
        "[design]\nkind = \"sections\"\n[[design.section]]\nname = \"a\"\nlength_mm = 4.0\nouter_radius_mm = 0.5\n\
         elastic_modulus_mpa = 2.0\n[[design.group]]\nsections = [\"a\"]",
    ),
    ("design.section.", SOFT),
    ("design.helix.", ""),
    ("design.ring.", ""),
    (
        "design.backbone.",
        "[design.backbone]\nouter_radius_mm = 0.5\ninner_radius_mm = 0.1\nshore_a = 40.0\npoisson = 0.45",
    ),
    ("design.segments", ""),
    ("design.spiral_start_deg", ""),
    ("design.", "[design]\nkind = \"cylinder\"\nlength_mm = 40.0\nradius_mm = 2.0"),
    (
        "feed.",
        "[feed]\nmode = \"insertion\"\n[feed.shaft]\nouter_radius_mm = 0.5\ninner_radius_mm = 0.1\nshore_a = 40.0\npoisson = 0.45",
    ),
    ("guidewire.", "[guidewire]\nradius_mm = 0.2\nelastic_modulus_mpa = 75000.0"),
    (
        "vessel.",
        "[vessel]\n[[vessel.branch]]\nname = \"tube\"\npoints_mm = [[0.0, 0.0, -30.0], [0.0, 0.0, 60.0]]\nradius_mm = 8.0",
    ),
    ("magnet.size_mm", CUBOID),
    ("magnet.direction", CUBOID),
    ("magnet.remanence_t", CUBOID),
    ("magnet.radius_mm", RING),
    ("magnet.inner_radius_mm", RING),
    ("magnet.length_mm", RING),
    (
        "magnet.",
        "[magnet]\n[[magnet.cylinders]]\nradius_mm = 20.0\ninner_radius_mm = 1.0\nlength_mm = 30.0\noffset_mm = 0.0\nremanence_t = 1.0",
    ),
    (
        "coil.reach_mm",
        "[[coil]]\nposition_mm = [0.0, 200.0, 0.0]\ninner_radius_mm = 20.0\nouter_radius_mm = 40.0\nlength_mm = 60.0\nturns = 100.0\nmultipoles = [1e-7]",
    ),
    (
        "coil.",
        "[[coil]]\nposition_mm = [0.0, 200.0, 0.0]\ninner_radius_mm = 20.0\nouter_radius_mm = 40.0\nlength_mm = 60.0\nturns = 100.0",
    ),
];

/// A device with one elastic section, and one whose stiffness is measured.
const SOFT: &str = "[design]\nkind = \"sections\"\n[[design.section]]\nlength_mm = 4.0\nouter_radius_mm = 0.5\nelastic_modulus_mpa = 2.0";
const MEASURED: &str = "[design]\nkind = \"sections\"\n[[design.section]]\nlength_mm = 4.0\nouter_radius_mm = 0.5\n\
    bending_stiffness_n_m2 = 1e-7\ntorsional_stiffness_n_m2 = 1e-7\naxial_stiffness_n = 1.0";

/// Magnets in one piece.
const CUBOID: &str = "[magnet]\nshape = \"cuboid\"\nsize_mm = [9.0, 9.0, 9.0]\nremanence_t = 1.0";
const RING: &str = "[magnet]\nshape = \"cylinder\"\nradius_mm = 9.0\ninner_radius_mm = 1.0\nlength_mm = 9.0\nremanence_t = 1.0";

/// A number of a scene: its schema, and whether it is the entry of a list.
struct Number<'a> {
    node: &'a Json,
    in_list: bool,
}

/// All numbers with a range, by their key; `*` is any key.
fn numbers<'a>(node: &'a Json, path: &str, in_list: bool, out: &mut BTreeMap<String, Number<'a>>) {
    let limits = ["minimum", "exclusiveMinimum", "maximum", "exclusiveMaximum"];
    if limits.iter().any(|limit| node.get(limit).is_some()) {
        out.entry(path.into()).or_insert(Number { node, in_list });
    }
    let below = |key: &str| if path.is_empty() { key.to_owned() } else { format!("{path}.{key}") };
    for (key, inside) in node["properties"].as_object().into_iter().flatten() {
        numbers(inside, &below(key), false, out);
    }
    for alternative in node["anyOf"].as_array().into_iter().flatten() {
        numbers(alternative, path, in_list, out);
    }
    if let Some(each) = node.get("items") {
        numbers(each, path, true, out);
    }
    if let Some(any) = node.get("additionalProperties").filter(|any| any.is_object()) {
        numbers(any, &below("*"), false, out);
    }
}

/// A scene with this number at this key, the one after the tables that it needs.
fn scene(path: &str, number: &Number<'_>, value: f64) -> String {
    let text = SURROUNDINGS.iter().find(|(start, _)| path.starts_with(start)).map_or("", |(_, text)| text);
    let mut root: Table = text.parse().unwrap();
    let (table, key) = path.rsplit_once('.').unwrap();
    let mut here = &mut root;
    for part in table.split('.') {
        let inside = here.entry(part).or_insert_with(|| Value::Table(Table::new()));
        here = match inside {
            Value::Array(tables) => tables[0].as_table_mut().unwrap(),
            other => other.as_table_mut().unwrap(),
        };
    }
    let value =
        if number.node["type"] == "integer" { Value::Integer(value as i64) } else { Value::Float(value) };
    let beside = match path {
        "magnet.direction" => vec![Value::Float(0.0); 2],
        "magnet.size_mm" => vec![Value::Float(9.0); 2],
        _ => Vec::new(),
    };
    let value = if number.in_list { Value::Array([vec![value], beside].concat()) } else { value };
    match path {
        "design.elastic_modulus_mpa" => drop(here.insert("remanence_t".into(), Value::Float(0.1))),
        "design.remanence_t" => drop(here.insert("elastic_modulus_mpa".into(), Value::Float(1.0))),
        "design.section.shore_a" => drop(here.remove("elastic_modulus_mpa")),
        "design.section.particle_remanence_t" => {
            drop(here.insert("volume_fraction".into(), Value::Float(0.1)));
        }
        _ if key == "elastic_modulus_mpa" => drop(here.remove("shore_a")),
        _ => {}
    }
    match path {
        "uncertainty.*" => drop(here.insert("design.helix.shore_a".into(), value)),
        "correlation.*" => {
            here.insert("design.helix.shore_a, design.helix.poisson".into(), value);
            let known = [("design.helix.shore_a", 1.0), ("design.helix.poisson", 0.01)];
            let known = known.map(|(key, deviation)| (key.to_owned(), Value::Float(deviation)));
            root.insert("uncertainty".into(), Value::Table(known.into_iter().collect()));
        }
        _ => drop(here.insert(key.into(), value)),
    }
    toml::to_string(&root).unwrap()
}

/// Whether the scene is refused because of this number.
fn is_refused(path: &str, number: &Number<'_>, value: f64) -> bool {
    let text = scene(path, number, value);
    let told = SceneFile::parse(&text, "probe").err().map_or_else(String::new, |error| error.to_string());
    // Other keys may be at fault then, but not this one.
    let own = told.contains(&format!(" = {value} is not allowed"));
    assert!(own || !told.contains("unknown key") && !told.contains("invalid type"), "{text}\n{told}");
    own
}

#[test]
fn every_stated_range_is_the_one_that_is_checked() {
    let root: Json = serde_json::from_str(SceneFile::SCHEMA).unwrap();
    let mut found = BTreeMap::new();
    numbers(&root, "", false, &mut found);
    assert!(found.len() > 55, "only {} ranges", found.len());
    for (path, number) in &found {
        for (limit, outwards) in
            [("minimum", -1.0), ("exclusiveMinimum", -1.0), ("maximum", 1.0), ("exclusiveMaximum", 1.0)]
        {
            let Some(at) = number.node[limit].as_f64() else { continue };
            let step = match (number.node["type"].as_str(), at) {
                (Some("integer"), _) => 1.0,
                (_, 0.0) => 2.0 * JUST,
                _ => at.abs() * JUST,
            };
            let (inside, outside) = if limit.starts_with("exclusive") {
                (at - outwards * step, at)
            } else {
                (at, at + outwards * step)
            };
            assert!(is_refused(path, number, outside), "{path} = {outside} is accepted");
            assert!(!is_refused(path, number, inside), "{path} = {inside} is refused");
        }
    }
}

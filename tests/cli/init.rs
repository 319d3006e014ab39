//! `mcm init`: the scene to begin with.

use mcm::manipulator::SceneFile;
use toml::{Table, Value};

use super::{assert_status, folder, mcm, stderr, stdout};

/// Largest number of characters of a line.
const WIDEST: usize = 140;

/// Paths of all keys that hold no table, those of all entries of a list of tables alike.
fn keys(value: &Value, path: &str, out: &mut Vec<String>) {
    match value {
        Value::Table(table) => {
            for (key, value) in table {
                keys(value, &if path.is_empty() { key.clone() } else { format!("{path}.{key}") }, out);
            }
        }
        Value::Array(list) if list.iter().any(Value::is_table) => {
            for entry in list {
                keys(entry, path, out);
            }
        }
        _ => out.push(path.into()),
    }
}

fn keys_of(text: &str) -> Vec<String> {
    let mut out = Vec::new();
    keys(&Value::Table(text.parse::<Table>().unwrap()), "", &mut out);
    out.sort();
    out.dedup();
    out
}

/// The scene with the tables and keys that are comments, except the rod's at its end.
fn all_keys_counting(text: &str) -> String {
    let (own, _) = text.split_once("# A plain magnetised rod").unwrap();
    let counts = |line: &str| line.starts_with("# [") || line.starts_with("# ") && line.contains(" = ");
    own.lines().map(|line| if counts(line) { &line[2..] } else { line }).collect::<Vec<_>>().join("\n")
}

#[test]
fn the_scene_to_begin_with_is_the_default_with_every_key() {
    let here = folder("init");
    let printed = stdout(&mcm(&here, &["init"]));
    let file = SceneFile::parse(&printed, "init").unwrap();
    assert_eq!(file, SceneFile::parse("", "empty").unwrap(), "what is shown are the defaults");
    // Every key of a scene that has every table, in what the file states and in what it comments.
    let whole = all_keys_counting(&printed).replace("segments = 9", "segments = 1");
    let shown = SceneFile::parse(&whole, "all keys").unwrap();
    let (told, known) = (keys_of(&whole), keys_of(&shown.to_toml().unwrap()));
    let missing: Vec<&String> = known.iter().filter(|key| !told.contains(key)).collect();
    assert!(missing.is_empty(), "not shown: {missing:?}");
    let table = |text: &str| SceneFile::parse(text, "magnet").unwrap().to_toml().unwrap();
    let magnet = |text: &str| table(text).parse::<Table>().unwrap()["magnet"]["cylinders"].clone();
    assert_eq!(magnet(&whole), magnet("[magnet]"), "an empty table is the magnet that is shown");
    let (_, rod) = printed.split_once("and none of those above:\n").unwrap();
    let (rod, sections) = rod.split_once("\n# Any tubes").unwrap();
    let (_, sections) = sections.split_once("and none of those above:\n").unwrap();
    let counting: Vec<&str> = sections.lines().filter_map(|line| line.strip_prefix("# ")).collect();
    let shown = SceneFile::parse(&counting.join("\n"), "sections").unwrap().to_toml().unwrap();
    let missing: Vec<String> = keys_of(&shown)
        .into_iter()
        .filter(|key| key.starts_with("design.") && key != "design.kind")
        .filter(|key| !sections.contains(key.rsplit('.').next().unwrap()))
        .collect();
    assert!(!shown.is_empty() && missing.is_empty(), "not shown: {missing:?}");
    let of_rubber: Vec<&str> = rod.lines().filter_map(|line| line.strip_prefix("# ")).collect();
    let other =
        |line: &&str| !["shore_a", "volume_", "particle_"].iter().any(|key| line[2..].starts_with(key));
    let of_bulk: Vec<&str> = rod.lines().filter(other).map(|line| line[2..].trim_start()).collect();
    for (lines, key) in [(of_rubber, "volume_fraction"), (of_bulk, "remanence_t")] {
        assert!(lines.iter().any(|line| line.starts_with(key)), "{lines:?}");
        SceneFile::parse(&lines.join("\n"), "rod").unwrap();
    }
    assert_status(&mcm(&here, &["init", "--out", "scene.toml"]), 0);
    assert_eq!(std::fs::read_to_string(here.join("scene.toml")).unwrap(), printed);
    let again = mcm(&here, &["init", "--out", "scene.toml"]);
    assert_status(&again, 1);
    assert!(stderr(&again).contains("scene.toml exists already"));
}

#[test]
fn a_scene_in_an_aorta_can_be_solved() {
    let here = folder("init_vessel");
    for name in ["aorta", "aorta-spatial"] {
        let file = format!("{name}.toml");
        assert_status(&mcm(&here, &["init", "--vessel", name, "--out", &file]), 0);
        let scene = SceneFile::parse(&std::fs::read_to_string(here.join(&file)).unwrap(), name).unwrap();
        let scene = scene.scene().unwrap();
        assert!(
            scene.vessel.is_some_and(|vessel| vessel.lumen.branches().len() > 5) && scene.shaft.is_some()
        );
    }
    let solved = mcm(&here, &["solve", "aorta.toml", "--json"]);
    let answer: serde_json::Value = serde_json::from_str(&stdout(&solved)).unwrap();
    assert_eq!(answer["feed_length_m"], 0.0);
    assert!(answer["contact_count"].is_number() && answer["largest_indentation_m"].as_f64().unwrap() < 1e-3);
}

#[test]
fn every_design_to_begin_with_bends() {
    let here = folder("init_design");
    for name in ["tip-magnet", "two-magnets", "magnetic-tip", "j-tip", "tentacle", "paper"] {
        let file = format!("{name}.toml");
        assert_status(&mcm(&here, &["init", "--design", name, "--out", &file]), 0);
        let solved = mcm(&here, &["solve", &file, "--json"]);
        assert_status(&solved, 0);
        let answer: serde_json::Value = serde_json::from_str(&stdout(&solved)).unwrap();
        // The tip of a device that bends to an S points along the axis again.
        let tip: [f64; 3] = serde_json::from_value(answer["tip_position_m"].clone()).unwrap();
        assert!(tip[0].hypot(tip[1]) > 0.1 * tip[2], "{name}: {tip:?}");
    }
    assert_status(&mcm(&here, &["init", "--design", "octopus"]), 1);
}

#[test]
fn every_line_of_the_scene_to_begin_with_says_what_it_is() {
    let printed = stdout(&mcm(&folder("init_remarks"), &["init"]));
    let mut told = Vec::new();
    let mut table = "";
    for line in printed.lines() {
        assert!(line.chars().count() <= WIDEST, "{line}");
        let bare = line.trim_start_matches("#|").trim_start_matches('#').trim_start();
        let key = bare.split(" = ").next().unwrap();
        let is_table = bare.starts_with('[');
        if is_table {
            table = key.split(' ').next().unwrap();
        }
        if is_table || bare.contains(" = ") && !key.starts_with('"') {
            let name = format!("{table} {}", if is_table { "" } else { key });
            assert!(bare.contains(" # ") || told.contains(&name), "no remark: {line}");
            told.push(name);
        }
    }
    assert!(told.len() > 100, "only {} lines with a key or a table", told.len());
}

#[test]
fn the_schema_is_written_for_editors() {
    let here = folder("init_schema");
    assert_status(&mcm(&here, &["init", "--schema", "--out", "scene.schema.json"]), 0);
    let text = std::fs::read_to_string(here.join("scene.schema.json")).unwrap();
    assert_eq!(text, SceneFile::SCHEMA);
    let schema: serde_json::Value = serde_json::from_str(&text).unwrap();
    assert_eq!(schema["properties"]["design"]["properties"]["segments"]["default"], 9);
    assert_status(&mcm(&here, &["init", "--schema", "--vessel", "aorta"]), 1);
}

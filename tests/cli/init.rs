//! `mcm init`: the scene to begin with.

use mcm::manipulator::SceneFile;
use toml::{Table, Value};

use super::{assert_status, folder, mcm, stderr, stdout};

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
    let rod = printed.split_once("and none of those above:").unwrap().1;
    for material in ["shore_a", "elastic_modulus_mpa"] {
        let kept = |line: &&str| {
            material == "shore_a" && !line.starts_with("elastic") && !line.starts_with("remanence")
                || material != "shore_a" && !line.starts_with("shore_a")
        };
        let text: Vec<&str> = rod
            .lines()
            .map(|line| line.trim_start_matches("# ").split('#').next().unwrap())
            .filter(kept)
            .collect();
        SceneFile::parse(&format!("[design]\n{}", text.join("\n")), material).unwrap();
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

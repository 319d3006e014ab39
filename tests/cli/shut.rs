//! `mcm solve` of devices that their own rings pull shut: what it advises, and that the advice works.

use std::sync::atomic::{AtomicUsize, Ordering};

use serde_json::Value;

use super::{assert_status, stderr, stdout, with_scene};

/// A budget that no solve of these tests needs, so that a slow machine says the same.
const PATIENT: &str = "[model]\ntime_budget_s = 120.0\n";

/// What a message of such a device begins with, after how far it is bent.
const SHUT: &str = "unloaded, the rings pull this device shut (level full); ";

/// Advice for devices that stand.
const MISLEADING: [&str; 4] = ["keep them apart", "another way", "interaction none", "spirals"];

/// Five segments with rings of an outer diameter, bore and length (mm).
#[derive(Debug, Clone, Copy)]
struct Device {
    ring: [f64; 3],
    helix_mm: f64,
    wall_mm: f64,
    shore_a: f64,
}

impl Device {
    /// All combinations of five rings, three helices, two walls of the core and three materials.
    fn all() -> Vec<Self> {
        let rings = [[3.0, 1.0, 1.0], [4.0, 1.5, 1.0], [4.0, 1.5, 2.0], [5.0, 2.0, 1.5], [6.0, 2.0, 2.0]];
        let mut all = Vec::new();
        for ring in rings {
            for helix_mm in [3.0, 4.0, 6.0] {
                for wall_mm in [0.2, 0.4] {
                    all.extend([20.0, 30.0, 40.0].map(|shore_a| Self { ring, helix_mm, wall_mm, shore_a }));
                }
            }
        }
        all
    }

    /// The scene, with the tables after `[design]` and with `more` keys in that.
    fn scene(&self, more: &str) -> String {
        let Self { ring: [diameter, bore, length], helix_mm, wall_mm, shore_a } = *self;
        let [radius, inner] = [diameter, bore].map(|width| width / 2.0);
        let outer = inner + wall_mm;
        format!(
            "[design]\nsegments = 5\n{more}\n[design.helix]\nlength_mm = {helix_mm:?}\nradius_mm = {radius:?}\n\
             core_outer_radius_mm = {outer:?}\ncore_inner_radius_mm = {inner:?}\nshore_a = {shore_a:?}\n\
             [design.ring]\nlength_mm = {length:?}\nremanence_t = 1.35\n{PATIENT}"
        )
    }
}

/// Of rings 3 x 1 x 1 mm with soft, thin cores: ring 1 touches ring 6.
const CLOSING: Device = Device { ring: [3.0, 1.0, 1.0], helix_mm: 3.0, wall_mm: 0.2, shore_a: 20.0 };

/// What a solve said: exit status, JSON, and the lines of standard error that warn.
fn said(test: &str, scene: &str) -> (Option<i32>, Value, Vec<String>) {
    let (_, output) = with_scene(test, scene, &["solve", "scene.toml", "--json"]);
    let told = stderr(&output);
    let warnings = told.lines().filter(|line| line.starts_with("warning: ")).map(str::to_owned);
    (output.status.code(), serde_json::from_slice(&output.stdout).unwrap(), warnings.collect())
}

/// The tip angle (deg) of an answer; `None` without a shape.
fn bend(answer: &Value) -> Option<f64> {
    answer["alpha_rad"].as_f64().map(f64::to_degrees)
}

/// Key and value that a message says the device stands from.
fn advice(message: &str) -> Option<(&str, &str)> {
    let (key, rest) = message.split_once("; it stands from ")?.1.split_once(" = ")?;
    Some((key, rest.split_once(' ')?.0))
}

/// A scene with another value at a key of a table that has it.
fn changed(scene: &str, key: &str, value: &str) -> String {
    let (table, name) = key.rsplit_once('.').unwrap();
    let mut inside = false;
    let lines = scene.lines().map(|line| {
        inside = if line.starts_with('[') { line == format!("[{table}]") } else { inside };
        let here = inside && line.starts_with(&format!("{name} = "));
        if here { format!("{name} = {value}\n") } else { format!("{line}\n") }
    });
    let out: String = lines.collect();
    assert_ne!(out, scene, "no {key}");
    out
}

/// Whether a device does not stand; then the advice is applied, and it stands.
fn is_advised(number: usize, device: &Device) -> bool {
    let scene = device.scene("");
    let (status, answer, warnings) = said(&format!("shut {number}"), &scene);
    let Some(reason) = answer["reason"].as_str() else {
        assert_eq!(status, Some(0), "{device:?}");
        assert!(bend(&answer).unwrap() < 90.0 && warnings.is_empty(), "{device:?}: {answer:?}");
        return false;
    };

    assert!(reason.contains(SHUT), "{device:?}: {reason}");
    assert!(MISLEADING.iter().all(|word| !reason.contains(word)), "{device:?}: {reason}");
    assert!(warnings.iter().any(|line| line.ends_with(reason)), "{device:?}: {warnings:?}");
    assert_eq!(status, Some(if answer["converged"] == true { 0 } else { 2 }), "{device:?}");
    let (key, value) = advice(reason).unwrap_or_else(|| panic!("{device:?}: {reason}"));

    let (status, answer, warnings) = said(&format!("stands {number}"), &changed(&scene, key, value));
    let stands = status == Some(0) && bend(&answer).is_some_and(|bend| bend < 90.0);
    assert!(stands && warnings.is_empty(), "{device:?}, {key} = {value}: {answer:?}");
    true
}

#[test]
fn of_90_devices_those_that_close_stand_with_what_is_advised() {
    let devices = Device::all();
    assert_eq!(devices.len(), 90);
    let [next, advised] = [AtomicUsize::new(0), AtomicUsize::new(0)];
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    std::thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(|| {
                while let number = next.fetch_add(1, Ordering::Relaxed)
                    && let Some(device) = devices.get(number)
                {
                    advised.fetch_add(usize::from(is_advised(number, device)), Ordering::Relaxed);
                }
            });
        }
    });
    let advised = advised.into_inner();
    println!("{advised} of 90 devices are pulled shut");
    assert!(advised > 20, "{advised}");
}

#[test]
fn a_device_that_closes_is_explained_in_the_table_too() {
    let (_, output) = with_scene("shut table", &CLOSING.scene(""), &["solve", "scene.toml"]);
    assert_status(&output, 2);
    let (text, told) = (stdout(&output), stderr(&output));
    let start = format!("note: {SHUT}it stands from design.helix.shore_a = ");
    let notes: Vec<&str> = text.lines().filter(|line| line.starts_with("note: ")).collect();
    assert!(matches!(notes[..], [note] if note.starts_with(&start)), "{text}");
    assert!(text.starts_with("not converged;") && text.contains("interaction full"), "{text}");
    assert!(told.contains(&format!("warning: not converged: {SHUT}it stands from ")), "{told}");
    for word in MISLEADING {
        assert!(!text.contains(word) && !told.contains(word), "{word}: {text}{told}");
    }
}

#[test]
fn a_device_curled_at_rest_is_explained_without_its_spirals_where_they_are_axisymmetric() {
    let device = Device { ring: [4.0, 1.5, 2.0], helix_mm: 4.0, wall_mm: 0.2, shore_a: 30.0 };
    let scene = device.scene("spiral = \"axisymmetric\"");
    let (_, output) = with_scene("shut axisymmetric", &scene, &["solve", "scene.toml"]);
    assert_status(&output, 4); // it may turn about its axis
    let text = stdout(&output);
    let notes: Vec<&str> = text.lines().filter(|line| line.starts_with("note: ")).collect();
    let [note] = notes[..] else { panic!("{text}") };
    assert!(note.starts_with("note: bent by 1") && note.contains(SHUT), "{note}");
    assert!(!note.contains("spirals"), "{note}");
    let (key, value) = advice(note).unwrap();
    let (status, answer, _) = said("stands axisymmetric", &changed(&scene, key, value));
    assert_eq!((status, answer["stability"].as_str()), (Some(0), Some("stable")));
    assert!(bend(&answer).unwrap() < 1.0, "{answer:?}");
}

#[test]
fn a_load_is_not_blamed_for_what_the_rings_do_nor_they_for_the_load() {
    // Alone, one segment of the paper stands; 60 mT across close it.
    let field = |millitesla: f64| format!("[field]\nuniform_mt = [0.0, {millitesla:?}, 0.0]\n");
    let paper = format!("[design]\nsegments = 1\n{PATIENT}interaction = \"full\"\n{}", field(60.0));
    let (status, answer, _) = said("shut by a load", &paper);
    assert_eq!(status, Some(2));
    assert!(!answer["reason"].as_str().unwrap().contains("the rings pull"), "{answer:?}");

    // The other device closes without any field.
    let scene = CLOSING.scene("") + &field(2.0);
    let (status, answer, _) = said("shut and loaded", &scene);
    assert_eq!(status, Some(2));
    let reason = answer["reason"].as_str().unwrap();
    assert!(reason.starts_with(SHUT), "{reason}");
    let (key, value) = advice(reason).unwrap();
    let unloaded = changed(&CLOSING.scene(""), key, value);
    assert_eq!(said("shut and unloaded", &unloaded).0, Some(0));
    let under_load = said("shut under its load", &changed(&scene, key, value)).1;
    assert_eq!(under_load["converged"] == false, reason.contains("no shape there under the loads"));
}

#[test]
fn where_hardness_is_at_its_end_weaker_rings_are_advised() {
    let hard = Device { ring: [6.0, 2.0, 2.0], helix_mm: 3.0, wall_mm: 0.2, shore_a: 95.0 };
    let scene = changed(&hard.scene(""), "design.ring.remanence_t", "6.0");
    let (status, answer, _) = said("shut though hard", &scene);
    assert_eq!(status, Some(2));
    let reason = answer["reason"].as_str().unwrap();
    let (key, value) = advice(reason).unwrap_or_else(|| panic!("{reason}"));
    assert!(key == "design.ring.remanence_t" && reason.ends_with(" down"), "{reason}");
    assert!(value.parse::<f64>().unwrap() < 6.0, "{reason}");
    assert_eq!(said("stands with weaker rings", &changed(&scene, key, value)).0, Some(0));
}

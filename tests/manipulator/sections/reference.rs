//! Every equilibrium of `sections_dev.json`: rods and magnets by strain polynomials of an independent program.

use std::path::Path;

use mcm::geometry::{Pose, rotation_log};
use mcm::manipulator::{Outputs, Scene};
use nalgebra::Vector3;
use serde_json::Value;

use crate::tolerance::{SECTIONS_ANGLE, SECTIONS_LENGTH, SECTIONS_MARGIN, SECTIONS_WRENCH};

/// Number of cases in the table.
const CASES: usize = 17;

/// As finely resolved as the default settings allow.
const FINE: &str = "[model]\ntolerance_position_mm = 1e-6\ntolerance_angle_deg = 1e-6\ntolerance_relative = 0.0\n\
                    time_budget_s = 60.0\n";

fn cases() -> Vec<Value> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/reference/sections_dev.json");
    let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let file: Value = serde_json::from_str(&text).expect("the table is JSON");
    file["cases"].as_array().expect("the table has cases").clone()
}

fn numbers(value: &Value) -> Vec<f64> {
    let entries = value.as_array().unwrap_or_else(|| panic!("no list: {value}"));
    entries.iter().map(|entry| entry.as_f64().unwrap_or_else(|| panic!("no number: {entry}"))).collect()
}

fn vector(value: &Value) -> Vector3<f64> {
    Vector3::from_column_slice(&numbers(value))
}

/// Name, error and bound of every output.
fn errors(case: &Value, outputs: &Outputs) -> Vec<(&'static str, f64, f64)> {
    let (results, length) = (&case["results"], case["reach_m"].as_f64().expect("a length"));
    let [w, x, y, z] = numbers(&results["tip_orientation_wxyz"])[..] else { panic!("four numbers") };
    let tip = Pose::new(vector(&results["tip_position_m"]).into(), [w, x, y, z]).expect("a unit quaternion");
    let relative = |own: &Vector3<f64>, key: &str| {
        let expected = vector(&results[key]);
        (own - expected).norm() / expected.norm().max(f64::MIN_POSITIVE)
    };

    let mut found = vec![
        ("tip", (outputs.tip.position - tip.position).norm() / length, SECTIONS_LENGTH),
        ("orientation", rotation_log(&tip.rotation.tr_mul(&outputs.tip.rotation)).norm(), SECTIONS_ANGLE),
        ("torque", relative(&outputs.magnetic_torque, "magnetic_torque_nm"), SECTIONS_WRENCH),
        (
            "margin",
            (outputs.stability_margin - results["stability_margin"].as_f64().expect("a margin")).abs(),
            SECTIONS_MARGIN,
        ),
    ];
    if vector(&results["magnetic_force_n"]) != Vector3::zeros() {
        found.push(("force", relative(&outputs.magnetic_force, "magnetic_force_n"), SECTIONS_WRENCH));
    }
    let energy = results["energy_j"]["total"].as_f64().expect("an energy");
    found.push(("energy", (outputs.energy / energy - 1.0).abs(), SECTIONS_WRENCH));
    for (own, expected) in outputs.rings.iter().zip(results["rigid_centres_m"].as_array().expect("a list")) {
        found.push(("rigid body", (own.position - vector(expected)).norm() / length, SECTIONS_LENGTH));
    }
    found
}

#[test]
fn every_equilibrium_of_sections_is_met() {
    let mut worst = Vec::new();
    let cases = cases();
    for case in &cases {
        let name = case["id"].as_str().expect("a name");
        let text = case["toml"].as_str().expect("a scene").replace("[model]\n", FINE);
        let scene = Scene::parse(&text, name).expect("the scene is allowed");
        let mut manipulator = scene.manipulator(2).expect("the device can be made");
        let outputs = manipulator.solve(&scene.inputs).expect("finite inputs").clone();
        assert_eq!(outputs.stable, Some(true), "{name}: {:?}", outputs.outcome);

        let found = errors(case, &outputs);
        for (output, error, bound) in &found {
            assert!(error <= bound, "{name}: {output}: error {error:e}, allowed {bound:e}");
        }
        let tip = found[0].1;
        worst.push((name, tip));
    }
    worst.sort_by(|a, b| b.1.total_cmp(&a.1));
    println!("tips over the length, worst first: {worst:?}");
    assert_eq!(cases.len(), CASES);
}

/// Random devices with magnets in all directions against `tests/bench/section_devices.py`, by shooting and surface charges.
#[test]
fn random_devices_bend_as_shooting_says() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/bench/section_devices.json");
    let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let file: Value = serde_json::from_str(&text).expect("the table is JSON");
    let devices = file.as_array().expect("a list");
    assert!(devices.len() > 5, "only {} devices", devices.len());
    for device in devices {
        let scene = device["toml"].as_str().expect("a scene").replace("[model]\n", FINE);
        let scene = Scene::parse(&scene, "random").expect("the scene is allowed");
        let mut manipulator = scene.manipulator(2).expect("the device can be made");
        let outputs = manipulator.solve(&scene.inputs).expect("finite inputs");
        let length = device["length_m"].as_f64().expect("a length");
        let apart = (outputs.tip.position - vector(&device["tip_position_m"])).norm() / length;
        assert!(apart <= SECTIONS_LENGTH, "{}: {apart:e} of the length", device["id"]);
    }
}

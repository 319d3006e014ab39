//! The device of a page: the answers of the FMU, and what it does when something fails.

use mcm::equilibrium::Interaction;
use mcm::manipulator::Scene;
use mcm::web::Device;
use serde_json::Value;

use super::{BESIDE, PASSING};

/// Place of a variable among the device's inputs or outputs.
fn place(device: &Device, kind: &str, name: &str) -> usize {
    let description: Value = serde_json::from_str(&device.description().unwrap()).unwrap();
    let rows = description[kind].as_array().unwrap();
    rows.iter().position(|row| row["name"] == name).unwrap_or_else(|| panic!("{name}"))
}

fn output(device: &Device, name: &str) -> f64 {
    device.outputs()[place(device, "outputs", name)]
}

#[test]
fn answers_are_those_of_the_manipulator_bit_by_bit() {
    let mut device = Device::open(BESIDE, None).unwrap();
    let scene = Scene::parse(BESIDE, "test").unwrap();
    let mut manipulator = scene.manipulator(49).unwrap();
    let (mut inputs, mut own) = (device.start(), scene.inputs.clone());
    assert!(device.load(&inputs), "{}", device.said());
    manipulator.solve(&own).unwrap();
    let height = place(&device, "inputs", "magnet.position[2]");
    for step in 1..10 {
        inputs[height] = -0.12 + 1e-3 * f64::from(step);
        own.sources[0].pose.position.y = inputs[height];
        assert!(device.step(&inputs), "{}", device.said());
        let outputs = manipulator.solve(&own).unwrap();
        for (name, expected) in [
            ("tip.angle", outputs.tip_angle),
            ("tip.position[2]", outputs.tip.position.y),
            ("force.magnetic[3]", outputs.magnetic_force.z),
            ("shape.position[49,2]", outputs.tip.position.y),
            ("stability.margin", outputs.stability_margin),
            ("stability.stable", 1.0),
        ] {
            assert_eq!(output(&device, name).to_bits(), expected.to_bits(), "{name} at step {step}");
        }
    }
    assert!(device.measure());
    let measured = manipulator.measure_margin().stability_margin;
    assert_eq!(output(&device, "stability.margin").to_bits(), measured.to_bits());
}

#[test]
fn a_cheaper_level_is_another_device_of_the_same_scene() {
    let device = Device::open(BESIDE, None).unwrap();
    let mut cheaper = device.at_level(Interaction::None);
    assert!(cheaper.load(&device.start()));
    assert!(output(&cheaper, "model.level").abs() < f64::EPSILON, "none is 0");
    assert!(cheaper.step(&device.start()));
    assert!(output(&cheaper, "model.level").abs() < f64::EPSILON, "and stays so");
}

#[test]
fn what_is_refused_leaves_the_last_shape() {
    let mut device = Device::open(BESIDE, None).unwrap();
    let start = device.start();
    assert!(output(&device, "tip.angle").is_nan(), "nothing is solved yet");
    assert!(!device.measure());
    assert!(!device.load(&start[1..]));
    assert!(device.said().contains("inputs for a device that has"), "too few");
    assert!(device.load(&start));
    let before = device.outputs();
    for (name, value, says) in [
        ("magnet.position[1]", f64::NAN, "magnet.position[1]"),
        ("magnet.orientation[2]", 3.0, "magnet.orientation"),
    ] {
        let mut inputs = start.clone();
        inputs[place(&device, "inputs", name)] = value;
        assert!(!device.step(&inputs), "{name}");
        let said = device.said();
        assert!(said.contains(says), "{said}");
        assert!((output(&device, "solver.outcome") - 6.0).abs() < f64::EPSILON, "{name}");
        let shape = |outputs: &[f64]| outputs[..place(&device, "outputs", "stability.snaps")].to_vec();
        assert_eq!(shape(&device.outputs()), shape(&before), "{name}");
    }
    assert!(device.step(&start), "and it goes on: {}", device.said());
}

#[test]
fn it_goes_on_after_a_step_without_an_answer() {
    let mut device = Device::open(BESIDE, None).unwrap();
    let start = device.start();
    assert!(device.load(&start));
    let mut inside = start.clone();
    inside[place(&device, "inputs", "magnet.position[2]")] = 0.0;
    assert!(!device.step(&inside), "the magnet stands in the device");
    assert!(!device.said().is_empty());
    assert!(output(&device, "tip.angle").is_finite(), "the last good shape");
    assert!((output(&device, "solver.status") - 3.0).abs() < f64::EPSILON);
    assert!(device.step(&start), "{}", device.said());
    assert!(output(&device, "solver.status").abs() < f64::EPSILON);
}

#[test]
fn a_first_pose_without_an_answer_can_be_left() {
    let scene = BESIDE.replace("-120.0", "0.0");
    let mut device = Device::open(&scene, None).unwrap();
    let mut inputs = device.start();
    assert!(!device.load(&inputs));
    assert!(output(&device, "tip.angle").is_nan());
    assert!((output(&device, "solver.status") - 3.0).abs() < f64::EPSILON);
    inputs[place(&device, "inputs", "magnet.position[2]")] = -0.12;
    assert!(device.step(&inputs), "{}", device.said());
}

#[test]
fn a_snap_is_told() {
    let mut device = Device::open(PASSING, None).unwrap();
    let mut inputs = device.start();
    assert!(device.load(&inputs));
    let along = place(&device, "inputs", "magnet.position[3]");
    for step in 1..=60 {
        inputs[along] = -0.08 + 0.15 * f64::from(step) / 60.0;
        assert!(device.step(&inputs), "{}", device.said());
        let said = device.said();
        assert_eq!(said.contains("snapped"), (output(&device, "solver.status") - 2.0).abs() < 0.1, "{said}");
    }
    assert!((output(&device, "stability.snaps") - 1.0).abs() < f64::EPSILON);
}

#[test]
fn scenes_that_are_refused_say_why() {
    let refused = |scene: &str, grid: Option<&[u8]>| Device::open(scene, grid).unwrap_err().to_string();
    let said = refused("[design]\nsegmnts = 3\n[field]\nuniform_mt = [0, 1]", None);
    assert!(said.contains("scene, line 2") && said.contains("scene, line 4"), "{said}");
    let mesh = "[vessel]\nmesh_stl = \"aorta.stl\"";
    assert!(refused(mesh, None).contains("fmu/live --scene"));
    assert!(refused(mesh, Some(b"no grid")).contains("vessel.mesh_stl"));
    assert!(refused("[model]\nmethod = \"shooting\"", None).contains("shooting"));
}

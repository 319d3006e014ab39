//! The packed FMU in an importer that is not ours, `fmi-rs`: the pass of the magnet that the examples drive.

use std::path::{Path, PathBuf};
use std::process::Command;

use fmi_rs::fmi2::builder::FMU2Builder;
use fmi_rs::fmi2::types::fmi2Status;
use fmi_rs::model_description::fmi2::ModelDescription;
use mcm::equilibrium::Interaction;
use mcm::fmi::package::{DEFAULT_SCENE, DEFAULT_SHAPE_POINTS};
use mcm::geometry::Pose;
use mcm::manipulator::{Manipulator, Outputs, Scene};

use crate::tolerance::{IMPORTER, assert_close};

const PASS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/fmu/examples/magnet_pass.csv");

const OUTPUTS: [&str; 7] = [
    "tip.angle",
    "tip.position[1]",
    "tip.position[2]",
    "tip.position[3]",
    "magnet.reaction_force[1]",
    "magnet.reaction_force[2]",
    "magnet.reaction_force[3]",
];

/// The library that cargo has built beside this test.
fn library() -> PathBuf {
    std::env::current_exe().unwrap().with_file_name(format!(
        "{}mcm{}",
        std::env::consts::DLL_PREFIX,
        std::env::consts::DLL_SUFFIX
    ))
}

/// The default FMU with it, in this file.
fn packed(name: &str) -> PathBuf {
    let (fmu, library) = (Path::new(env!("CARGO_TARGET_TMPDIR")).join(name), library());
    let packing = Command::new(env!("CARGO_BIN_EXE_mcm"))
        .args(["pack".as_ref(), "--library".as_ref(), library.as_os_str(), "--out".as_ref(), fmu.as_os_str()])
        .output()
        .unwrap();
    assert!(packing.status.success(), "{}", String::from_utf8_lossy(&packing.stderr));
    fmu
}

/// Names of the inputs, and their values over time (time first).
fn pass() -> (Vec<String>, Vec<Vec<f64>>) {
    let mut reader = csv::Reader::from_path(PASS).unwrap();
    let names = reader.headers().unwrap().iter().skip(1).map(str::to_owned).collect();
    (names, reader.deserialize().map(Result::unwrap).collect())
}

/// What the methods that are kept to compare with would say, and what an FMU does.
#[test]
fn the_library_holds_the_potential_method_alone() {
    let bytes = std::fs::read(library()).unwrap();
    let holds = |words: &str| bytes.windows(words.len()).any(|window| window == words.as_bytes());
    assert!(holds("the branch ends at a fold"), "what an FMU says of a lost branch");
    for words in ["does not lie in one plane", "collocation intervals of a core"] {
        assert!(!holds(words), "\"{words}\" is linked into the library");
    }
}

fn references<'a>(description: &ModelDescription, names: impl Iterator<Item = &'a str>) -> Vec<u32> {
    names.map(|name| description.variable_by_name(name).unwrap().valueReference).collect()
}

/// What the Rust API answers for a row of the pass.
fn answer(manipulator: &mut Manipulator, scene: &Scene, row: &[f64]) -> [f64; 7] {
    let mut inputs = scene.inputs.clone();
    inputs.magnet = Pose::new([row[1], row[2], row[3]], [row[4], row[5], row[6], row[7]]).unwrap();
    let Outputs { tip_angle, tip, magnet_reaction_force: force, .. } = manipulator.solve(&inputs).unwrap();
    let p = tip.position;
    [*tip_angle, p.x, p.y, p.z, force.x, force.y, force.z]
}

#[test]
fn another_importer_gets_what_the_rust_api_answers() {
    let importer = FMU2Builder::new(&packed("importer.fmu")).unwrap();
    let description = &importer.model_description;
    let flaws = description.validate();
    assert!(flaws.is_empty(), "{flaws:?}");
    let (names, rows) = pass();
    let inputs = references(description, names.iter().map(String::as_str));
    let outputs = references(description, OUTPUTS.into_iter());
    // A level of one model: what `auto` answers depends, within its tolerances, on the way there.
    let mut scene = Scene::parse(DEFAULT_SCENE, "default scene").unwrap();
    scene.settings.interaction = Interaction::Rings;
    let mut manipulator = scene.manipulator(DEFAULT_SHAPE_POINTS).unwrap();

    let device = importer.instantiate_cs("device").unwrap();
    let level = references(description, ["model.interaction"].into_iter());
    assert_eq!(device.setInteger(&level, &[Interaction::Rings as i32]), fmi2Status::Ok);
    assert_eq!(device.setupExperiment(None, 0.0, None), fmi2Status::Ok);
    assert_eq!(device.enterInitializationMode(), fmi2Status::Ok);
    assert_eq!(device.setReal(&inputs, &rows[0][1..]), fmi2Status::Ok);
    assert_eq!(device.exitInitializationMode(), fmi2Status::Ok);
    answer(&mut manipulator, &scene, &rows[0]);
    for pair in rows.windows(2) {
        let (time, step) = (pair[0][0], pair[1][0] - pair[0][0]);
        assert_eq!(device.setReal(&inputs, &pair[0][1..]), fmi2Status::Ok);
        assert_eq!(device.doStep(time, step, 0), fmi2Status::Ok, "{time}");
        let mut got = [f64::NAN; OUTPUTS.len()];
        assert_eq!(device.getReal(&outputs, &mut got), fmi2Status::Ok);
        let expected = answer(&mut manipulator, &scene, &pair[0]);
        for (of, part) in [("angle", 0..1), ("tip", 1..4), ("force", 4..7)] {
            assert_close((of, time), &got[part.clone()], &expected[part], IMPORTER);
        }
    }
    assert_eq!(device.terminate(), fmi2Status::Ok);
}

#[test]
fn another_importer_gets_the_same_in_model_exchange() {
    let importer = FMU2Builder::new(&packed("exchange.fmu")).unwrap();
    let description = &importer.model_description;
    let (names, rows) = pass();
    let inputs = references(description, names.iter().map(String::as_str));
    let outputs = references(description, OUTPUTS.into_iter());
    let mut scene = Scene::parse(DEFAULT_SCENE, "default scene").unwrap();
    scene.settings.interaction = Interaction::Rings;
    let mut manipulator = scene.manipulator(DEFAULT_SHAPE_POINTS).unwrap();

    let device = importer.instantiate_me("device").unwrap();
    let level = references(description, ["model.interaction"].into_iter());
    assert_eq!(device.setInteger(&level, &[Interaction::Rings as i32]), fmi2Status::Ok);
    assert_eq!(device.setupExperiment(None, 0.0, None), fmi2Status::Ok);
    assert_eq!(device.enterInitializationMode(), fmi2Status::Ok);
    assert_eq!(device.setReal(&inputs, &rows[0][1..]), fmi2Status::Ok);
    assert_eq!(device.exitInitializationMode(), fmi2Status::Ok);
    let (mut flags, mut next) = ([true; 4], Some(f64::NAN));
    let [needed, end, nominals, values] = &mut flags;
    assert_eq!(device.newDiscreteStates(needed, end, nominals, values, &mut next), fmi2Status::Ok);
    assert_eq!((flags, next), ([false; 4], None), "no event follows");
    assert_eq!(device.enterContinuousTimeMode(), fmi2Status::Ok);
    answer(&mut manipulator, &scene, &rows[0]);
    for (row, next) in rows.iter().zip(&rows[1..]) {
        assert_eq!(device.setTime(row[0]), fmi2Status::Ok);
        let read = |row: &[f64]| {
            let mut got = [f64::NAN; OUTPUTS.len()];
            assert_eq!(device.setReal(&inputs, &row[1..]), fmi2Status::Ok);
            assert_eq!(device.getReal(&outputs, &mut got), fmi2Status::Ok);
            got
        };
        // As an integrator tries a step and takes it back.
        read(next);
        let got = read(row);
        let (mut event, mut end) = (7, 7);
        assert_eq!(device.completedIntegratorStep(0, &mut event, &mut end), fmi2Status::Ok);
        assert_eq!((event, end), (0, 0), "no snap");
        let expected = answer(&mut manipulator, &scene, row);
        for (of, part) in [("angle", 0..1), ("tip", 1..4), ("force", 4..7)] {
            assert_close((of, row[0]), &got[part.clone()], &expected[part], IMPORTER);
        }
    }
    assert_eq!(device.terminate(), fmi2Status::Ok);
}

#[test]
fn the_importer_sees_a_defect() {
    let text = mcm::fmi::Package::built_in().unwrap().model_description(None).unwrap();
    let problems = |text: &str| ModelDescription::from_string(text).unwrap().validate().len();
    assert_eq!(problems(&text), 0);
    assert_ne!(problems(&text.replace("name=\"magnet.position[2]\"", "name=\"magnet.position[1]\"")), 0);
}

//! The packed FMU in an importer that is not ours, `fmi-rs`: the pass of the magnet that the examples drive.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Arc;

use fmi_rs::fmi2::FMU2;
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

/// What an importer drives, and the Rust API beside it.
struct Pair<T> {
    device: Arc<FMU2<T>>,
    inputs: Vec<u32>,
    outputs: Vec<u32>,
    scene: Scene,
    manipulator: Manipulator,
}

impl<T> Pair<T> {
    /// Both at the first row of the pass, initialised.
    fn initialised(
        device: Arc<FMU2<T>>,
        description: &ModelDescription,
        names: &[String],
        first: &[f64],
    ) -> Self {
        // A level of one model: what `auto` answers depends, within its tolerances, on the way there.
        let mut scene = Scene::parse(DEFAULT_SCENE, "default scene").unwrap();
        scene.settings.interaction = Interaction::Rings;
        let manipulator = scene.manipulator(DEFAULT_SHAPE_POINTS).unwrap();
        let inputs = references(description, names.iter().map(String::as_str));
        let outputs = references(description, OUTPUTS.into_iter());
        let level = references(description, ["model.interaction"].into_iter());
        assert_eq!(device.setInteger(&level, &[Interaction::Rings as i32]), fmi2Status::Ok);
        assert_eq!(device.setupExperiment(None, 0.0, None), fmi2Status::Ok);
        assert_eq!(device.enterInitializationMode(), fmi2Status::Ok);
        let mut out = Self { device, inputs, outputs, scene, manipulator };
        out.set(first);
        assert_eq!(out.device.exitInitializationMode(), fmi2Status::Ok);
        out.answer(first);
        out
    }

    /// Sets the inputs of a row of the pass.
    fn set(&self, row: &[f64]) {
        assert_eq!(self.device.setReal(&self.inputs, &row[1..]), fmi2Status::Ok);
    }

    fn read(&self) -> [f64; OUTPUTS.len()] {
        let mut got = [f64::NAN; OUTPUTS.len()];
        assert_eq!(self.device.getReal(&self.outputs, &mut got), fmi2Status::Ok);
        got
    }

    /// What the Rust API answers for a row.
    fn answer(&mut self, row: &[f64]) -> [f64; OUTPUTS.len()] {
        let mut inputs = self.scene.inputs.clone();
        inputs.sources[0].pose =
            Pose::new([row[1], row[2], row[3]], [row[4], row[5], row[6], row[7]]).unwrap();
        let solved = self.manipulator.solve(&inputs).unwrap();
        let Outputs { tip_angle, tip, reactions, .. } = solved;
        let (p, force) = (tip.position, reactions[0].force);
        [*tip_angle, p.x, p.y, p.z, force.x, force.y, force.z]
    }

    /// Compares what the importer got for a row with what the Rust API answers.
    fn compare(&mut self, got: &[f64; OUTPUTS.len()], row: &[f64]) {
        let expected = self.answer(row);
        for (of, part) in [("angle", 0..1), ("tip", 1..4), ("force", 4..7)] {
            assert_close((of, row[0]), &got[part.clone()], &expected[part], IMPORTER);
        }
    }
}

#[test]
fn another_importer_gets_what_the_rust_api_answers() {
    let importer = FMU2Builder::new(&packed("importer.fmu")).unwrap();
    let description = &importer.model_description;
    let flaws = description.validate();
    assert!(flaws.is_empty(), "{flaws:?}");
    let (names, rows) = pass();
    let device = importer.instantiate_cs("device").unwrap();
    let mut pair = Pair::initialised(device, description, &names, &rows[0]);
    for (row, next) in rows.iter().zip(&rows[1..]) {
        pair.set(row);
        assert_eq!(pair.device.doStep(row[0], next[0] - row[0], 0), fmi2Status::Ok, "{}", row[0]);
        let got = pair.read();
        pair.compare(&got, row);
    }
    assert_eq!(pair.device.terminate(), fmi2Status::Ok);
}

#[test]
fn another_importer_gets_the_same_in_model_exchange() {
    let importer = FMU2Builder::new(&packed("exchange.fmu")).unwrap();
    let (names, rows) = pass();
    let device = importer.instantiate_me("device").unwrap();
    let mut pair = Pair::initialised(device, &importer.model_description, &names, &rows[0]);
    let (mut flags, mut next) = ([true; 4], Some(f64::NAN));
    let [needed, end, nominals, values] = &mut flags;
    assert_eq!(pair.device.newDiscreteStates(needed, end, nominals, values, &mut next), fmi2Status::Ok);
    assert_eq!((flags, next), ([false; 4], None), "no event follows");
    assert_eq!(pair.device.enterContinuousTimeMode(), fmi2Status::Ok);
    for (row, next) in rows.iter().zip(&rows[1..]) {
        assert_eq!(pair.device.setTime(row[0]), fmi2Status::Ok);
        // As an integrator tries a step and takes it back.
        pair.set(next);
        pair.read();
        pair.set(row);
        let got = pair.read();
        let (mut event, mut end) = (7, 7);
        assert_eq!(pair.device.completedIntegratorStep(0, &mut event, &mut end), fmi2Status::Ok);
        assert_eq!((event, end), (0, 0), "no snap");
        pair.compare(&got, row);
    }
    assert_eq!(pair.device.terminate(), fmi2Status::Ok);
}

#[test]
fn the_importer_sees_a_defect() {
    let text = mcm::fmi::Package::built_in().unwrap().model_description(None).unwrap();
    let problems = |text: &str| ModelDescription::from_string(text).unwrap().validate().len();
    assert_eq!(problems(&text), 0);
    assert_ne!(problems(&text.replace("name=\"magnet.position[2]\"", "name=\"magnet.position[1]\"")), 0);
}

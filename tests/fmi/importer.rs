//! The packed archive in an importer of others, the crate `fmi-rs`: it validates, loads and runs it.

use std::path::{Path, PathBuf};
use std::process::Command;

use fmi_rs::fmi2::builder::FMU2Builder;
use fmi_rs::fmi2::types::{fmi2False, fmi2Status};
use fmi_rs::model_description::fmi2::ModelDescription;

use crate::tolerance::EFFECT;

/// An archive of the default design.
fn packed(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    // The library of this build lies beside this program; the one beside the command may be of an earlier build.
    let name = format!("{}mcm{}", std::env::consts::DLL_PREFIX, std::env::consts::DLL_SUFFIX);
    let library = std::env::current_exe().unwrap().with_file_name(name);
    let mut pack = Command::new(env!("CARGO_BIN_EXE_mcm"));
    let done = pack.args(["pack", "--out"]).arg(&path).arg("--library").arg(library).output().unwrap();
    assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
    path
}

#[test]
fn an_importer_finds_it_valid_and_runs_it() {
    let builder = FMU2Builder::new(&packed("importer.fmu")).unwrap();
    let problems = builder.model_description.validate();
    assert!(problems.is_empty(), "{problems:?}");
    let reference = |name: &str| builder.model_description.variable_by_name(name).unwrap().valueReference;
    let instance = builder.instantiate_cs("device").unwrap();
    assert_eq!(instance.setupExperiment(Some(1e-5), 0.0, Some(1.0)), fmi2Status::Ok);
    assert_eq!(instance.enterInitializationMode(), fmi2Status::Ok);
    assert_eq!(instance.exitInitializationMode(), fmi2Status::Ok);
    let mut angles = [f64::NAN; 2];
    for (step, angle) in angles.iter_mut().enumerate() {
        let closer = -0.12 + 0.002 * step as f64;
        assert_eq!(instance.setReal(&[reference("magnet.position[2]")], &[closer]), fmi2Status::Ok);
        assert_eq!(instance.doStep(0.1 * step as f64, 0.1, fmi2False), fmi2Status::Ok);
        assert_eq!(instance.getReal(&[reference("tip.angle")], std::slice::from_mut(angle)), fmi2Status::Ok);
    }
    assert!((angles[1] - angles[0]).abs() > EFFECT, "{angles:?}");
    assert_eq!(instance.terminate(), fmi2Status::Ok);
}

#[test]
fn the_importer_sees_a_defect() {
    let text = mcm::fmi::Package::built_in().unwrap().model_description(None).unwrap();
    let problems = |text: &str| ModelDescription::from_string(text).unwrap().validate().len();
    assert_eq!(problems(&text), 0);
    assert_ne!(problems(&text.replace("name=\"magnet.position[2]\"", "name=\"magnet.position[1]\"")), 0);
}

//! `mcm fit`.

use std::fmt::Write;
use std::path::PathBuf;
use std::process::Output;

use mcm::manipulator::SceneFile;

use super::svg::{Axes, elements};
use super::{assert_status, folder, mcm, stderr, stdout, table};

const SCENE: &str =
    "[design]\nsegments = 1\n[field]\nuniform_mt = [0, 5, 0]\n[model]\ninteraction = \"rings\"";
const KEY: &str = "design.helix.shore_a";

/// Measured angles (deg) of a device with hardness 30 in fields of 5, 10, 15 mT, in a table with this text in front.
fn measured(here: &std::path::Path, more: &str) -> String {
    std::fs::write(here.join("soft.toml"), format!("{SCENE}\n[design.helix]\nshore_a = 30.0")).unwrap();
    let arguments = ["sweep", "soft.toml", "--vary", "field.uniform_mt[2]=5:15:3", "--out", "sweep.csv"];
    assert_status(&mcm(here, &arguments), 0);
    let mut out = format!("field.uniform_mt[2],alpha_deg{more}\n");
    for row in table(&here.join("sweep.csv")) {
        let zero = if more.is_empty() { "" } else { ",0.1" };
        writeln!(out, "{},{}{zero}", row["field.uniform_mt[2]"], row["alpha_deg"]).unwrap();
    }
    out
}

fn run(test: &str, data: impl Fn(&std::path::Path) -> String, more: &[&str]) -> (PathBuf, Output) {
    let here = folder(test);
    std::fs::write(here.join("scene.toml"), SCENE).unwrap();
    std::fs::write(here.join("data.csv"), data(&here)).unwrap();
    let arguments = ["fit", "scene.toml", "--measured", "data.csv", "--vary", KEY, "--out", "fit.toml"];
    let output = mcm(&here, &[&arguments[..], more].concat());
    (here, output)
}

#[test]
fn the_scene_written_has_the_fitted_values_and_how_sure_they_are() {
    let (here, output) = run("fit", |here| measured(here, ",sd_alpha_deg"), &["--picture", "fit.svg"]);
    assert_status(&output, 0);
    let text = std::fs::read_to_string(here.join("fit.toml")).unwrap();
    let file = SceneFile::parse(&text, "fit").unwrap();
    assert!((file.number(KEY).unwrap() - 30.0).abs() < 1e-5);
    let uncertainty = file.uncertainty().unwrap();
    assert_eq!(uncertainty.keys, [KEY]);
    assert!((0.01..1.0).contains(&uncertainty.deviations[0]), "{uncertainty:?}");
    let told = stdout(&output);
    assert!(told.contains(KEY) && told.contains("95 % interval") && told.contains("residuals"), "{told}");
    assert_status(&mcm(&here, &["solve", "fit.toml", "--uncertainty"]), 0);
    // What was measured stands where the line of equal values is, and the residuals are within their band.
    let elements = elements(&here.join("fit.svg"));
    let [compared, residuals] = &Axes::of(&elements)[..] else { panic!("two pairs of axes") };
    let points = |axes: &Axes, curve: usize| -> Vec<[f64; 2]> {
        axes.curves()[curve].iter().flat_map(|part| part.places()).collect()
    };
    let angles: Vec<[f64; 2]> = table(&here.join("data.csv"))
        .iter()
        .map(|row| row["alpha_deg"].parse::<f64>().unwrap())
        .map(|angle| [angle, angle])
        .collect();
    compared.assert_at(&points(compared, 1), &angles);
    compared.assert_at(&points(compared, 0), &[angles[0], angles[2]]);
    let lines: Vec<[f64; 2]> = (2..5).map(|line| [f64::from(line), 0.0]).collect();
    residuals.assert_at(&points(residuals, 0), &lines);
    assert_eq!(residuals.inside.iter().filter(|element| element.get("class") == "band").count(), 1);
}

#[test]
fn a_table_without_deviations_and_a_robust_fit() {
    let (here, output) = run("fit_robust", |here| measured(here, ""), &["--robust"]);
    assert_status(&output, 0);
    let text = std::fs::read_to_string(here.join("fit.toml")).unwrap();
    assert!((SceneFile::parse(&text, "fit").unwrap().number(KEY).unwrap() - 30.0).abs() < 1e-5);
}

#[test]
fn rows_without_a_shape_are_told() {
    let (here, output) = run("fit_lost", |here| measured(here, "") + "500,90\n", &[]);
    assert_status(&output, 2);
    assert!(stderr(&output).contains("line 5 does not count: no shape"), "{}", stderr(&output));
    assert!(here.join("fit.toml").exists());
}

#[test]
fn what_cannot_be_told_apart_is_named() {
    let ring = ["--vary", "design.ring.density_kg_m3"];
    let (_, output) = run("fit_apart", |here| measured(here, ",sd_alpha_deg"), &ring);
    assert_status(&output, 0);
    let told = stdout(&output);
    assert!(told.contains("`design.ring.density_kg_m3` is hardly determined by these rows"), "{told}");
    assert!(told.contains("again with `gravity.acceleration_m_s2["), "{told}");
}

#[test]
fn bad_input_is_refused_before_anything_is_written() {
    for (test, data, more, expected) in [
        ("fit_empty", "field.uniform_mt[2],alpha_deg\n", &[][..], "has no rows"),
        ("fit_nan", "field.uniform_mt[2],alpha_deg\n5,nan\n", &[], "line 2: alpha_deg = \"nan\""),
        ("fit_column", "field.uniform_mt[2],alfa_deg\n5,1\n", &[], "did you mean `alpha_deg`?"),
        ("fit_none", "field.uniform_mt[2]\n5\n", &[], "no column is an output"),
        ("fit_few", "alpha_deg\n5\n", &["--vary", "design.ring.remanence_t"], "2 parameters need as many"),
        ("fit_sigma", "alpha_deg\n5\n", &["--sigma", "alpha_deg"], "OUTPUT=VALUE"),
        ("fit_zero", "alpha_deg\n5\n", &["--sigma", "alpha_deg=0"], "standard deviation of alpha_deg = 0"),
        ("fit_key", "alpha_deg\n5\n6\n", &["--vary", "design.helix.shore_b"], "did you mean `shore_a`?"),
        ("fit_twice", "alpha_deg\n5\n6\n", &["--vary", KEY], "is named twice"),
        ("fit_png", "alpha_deg\n5\n", &["--picture", "fit.png"], "--picture fit.png must end in .svg"),
        ("fit_range", "alpha_deg\n5\n", &["--vary", "design.ring.remanence_t=1:2:3"], "takes a key alone"),
    ] {
        let (here, output) = run(test, |_| data.to_owned(), more);
        assert_status(&output, 1);
        assert!(stderr(&output).contains(expected), "{test}: {}", stderr(&output));
        assert!(!here.join("fit.toml").exists(), "{test}");
    }
    let here = folder("fit_over");
    std::fs::write(here.join("scene.toml"), SCENE).unwrap();
    std::fs::write(here.join("data.csv"), "alpha_deg\n5\n").unwrap();
    let over = ["fit", "scene.toml", "--measured", "data.csv", "--vary", KEY, "--out", "scene.toml"];
    let output = mcm(&here, &over);
    assert_status(&output, 1);
    assert!(stderr(&output).contains("would be written over scene.toml"), "{}", stderr(&output));
}

//! `mcm follow`.
#![allow(clippy::float_cmp, reason = "files must carry every bit")]

use mcm::manipulator::Scene;

use super::{assert_status, folder, mcm, stderr, table};

const SCENE: &str = "[design]\nsegments = 1\n[magnet]\n[model]\ninteraction = \"rings\"";

fn run(test: &str, path: &str) -> (std::path::PathBuf, std::process::Output) {
    let here = folder(test);
    std::fs::write(here.join("scene.toml"), SCENE).unwrap();
    std::fs::write(here.join("path.csv"), path).unwrap();
    let output = mcm(&here, &["follow", "scene.toml", "--inputs", "path.csv", "--out", "shapes.csv"]);
    (here, output)
}

#[test]
fn rows_are_the_solves_one_after_the_other() {
    let heights = [-0.12, -0.11, -0.1, -0.115];
    let line = |(number, height): (usize, &f64)| format!("{},{height}\n", 0.5 * number as f64);
    let path = heights.iter().enumerate().map(line).collect::<String>();
    let (here, output) = run("follow", &format!("time,magnet.position[2]\n{path}"));
    assert_status(&output, 0);
    let rows = table(&here.join("shapes.csv"));
    assert_eq!(rows.len(), heights.len());
    let scene = Scene::parse(SCENE, "test").unwrap();
    let mut manipulator = scene.manipulator(2).unwrap();
    for ((row, height), number) in rows.iter().zip(heights).zip(0..) {
        let mut inputs = scene.inputs.clone();
        inputs.sources[0].pose.position.y = height;
        let outputs = manipulator.solve(&inputs).unwrap();
        let cell = |name: &str| row[name].parse::<f64>().unwrap();
        assert_eq!(cell("time"), 0.5 * f64::from(number));
        assert_eq!(cell("magnet.position[2]"), height);
        assert_eq!(cell("tip_y_mm"), outputs.tip.position.y * 1e3);
        assert_eq!(cell("alpha_deg"), outputs.tip_angle.to_degrees());
    }
}

#[test]
fn after_a_lost_row_the_next_one_goes_on() {
    let (here, output) = run("follow_lost", "magnet.position[2]\n-0.12\n0.0\n-0.12\n");
    assert_status(&output, 2);
    assert!(
        stderr(&output).contains("1 rows did not converge")
            && stderr(&output).contains("magnet.position[2] = 0")
    );
    let rows = table(&here.join("shapes.csv"));
    let angles: Vec<&str> = rows.iter().map(|row| row["alpha_deg"].as_str()).collect();
    assert_eq!(angles[1], "");
    let angle = |number: usize| angles[number].parse::<f64>().unwrap();
    assert!((angle(0) - angle(2)).abs() < 1e-6, "{angles:?}");
}

#[test]
fn bad_paths_are_refused_before_anything_is_written() {
    for (test, path, expected) in [
        ("follow_name", "magnet.positon[2]\n-0.1\n", "did you mean magnet.position[2]?"),
        ("follow_output", "tip.angle\n0.1\n", "tip.angle is no input"),
        ("follow_twice", "magnet.strength,magnet.strength\n1,1\n", "two columns magnet.strength"),
        (
            "follow_number",
            "magnet.strength\n1\nnan\n",
            "line 3: magnet.strength = \"nan\" is not a finite number",
        ),
        ("follow_norm", "magnet.orientation[1]\n3\n", "line 2: norm of magnet.orientation"),
        ("follow_time", "time,magnet.strength\n0,1\n0,1\n", "line 3: time = 0 does not come after 0"),
        ("follow_empty", "magnet.strength\n", "has no rows"),
        ("follow_ragged", "time,magnet.strength\n0\n", "cannot read path.csv"),
    ] {
        let (here, output) = run(test, path);
        assert_status(&output, 1);
        assert!(stderr(&output).contains(expected), "{path}: {}", stderr(&output));
        assert!(!here.join("shapes.csv").exists(), "{path}");
    }
}

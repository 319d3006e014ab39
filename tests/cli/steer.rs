//! `mcm steer`.

use super::{assert_status, stderr, stdout, table, with_scene};

const SCENE: &str =
    "[design]\nsegments = 3\n[magnet]\nposition_mm = [0.0, -120.0, 9.0]\n[model]\ninteraction = \"rings\"\n";

type Row = std::collections::HashMap<String, String>;

fn number(row: &Row, key: &str) -> f64 {
    row[key].parse().unwrap()
}

#[test]
fn the_way_ends_at_the_target_and_its_inputs_give_it() {
    let (here, output) = with_scene(
        "steer",
        SCENE,
        &[
            "steer",
            "scene.toml",
            "--tip-position-mm",
            "-0.0129,-0.4954,15.8028",
            "--move",
            "magnet.position,magnet.orientation",
            "--out",
            "way.csv",
        ],
    );
    assert_status(&output, 0);
    assert!(stdout(&output).starts_with("reached: position 0."), "{}", stdout(&output));
    let rows = table(&here.join("way.csv"));
    assert!(rows.len() > 2);
    let last = rows.last().unwrap();
    for (key, wanted) in [("tip_x_mm", -0.0129), ("tip_y_mm", -0.4954), ("tip_z_mm", 15.8028)] {
        assert!((number(last, key) - wanted).abs() < 1e-3, "{key} {last:?}");
    }
    assert!(rows.iter().all(|row| row["snaps"] == "0" && row["stable"] == "true"));
    // The last inputs in a scene of their own give that tip.
    let get = |key: &str| number(last, key);
    let position: Vec<f64> = (1..=3).map(|axis| get(&format!("magnet.position_mm[{axis}]"))).collect();
    let orientation: Vec<f64> =
        (1..=4).map(|axis| get(&format!("magnet.orientation_wxyz[{axis}]"))).collect();
    let scene =
        SCENE.replace("[0.0, -120.0, 9.0]", &format!("{position:?}\norientation_wxyz = {orientation:?}"));
    let (_, output) = with_scene("steered", &scene, &["solve", "scene.toml", "--json"]);
    let answer: serde_json::Value = serde_json::from_str(&stdout(&output)).unwrap();
    assert!((answer["tip_position_m"][1].as_f64().unwrap() + 4.954e-4).abs() < 1.1e-6, "{answer}");
}

#[test]
fn what_stops_it_is_told_and_the_way_written() {
    let arguments = [
        "steer",
        "scene.toml",
        "--tip-angle-deg",
        "80",
        "--move",
        "magnet.position",
        "--box-mm=-5,5,-130,-100,-10,30",
        "--out",
        "way.csv",
    ];
    let (here, output) = with_scene("steer stopped", SCENE, &arguments);
    assert_status(&output, 2);
    assert!(
        stderr(&output).contains("not reached: the magnet is at the edge of its workspace"),
        "{}",
        stderr(&output)
    );
    assert!(stdout(&output).starts_with("nearest: angle "), "{}", stdout(&output));
    // How far it is stands beside why.
    let told = stderr(&output);
    let off = told
        .split_once("; angle ")
        .and_then(|(_, rest)| rest.split_once(" deg off"))
        .unwrap_or_else(|| panic!("{told}"));
    assert!(off.0.parse::<f64>().unwrap() > 1.0, "{told}");
    assert!(table(&here.join("way.csv")).len() > 2);
}

#[test]
fn targets_of_a_table_are_followed() {
    let targets = "tip_x_mm,tip_y_mm,tip_z_mm\n-0.0001,-0.8156,15.7863\n0.0423,-1.1886,15.7569\n-0.0129,-0.4954,15.8028\n";
    let here = super::folder("steer table");
    std::fs::write(here.join("scene.toml"), SCENE).unwrap();
    std::fs::write(here.join("path.csv"), targets).unwrap();
    let steer = |more: &[&str]| {
        let all = [
            &["steer", "scene.toml", "--targets", "path.csv", "--move", "magnet.position,magnet.orientation"],
            more,
        ]
        .concat();
        super::mcm(&here, &all)
    };
    let output = steer(&["--out", "way.csv"]);
    assert_status(&output, 0);
    assert!(stdout(&output).starts_with("3 of 3 targets met"), "{}", stdout(&output));
    let last = table(&here.join("way.csv")).pop().unwrap();
    assert!((number(&last, "tip_y_mm") + 0.4954).abs() < 1e-3);
    for (text, reason) in [
        ("tip_x_mm,tip_y_mm\n1,2\n", "path.csv, line 2: not all of tip_x_mm, tip_y_mm, tip_z_mm"),
        ("alpha\n1\n", "path.csv: alpha is no column of a table of targets"),
        ("alpha_deg\n", "path.csv has no rows"),
        ("alpha_deg\nnan\n", "line 2: alpha_deg = \"nan\" is not a finite number"),
        ("alpha_deg\n190\n", "line 2: target tip angle (rad) = 3.3"),
    ] {
        std::fs::write(here.join("path.csv"), text).unwrap();
        let output = steer(&[]);
        assert_status(&output, 1);
        assert!(stderr(&output).contains(reason), "{text}: {}", stderr(&output));
    }
}

#[test]
fn a_way_round_a_snap_is_found() {
    let pass = |place: f64| {
        format!(
            "[design]\nsegments = 9\n[magnet]\nposition_mm = [0.0, -120.0, {place}]\norientation_wxyz = [1.0, 0.0, 0.0, 0.0]\n\
             [model]\ninteraction = \"rings\"\nbending_stop = true\n"
        )
    };
    let here = super::folder("steer plan");
    std::fs::write(here.join("scene.toml"), pass(-40.0)).unwrap();
    std::fs::write(here.join("goal.toml"), pass(0.0)).unwrap();
    let arguments = [
        "steer",
        "scene.toml",
        "--to",
        "goal.toml",
        "--move",
        "magnet.position,magnet.orientation",
        "--out",
        "way.csv",
    ];
    let output = super::mcm(&here, &arguments);
    assert_status(&output, 0);
    assert!(stdout(&output).contains("on the straight one, the next step would snap"), "{}", stdout(&output));
    let rows = table(&here.join("way.csv"));
    assert!(rows.iter().all(|row| row["snaps"] == "0"));
    assert!(number(rows.last().unwrap(), "magnet.position_mm[3]").abs() < 1e-6);
    let output = super::mcm(
        &here,
        &[&arguments[..5], &["magnet.position", "--box-mm=-0.1,0.1,-120.1,-119.9,-50,50", "--tries", "3"]]
            .concat(),
    );
    assert_status(&output, 2);
    assert!(stderr(&output).contains("no way without a snap was found in 3 tries"), "{}", stderr(&output));
}

#[test]
fn a_device_is_led_up_an_aorta() {
    let here = super::folder("steer aorta");
    assert_status(&super::mcm(&here, &["init", "--vessel", "aorta", "--out", "scene.toml"]), 0);
    let scene = std::fs::read_to_string(here.join("scene.toml")).unwrap();
    let goal = scene
        .replace("position_mm = [0.0, -120.0, 20.0]", "position_mm = [0.0, -120.0, 60.0]")
        .replace("\ninsertion_mm = 0.0", "\ninsertion_mm = 40.0");
    std::fs::write(here.join("goal.toml"), goal).unwrap();
    let moves = "magnet.position,magnet.orientation,feed.insertion";
    let arguments = ["steer", "scene.toml", "--to", "goal.toml", "--move", moves, "--out", "way.csv"];
    let output = super::mcm(&here, &arguments);
    assert_status(&output, 0);
    assert!(stdout(&output).starts_with("the straight way leads there"), "{}", stdout(&output));
    let rows = table(&here.join("way.csv"));
    assert!(rows.iter().all(|row| row["snaps"] == "0"));
    let last = rows.last().unwrap();
    assert!((number(last, "feed.insertion_mm") - 40.0).abs() < 1e-6);
    assert!(number(last, "tip_z_mm") > 80.0 && number(last, "contact_count") >= 0.0, "{last:?}");
}

#[test]
fn bad_questions_are_refused() {
    let steer = |more: &[&str]| {
        let (_, output) = with_scene("steer bad", SCENE, &[&["steer", "scene.toml"], more].concat());
        assert_status(&output, 1);
        stderr(&output)
    };
    assert!(steer(&["--move", "magnet.position"]).contains("--tip-angle-deg"));
    assert!(steer(&["--tip-angle-deg", "10"]).contains("--move"));
    assert!(
        steer(&["--tip-angle-deg", "10", "--move", "coil.current"])
            .contains("`coil.current` cannot be moved: the scene has no coil")
    );
    assert!(steer(&["--tip-angle-deg", "10", "--move", "feed.insertion"]).contains("the scene has no shaft"));
    assert!(
        steer(&["--tip-position-mm", "1,2", "--move", "magnet.position"])
            .contains("2 numbers instead of three")
    );
    assert!(steer(&["--tip-angle-deg", "nan", "--move", "magnet.position"]).contains("from 0 to pi"));
    assert!(
        steer(&["--tip-angle-deg", "10", "--move", "magnet.position", "--box-mm", "1,2"])
            .contains("expected six")
    );
    let away = ["--tip-angle-deg", "10", "--move", "magnet.position", "--keep-away-mm", "500"];
    assert!(
        steer(&away).contains("already exceed a limit: the magnet is as near to the device as it may be")
    );
}

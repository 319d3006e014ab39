//! `mcm sweep`.

use super::{assert_status, mcm, stderr, stdout, table, with_scene};
use crate::tolerance::{ROUNDING, SAME_SHAPE, TWO_DECIMALS_DEG};

const SCENE: &str = "[design]\nsegments = 1\n[model]\ninteraction = \"none\"\n";

#[test]
fn first_key_is_followed_for_every_other() {
    let arguments = [
        "sweep",
        "scene.toml",
        "--vary",
        "field.uniform_mt[2]=0:20:5",
        "--vary",
        "design.helix.length_mm=3.5:4.0:2",
        "--out",
        "sweep.csv",
    ];
    let (here, output) = with_scene("sweep", SCENE, &arguments);
    assert_status(&output, 0);
    assert_eq!(stderr(&output), "", "no progress bar without a terminal");
    let rows = table(&here.join("sweep.csv"));
    assert_eq!(rows.len(), 10);
    let number = |row: usize, key: &str| rows[row][key].parse::<f64>().unwrap();
    for (row, cells) in rows.iter().enumerate() {
        let expected = 5.0 * (row % 5) as f64;
        assert!((number(row, "field.uniform_mt[2]") - expected).abs() <= ROUNDING * 20.0);
        assert_eq!(cells["converged"], "true");
        assert_eq!(cells["stable"], "true");
        assert_eq!(cells["snaps"], "0");
        assert_eq!([&cells["stability"], &cells["outcome"], &cells["progress"]], ["stable", "solved", "1.0"]);
    }
    assert!((number(9, "design.helix.length_mm") - 4.0).abs() <= ROUNDING * 4.0);
    assert!(number(0, "alpha_deg").to_radians().abs() <= SAME_SHAPE);
    assert!((number(9, "alpha_deg") - 30.50).abs() < TWO_DECIMALS_DEG);
    assert!(number(1, "alpha_deg") < number(2, "alpha_deg"));
    assert!(number(9, "tip_y_mm") > 0.0 && number(9, "base_reaction_moment_x_nm") > 0.0);
}

#[test]
fn bad_ranges_are_refused() {
    for (vary, expected) in [
        ("field.uniform_mt[2]", "not of the form"),
        ("field.uniform_mt[2]=0:1", "not of the form"),
        ("field.uniform_mt[2]=0:x:2", "\"x\" is not a finite number"),
        ("field.uniform_mt[2]=0:1:0", "COUNT = 0"),
        ("field.unifrom_mt[2]=0:1:2", "did you mean `uniform_mt`?"),
        ("field.uniform_mt[4]=0:1:2", "indices go from 1 to 3"),
        ("design.helix.windings=-1:1:2", "windings"),
    ] {
        let arguments = ["sweep", "scene.toml", "--vary", vary, "--out", "sweep.csv"];
        let (here, output) = with_scene("ranges", SCENE, &arguments);
        assert_status(&output, 1);
        assert!(stderr(&output).contains(expected), "{vary}: {}", stderr(&output));
        assert!(!here.join("sweep.csv").exists(), "nothing is written for bad input");
    }
}

/// Two folds on the way forth, and back.
const FOLDING: &str =
    "[design]\nsegments = 2\n[field]\nuniform_mt = [0, 15, 0]\n[model]\ninteraction = \"rings\"\n";

const ASKED: [&str; 9] = [
    "sweep",
    "scene.toml",
    "--vary",
    "field.turn_deg=0:170:18",
    "--vary",
    "design.helix.length_mm=3.8:4.2:3",
    "--back",
    "--folds",
    "folds.csv",
];

fn asked<'a>(more: &[&'a str]) -> Vec<&'a str> {
    [&ASKED[..], more].concat()
}

#[test]
fn a_sweep_that_was_cut_short_ends_with_the_same_table() {
    let (here, output) = with_scene("resume", FOLDING, &asked(&["--out", "whole.csv"]));
    let said = stdout(&output).replace("whole.csv", "cut.csv");
    assert!(!here.join("whole.csv.part").exists());
    let read = |name: &str| std::fs::read(here.join(name)).unwrap();
    let (whole, folds) = (read("whole.csv"), read("folds.csv"));
    // Stopped early, later, and in the middle of a line; then by a crash of the writer.
    let resumed = asked(&["--out", "cut.csv", "--resume"]);
    let part = here.join("cut.csv.part");
    let mut cut = 0;
    for (number, rows) in [5, 30, 60].into_iter().enumerate() {
        let first = if number == 0 { asked(&["--out", "cut.csv"]) } else { resumed.clone() };
        let mut child = super::start(&here, &first);
        super::wait_for(|| rows_in(&part) >= rows || child.try_wait().unwrap().is_some());
        super::interrupt(&child, number == 1);
        let ended = child.wait_with_output().unwrap();
        if ended.status.success() || ended.status.code() == Some(2) {
            break; // it was faster
        }
        cut += 1;
        assert!(!here.join("cut.csv").exists(), "nothing half written");
        if number != 1 {
            assert_status(&ended, 130);
            assert!(
                stderr(&ended).contains("stopped; the rows so far are in cut.csv.part, and --resume goes on"),
                "{}",
                stderr(&ended)
            );
        }
        assert!(rows_in(&part) >= rows, "finished rows are kept");
        let again = mcm(&here, &asked(&["--out", "cut.csv"]));
        assert_status(&again, 1);
        assert!(stderr(&again).contains("go on with --resume, or delete it"), "{}", stderr(&again));
        let other =
            ["sweep", "scene.toml", "--vary", "field.turn_deg=0:170:19", "--out", "cut.csv", "--resume"];
        assert!(stderr(&mcm(&here, &other)).contains("is of another sweep"));
        let text = std::fs::read_to_string(&part).unwrap();
        std::fs::write(&part, format!("{text}12,3.0,4")).unwrap();
    }
    assert!(cut > 0, "never caught");
    if part.exists() {
        let last = mcm(&here, &resumed);
        assert_eq!(last.status.code(), output.status.code(), "{}", stderr(&last));
        assert_eq!(stdout(&last), said);
    }
    assert_eq!(read("cut.csv"), whole);
    assert_eq!(read("folds.csv"), folds);
    assert!(!part.exists(), "nothing is left beside the table");
}

/// Number of rows in the file of an unfinished sweep.
fn rows_in(part: &std::path::Path) -> usize {
    let text = std::fs::read_to_string(part).unwrap_or_default();
    text.lines().filter(|line| line.starts_with(|first: char| first.is_ascii_digit())).count()
}

#[test]
fn there_may_be_nothing_to_resume() {
    let arguments =
        ["sweep", "scene.toml", "--vary", "field.uniform_mt[2]=0:1:2", "--out", "a.csv", "--resume"];
    let (here, output) = with_scene("nothing to resume", SCENE, &arguments);
    assert_status(&output, 0);
    assert!(stderr(&output).contains("no unfinished sweep a.csv.part"), "{}", stderr(&output));
    assert_eq!(table(&here.join("a.csv")).len(), 2);
}

#[test]
fn a_table_of_devices_goes_on_row_by_row() {
    let vary = |out| ["sweep", "scene.toml", "--vary", "design.helix.length_mm=3.5:4.5:5", "--out", out];
    let (here, output) = with_scene("devices", SCENE, &vary("whole.csv"));
    assert_status(&output, 0);
    let whole = std::fs::read_to_string(here.join("whole.csv")).unwrap();
    // What a sweep that was cut off after three rows has left.
    assert_status(&mcm(&here, &[&vary("cut.csv")[..], &["--resume"]].concat()), 0);
    std::fs::remove_file(here.join("cut.csv")).unwrap();
    let mut child = super::start(&here, &vary("cut.csv"));
    let part = here.join("cut.csv.part");
    super::wait_for(|| rows_in(&part) >= 1 || child.try_wait().unwrap().is_some());
    super::interrupt(&child, true);
    child.wait().unwrap();
    if !here.join("cut.csv").exists() {
        assert_status(&mcm(&here, &[&vary("cut.csv")[..], &["--resume"]].concat()), 0);
    }
    assert_eq!(std::fs::read_to_string(here.join("cut.csv")).unwrap(), whole);
}

#[test]
fn what_cannot_be_swept_is_said_before_the_first_solve() {
    let field = "field.uniform_mt[2]=0:1:2";
    for (arguments, expected) in [
        (
            &["--vary", field, "--vary", field, "--out", "a.csv"][..],
            "--vary field.uniform_mt[2] occurs twice",
        ),
        (
            &[
                "--vary",
                "field.turn_deg=0:1:1000000",
                "--vary",
                "field.uniform_mt[2]=0:1:1000000",
                "--out",
                "a.csv",
            ],
            "1000000 x 1000000 rows are too many: at most 1000000",
        ),
        (&["--vary", "field.turn_deg=0:1e6:2", "--out", "a.csv"], "field.turn_deg = 1000000 is not allowed"),
        (&["--vary", "magnet.turn_deg=0:1:2", "--out", "a.csv"], "this scene has no table [magnet]"),
        (
            &["--vary", field, "--out", "a.csv", "--folds", "a.csv.part"],
            "a.csv.part and a.csv.part would be the same file",
        ),
        (
            &["--vary", field, "--out", "a.csv", "--folds", "./a.csv"],
            "a.csv and ./a.csv would be the same file",
        ),
        (&["--vary", field, "--out", "other.toml"], "other.toml is called like a scene"),
        (&["--vary", field, "--out", "no/a.csv"], "cannot write no/a.csv: there is no folder no"),
        (&["--vary", field, "--out", "."], "cannot write .: it is a folder"),
        (&["--vary", field, "--out", "a.csv", "--folds", "no/f.csv"], "cannot write no/f.csv"),
    ] {
        let (here, output) =
            with_scene("refused sweeps", SCENE, &[&["sweep", "scene.toml"], arguments].concat());
        assert_status(&output, 1);
        assert!(stderr(&output).contains(expected), "{arguments:?}: {}", stderr(&output));
        let names: Vec<_> =
            std::fs::read_dir(&here).unwrap().map(|entry| entry.unwrap().file_name()).collect();
        assert_eq!(names, ["scene.toml"], "{arguments:?}: nothing is left");
    }
}

#[test]
#[cfg(target_os = "linux")]
fn a_full_disk_keeps_what_was_there() {
    let arguments = ["sweep", "scene.toml", "--vary", "field.uniform_mt[2]=0:1:2", "--out", "/dev/full"];
    let (_, output) = with_scene("full", SCENE, &arguments);
    assert_status(&output, 1);
    assert!(
        stderr(&output).contains("cannot write /dev/full: No space left on device"),
        "{}",
        stderr(&output)
    );
}

#[test]
fn the_spiral_of_one_segment_is_turned() {
    const SCENE: &str = "[design]\nsegments = 2\n[model]\ninteraction = \"full\"\n";
    let arguments =
        ["sweep", "scene.toml", "--vary", "design.spiral_start_deg[2]=0:180:3", "--out", "sweep.csv"];
    let (here, output) = with_scene("spirals", SCENE, &arguments);
    assert_status(&output, 0);
    let rows = table(&here.join("sweep.csv"));
    let angle = |row: usize| rows[row]["alpha_deg"].parse::<f64>().unwrap();
    assert!((angle(0) - 2.11).abs() <= TWO_DECIMALS_DEG && (angle(2) - 0.07).abs() <= TWO_DECIMALS_DEG);
    assert!(angle(0) > angle(1) && angle(1) > angle(2));
}

#[test]
fn a_file_in_the_way_of_the_rows_is_not_taken_for_a_sweep() {
    let arguments = ["sweep", "scene.toml", "--vary", "field.uniform_mt[2]=0:1:2", "--out", "a.csv"];
    let (here, _) = with_scene("in the way", SCENE, &["--version"]);
    for notes in [&b"my notes"[..], b"# mcm 0.0.0 sweep 01234567, unfinished\nrow\n", b"# mcm \xff\xfe"] {
        std::fs::write(here.join("a.csv.part"), notes).unwrap();
        for resume in [&[][..], &["--resume"]] {
            let output = mcm(&here, &[&arguments, resume].concat());
            assert_status(&output, 1);
            assert!(stderr(&output).contains("a.csv.part"), "{}", stderr(&output));
            assert_eq!(std::fs::read(here.join("a.csv.part")).unwrap(), notes, "kept");
        }
    }
    std::fs::write(here.join("a.csv.part"), "").unwrap();
    let file = std::fs::File::open(here.join("a.csv.part")).unwrap();
    file.lock().unwrap();
    let output = mcm(&here, &arguments);
    assert!(stderr(&output).contains("is being written by another sweep"), "{}", stderr(&output));
    drop(file);
    assert_status(&mcm(&here, &arguments), 0);
}

#[test]
fn what_the_level_auto_leaves_open_is_no_hysteresis() {
    let scene = "[design]\nsegments = 3\n[magnet]\nposition_mm = [0.0, -120.0, 23.0]\n";
    let arguments =
        ["sweep", "scene.toml", "--vary", "magnet.position_mm[3]=-60:60:61", "--back", "--out", "a.csv"];
    let (here, output) = with_scene("auto and back", scene, &arguments);
    assert_status(&output, 0);
    assert!(stdout(&output).contains("no hysteresis"), "{}", stdout(&output));
    let rows = table(&here.join("a.csv"));
    assert!(rows.iter().all(|row| ["none", "rings", "full"].contains(&row["interaction"].as_str())));
}

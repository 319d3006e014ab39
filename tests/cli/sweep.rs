//! `mcm sweep`.

use super::{assert_status, stderr, table, with_scene};
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

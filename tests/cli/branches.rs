//! `mcm sweep` past folds and back.

use std::collections::HashMap;
use std::path::Path;

use super::{assert_status, stderr, table, with_scene};
use crate::equilibrium::rows::{list, row};
use crate::rod::table::Chain;
use crate::tolerance::{
    COLLAPSE_MT, ELASTICA, FOLD_ANGLE_DEG, LOCATED, LOCATED_AGAIN, PREDICTED, TWO_DECIMALS_DEG,
};

type Rows = Vec<HashMap<String, String>>;

/// A sweep's rows, its folds, and what it says.
struct Sweep {
    rows: Rows,
    folds: Rows,
    said: String,
}

fn sweep(test: &str, scene: &str, vary: &str, back: bool, status: i32) -> Sweep {
    let mut arguments =
        vec!["sweep", "scene.toml", "--vary", vary, "--out", "sweep.csv", "--folds", "folds.csv"];
    if back {
        arguments.push("--back");
    }
    // What is found must not depend on how fast this machine is.
    let unhurried = format!("{scene}\ntime_budget_s = 60\n");
    let (here, output) = with_scene(test, &unhurried, &arguments);
    assert_status(&output, status);
    let said = String::from_utf8(output.stdout.clone()).unwrap() + &stderr(&output);
    let read = |name: &str| table(Path::new(&here.join(name)));
    Sweep { rows: read("sweep.csv"), folds: read("folds.csv"), said }
}

fn number(cells: &HashMap<String, String>, key: &str) -> f64 {
    cells[key].parse().unwrap_or_else(|_| panic!("{key} = {:?} is not a number", cells[key]))
}

/// A dipole at the end of one core bends it to an arc: `theta = Lam sin(phi - theta)`. In the plane the arc folds at
/// `phi = theta + acos(-1/Lam)`, 195.9 degrees (see `rod/magnetic.rs`), but a round core bends in every plane alike: past
/// half a circle the arc on the other side is lower, and turns about the base's axis cost nothing. So the branch is left
/// at 180 degrees, on both ways, and the shape after is the mirror image of that before.
#[test]
fn the_turned_tip_dipole_swings_over_at_half_a_circle_both_ways() {
    const LAM: f64 = 1.5;
    let scene = format!(
        "[design]\nsegments = 1\nbase_magnet = false\n[design.helix]\nparticle_remanence_t = 0\n\
         [field]\nuniform_mt = [0, 0, {}]\n[model]\ninteraction = \"none\"\n",
        1e3 * LAM * Chain::new(1).unit_field
    );
    let Sweep { rows, folds, said } = sweep("dipole", &scene, "field.turn_deg=0:240:25", true, 0);
    assert_eq!(rows.len(), 49, "the last value is not repeated");
    for row in &rows {
        // The field's angle from the axis on the side to which it points.
        let (theta, turn) = (number(row, "alpha_deg").to_radians(), number(row, "field.turn_deg"));
        let phi = if turn > 180.0 { 360.0 - turn } else { turn }.to_radians();
        assert!((theta - LAM * (phi - theta).sin()).abs() <= ELASTICA, "{turn} deg: {theta} rad");
    }
    assert_eq!(folds.len(), 2, "{said}");
    // The arc that the field antiparallel to the base holds, by bisection.
    let (mut low, mut high) = (0.5, 3.0);
    while high - low > 1e-12 {
        let middle: f64 = 0.5 * (low + high);
        if LAM * middle.sin() > middle { low = middle } else { high = middle }
    }
    for (fold, way) in folds.iter().zip(["forth", "back"]) {
        assert_eq!((fold["way"].as_str(), fold["branch"].as_str()), (way, "snap"));
        let value = number(fold, "field.turn_deg");
        assert!((value - 180.0).abs() <= LOCATED * 240.0, "{way}: {value} deg");
        assert!(number(fold, "stability_margin_before").abs() < 1e-6, "{fold:?}");
        assert!((number(fold, "alpha_before_deg") - low.to_degrees()).abs() < TWO_DECIMALS_DEG, "{fold:?}");
    }
    let snaps: Vec<u32> = [0, 24, 48].iter().map(|&i: &usize| rows[i]["snaps"].parse().unwrap()).collect();
    assert_eq!(snaps, [0, 1, 2]);
}

/// Nine segments, and the paper's pair of magnets passing by with its field against them.
const PASSING: &str = "[design]\nsegments = 9\n[magnet]\nposition_mm = [0, -120, 0]\nturn_deg = 180\n\
                       [model]\ninteraction = \"none\"\n";

#[test]
fn a_passing_magnet_is_followed_with_hysteresis_however_fine_the_steps() {
    const RANGE: f64 = 150.0;
    const KEY: &str = "magnet.position_mm[3]";
    let run = |count: u32| {
        let found = sweep("passing", PASSING, &format!("{KEY}=-80:70:{count}"), true, 0);
        assert_eq!(found.folds.len(), 2, "{}", found.said);
        assert!(found.said.contains("hysteresis: the way back differs from"), "{}", found.said);
        found
    };
    let (coarse, fine) = (run(16), run(61));
    for (a, b) in coarse.folds.iter().zip(&fine.folds) {
        let (a, b) = (number(a, KEY), number(b, KEY));
        assert!((a - b).abs() <= LOCATED_AGAIN * RANGE, "folds at {a} and {b} mm by other steps");
    }
    let [forth, back] = [0, 1].map(|i| number(&fine.folds[i], KEY));
    assert!(forth - back > 10.0, "no hysteresis: {forth}, {back} mm");
    // The two ways are one shape outside the loop, two inside.
    let by_way = |way| fine.rows.iter().filter(move |row| row["way"] == way);
    let mut inside = 0;
    for there in by_way("forth") {
        let value = number(there, KEY);
        let Some(here) = by_way("back").find(|row| row[KEY] == there[KEY]) else { continue };
        let difference = (number(there, "alpha_deg") - number(here, "alpha_deg")).abs();
        let in_loop = value > back && value < forth;
        assert_eq!(difference > 1.0, in_loop, "{value} mm: {difference} deg between the ways");
        inside += u32::from(in_loop);
    }
    assert!(inside >= 4, "{inside} values in the loop");
}

#[test]
fn where_a_branch_ends_the_rows_say_so_and_the_fold_is_seen_coming() {
    let scene = "[design]\nsegments = 1\n[model]\ninteraction = \"full\"";
    let Sweep { rows, folds, said } = sweep("end", scene, "field.uniform_mt[2]=0:40:21", false, 2);
    assert!(said.contains("the branch ends: ") && said.contains("3 of 21 rows did not converge"), "{said}");
    assert_eq!(folds.len(), 1, "{said}");
    let fold = &folds[0];
    assert_eq!((fold["branch"].as_str(), fold["alpha_after_deg"].as_str()), ("end", ""));
    let value = number(fold, "field.uniform_mt[2]");
    // The fold of the converged model, by continuation.
    assert!((value - 35.833).abs() <= COLLAPSE_MT, "{value} mT");
    for row in &rows {
        let converged = number(row, "field.uniform_mt[2]") < value;
        assert_eq!(row["converged"] == "true", converged);
        assert_eq!(row["outcome"] == "solved", converged);
        for key in ["alpha_deg", "magnetic_force_y_n", "energy_j", "stable", "stability", "stability_margin"]
        {
            assert_eq!(row[key].is_empty(), !converged, "{key}: a row without a shape shows none");
        }
        assert!(number(row, "progress") <= 1.0 && (number(row, "progress") < 1.0) != converged);
    }
    let error = |field: f64| {
        let row = &rows[(field / 2.0).round() as usize];
        (number(row, "predicted_fold") - value).abs() / (value - field)
    };
    assert!(error(34.0) <= PREDICTED, "{}", error(34.0));
    assert_eq!(rows[2]["predicted_fold"], "", "far from the fold there is nothing to predict");
}

#[test]
fn a_turned_field_loses_three_segments_where_the_reference_does() {
    let scene = "[design]\nsegments = 3\n[field]\nuniform_mt = [0, 0, 20]\n[model]\ninteraction = \"rings\"";
    let Sweep { rows, folds, said } = sweep("turned", scene, "field.turn_deg=0:170:18", true, 2);
    let expected = list(&row("c2_S3_rings_B20_th170").outputs["fold_theta_deg"]);
    assert_eq!(folds.len(), 1, "{said}");
    let value = number(&folds[0], "field.turn_deg");
    assert!((value - expected[0]).abs() < FOLD_ANGLE_DEG, "lost at {value} deg, expected {expected:?}");
    assert!(said.contains("the way back starts at the last shape"), "{said}");
    // The way back finds the branch again before the fold.
    for (there, back) in rows.iter().zip(rows.iter().rev()).take(18) {
        assert_eq!(there["converged"], back["converged"]);
        if there["converged"] == "false" {
            continue;
        }
        let difference = (number(there, "alpha_deg") - number(back, "alpha_deg")).abs();
        assert!(difference < TWO_DECIMALS_DEG, "{difference} deg at {}", there["field.turn_deg"]);
    }
}

#[test]
fn a_way_back_over_other_devices_is_refused() {
    let arguments =
        ["sweep", "scene.toml", "--vary", "design.helix.length_mm=3:5:3", "--back", "--out", "sweep.csv"];
    let (here, output) = with_scene("devices", "", &arguments);
    assert_status(&output, 1);
    assert!(
        stderr(&output).contains("--back does not apply to design.helix.length_mm"),
        "{}",
        stderr(&output)
    );
    assert!(!here.join("sweep.csv").exists());
}

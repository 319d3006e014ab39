//! `mcm solve`.

use serde_json::Value;

use super::{assert_status, stderr, with_scene};
use crate::tolerance::TWO_DECIMALS_DEG;

const ONE_SEGMENT: &str = "[design]\nsegments = 1\n[model]\ninteraction = \"none\"\n";

fn json(test: &str, scene: &str, status: i32) -> Value {
    let (_, output) = with_scene(test, scene, &["solve", "scene.toml", "--json"]);
    assert_status(&output, status);
    serde_json::from_slice(&output.stdout).unwrap()
}

#[test]
fn json_has_the_promised_keys() {
    let answer = json("keys", &format!("{ONE_SEGMENT}[field]\nuniform_mt = [0, 20, 0]"), 0);
    let promised = [
        "alpha_rad",
        "tip_position_m",
        "tip_orientation_wxyz",
        "magnetic_force_n",
        "magnetic_torque_nm",
        "base_reaction_force_n",
        "base_reaction_moment_nm",
        "magnet_reaction_force_n",
        "magnet_reaction_torque_nm",
        "ring_positions_m",
        "core_angles_rad",
        "shape_m",
        "stable",
        "stability_margin",
        "snaps",
        "converged",
        "iterations",
        "residual",
        "energy_j",
        "interaction",
        "method",
    ];
    let keys: Vec<&String> = answer.as_object().unwrap().keys().collect();
    assert_eq!(keys.len(), promised.len());
    for key in promised {
        assert!(!answer[key].is_null(), "{key}");
    }
    assert_eq!(answer["interaction"], "none");
    assert_eq!(answer["method"], "potential");
    assert_eq!(answer["ring_positions_m"].as_array().unwrap().len(), 2);
    assert_eq!(answer["shape_m"].as_array().unwrap().len(), 101);
    // 30.50 deg: S = 1 in 20 mT without interaction, from two independent models.
    let alpha = answer["alpha_rad"].as_f64().unwrap().to_degrees();
    assert!((alpha - 30.50).abs() < TWO_DECIMALS_DEG, "{alpha}");
}

#[test]
fn table_is_for_people() {
    let (_, output) = with_scene("table", ONE_SEGMENT, &["solve", "scene.toml"]);
    assert_status(&output, 0);
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(text.starts_with("solved; stable;"), "{text}");
    assert!(text.contains("tip angle") && text.contains("deg") && text.contains("mN.mm"), "{text}");
}

#[test]
fn model_without_potential_has_no_verdict() {
    let scene =
        "[design]\nsegments = 2\n[model]\ninteraction = \"preceding\"\n[field]\nuniform_mt = [0, 10, 0]";
    assert!(json("preceding", scene, 0)["stable"].is_null());
}

#[test]
fn bad_numbers_are_refused_with_quantity_and_range() {
    for (scene, expected) in [
        ("[field]\nuniform_mt = [0, nan, 0]", "field.uniform_mt[2] = NaN"),
        ("[design.helix]\nwindings = 0", "windings"),
        ("[design.helix]\npoisson = 0.7", "Poisson"),
        ("[magnet]\ncylinders = []", "magnet"),
    ] {
        let (_, output) = with_scene("numbers", scene, &["solve", "scene.toml"]);
        assert_status(&output, 1);
        assert!(stderr(&output).contains(expected), "{scene}: {}", stderr(&output));
    }
    let (_, output) = with_scene("points", ONE_SEGMENT, &["solve", "scene.toml", "--shape-points", "1"]);
    assert_status(&output, 1);
}

#[test]
fn scene_of_the_readme_is_solved() {
    let readme = include_str!("../../README.md");
    let scene = readme.split("```toml\n").nth(1).unwrap().split("```").next().unwrap();
    let answer = json("readme", scene, 0);
    assert_eq!(answer["ring_positions_m"].as_array().unwrap().len(), 4);
    assert_eq!(answer["stable"], true);
}

#[test]
fn past_the_last_fold_the_last_good_shape_is_printed_with_status_2() {
    // The attraction of rings and helix pulls one segment shut at 35.86 mT: there is no shape at 60 mT.
    let scene = "[design]\nsegments = 1\n[model]\ninteraction = \"full\"\n[field]\nuniform_mt = [0, 60, 0]";
    let answer = json("shut", scene, 2);
    assert_eq!(answer["converged"], false);
    let (_, output) = with_scene("shut", scene, &["solve", "scene.toml"]);
    assert!(stderr(&output).contains("not converged"), "{}", stderr(&output));
}

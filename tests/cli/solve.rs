//! `mcm solve`.

use mcm::equilibrium::{Equilibrium, Inputs};
use mcm::manipulator::Scene;
use mcm::methods::Method;
use nalgebra::Vector3;
use serde_json::Value;

use super::{assert_status, stderr, stdout, with_scene};
use crate::equilibrium::critical::{is_stable, last_true};
use crate::tolerance::{
    DIFFERENCE, METHOD_ARCS, METHOD_COARSE, NEUTRAL_SHAPE, TWO_DECIMALS_DEG, assert_close,
};

const ONE_SEGMENT: &str = "[design]\nsegments = 1\n[model]\ninteraction = \"none\"\n";

fn json(test: &str, scene: &str, status: i32) -> Value {
    let (_, output) = with_scene(test, scene, &["solve", "scene.toml", "--json"]);
    assert_status(&output, status);
    serde_json::from_slice(&output.stdout).unwrap()
}

#[test]
fn the_method_is_that_of_the_scene() {
    let text = |method: &str| {
        format!(
            "[field]\nuniform_mt = [0, 20, 0]\n[design]\nsegments = 1\n[model]\ninteraction = \"none\"\n{method}"
        )
    };
    let reference = json("potential", &text(""), 0);
    for (method, name) in &Method::ALL[1..] {
        let answer = json(name, &text(&format!("method = \"{name}\"")), 0);
        assert_eq!(answer["method"], *name);
        assert!(answer["stable"].is_null() && answer["jacobian"].is_null());
        assert!(answer["jacobian_note"].as_str().unwrap().contains("no derivatives"));
        let tolerance = if *method == Method::ConstantCurvature { METHOD_ARCS } else { METHOD_COARSE };
        let angle = |answer: &Value| [answer["alpha_rad"].as_f64().unwrap()];
        assert_close(name, &angle(&answer), &angle(&reference), tolerance);
    }
    let (_, output) = with_scene("refused method", &text("method = \"shoting\""), &["solve", "scene.toml"]);
    assert_status(&output, 1);
    assert!(stderr(&output).contains("choose one of potential, shooting-fd"), "{}", stderr(&output));
}

#[test]
fn an_fmu_solves_by_the_potential_method_alone() {
    let (_, output) = with_scene(
        "packed method",
        "[model]\nmethod = \"planar\"",
        &["pack", "--scene", "scene.toml", "--out", "x.fmu"],
    );
    assert_status(&output, 1);
    assert!(stderr(&output).contains("method \"potential\", not \"planar\""), "{}", stderr(&output));
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
        "further_reaction_forces_n",
        "further_reaction_torques_nm",
        "ring_positions_m",
        "core_angles_rad",
        "shape_arc_lengths_m",
        "shape_m",
        "shape_tangents",
        "shape_curvatures_per_m",
        "stable",
        "stability_margin",
        "snaps",
        "converged",
        "iterations",
        "residual",
        "energy_j",
        "interaction",
        "error_estimate_m",
        "method",
        "jacobian",
        "status",
        "outcome",
        "progress",
        "stability",
    ];
    let keys: Vec<&String> = answer.as_object().unwrap().keys().collect();
    let of_vessels = [
        "contact_force_n",
        "contact_count",
        "largest_contact_force_n",
        "largest_indentation_m",
        "ring_contact_forces_n",
        "contact_places_m",
        "contact_forces_n",
        "feed_length_m",
        "feed_reaction_force_n",
    ];
    assert_eq!(keys.len(), promised.len() + 2 + of_vessels.len());
    for key in of_vessels {
        assert!(answer[key].is_null(), "{key} without a vessel");
    }
    for key in ["jacobian_note", "reason"] {
        assert!(answer[key].is_null(), "{key} where there is nothing to say");
    }
    let verdict = ["status", "outcome", "stability"].map(|key| answer[key].as_str().unwrap());
    assert_eq!(verdict, ["solved", "solved", "stable"]);
    assert_eq!(answer["progress"], 1.0);
    for key in promised {
        assert!(!answer[key].is_null(), "{key}");
    }
    assert_eq!(answer["interaction"], "none");
    assert_eq!(answer["method"], "potential");
    assert_eq!(answer["ring_positions_m"].as_array().unwrap().len(), 2);
    for key in ["shape_m", "shape_tangents", "shape_curvatures_per_m"] {
        let points = answer[key].as_array().unwrap();
        assert_eq!((points.len(), points[50].as_array().unwrap().len()), (101, 3), "{key}");
    }
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
fn model_without_potential_is_assessed_by_its_whole_matrix() {
    let scene =
        "[design]\nsegments = 2\n[model]\ninteraction = \"preceding\"\n[field]\nuniform_mt = [0, 10, 0]";
    let answer = json("preceding", scene, 0);
    assert_eq!(answer["stable"], true);
    assert_eq!(answer["stability"], "stable");
}

#[test]
fn bad_numbers_are_refused_with_quantity_and_range() {
    for (scene, expected) in [
        ("[field]\nuniform_mt = [0, nan, 0]", "field.uniform_mt[2] = NaN"),
        ("[design.helix]\nwindings = 0", "design.helix.windings = 0"),
        ("[design.helix]\npoisson = 0.7", "design.helix.poisson = 0.7"),
        ("[magnet]\ncylinders = []", "line 2: magnet.cylinders: "),
    ] {
        let (_, output) = with_scene("numbers", scene, &["solve", "scene.toml"]);
        assert_status(&output, 1);
        assert!(stderr(&output).contains(expected), "{scene}: {}", stderr(&output));
    }
    let (_, output) = with_scene("points", ONE_SEGMENT, &["solve", "scene.toml", "--shape-points", "1"]);
    assert_status(&output, 1);
}

#[test]
fn past_the_last_fold_no_shape_is_shown_but_why() {
    // The attraction of rings and helix pulls one segment shut at 35.83 mT: there is no shape at 60 mT.
    let scene = "[design]\nsegments = 1\n[model]\ninteraction = \"full\"\n[field]\nuniform_mt = [0, 60, 0]";
    let answer = json("shut", scene, 2);
    assert_eq!(answer["converged"], false);
    assert_eq!(answer["status"], "not_converged");
    assert_eq!(answer["jacobian_note"], "no derivatives: the last inputs are not solved");
    let progress = answer["progress"].as_f64().unwrap();
    assert!((0.0..1.0).contains(&progress), "{progress}");
    assert_ne!(answer["outcome"], "solved");
    assert!(answer["reason"].as_str().unwrap().contains(if answer["outcome"] == "contact" {
        "touch"
    } else {
        "ends"
    }));
    let told = [
        "converged",
        "status",
        "outcome",
        "reason",
        "progress",
        "iterations",
        "residual",
        "interaction",
        "method",
        "jacobian_note",
    ];
    for (key, value) in answer.as_object().unwrap() {
        assert_eq!(value.is_null(), !told.contains(&key.as_str()), "{key}: {value}");
    }
    let (_, output) = with_scene("shut", scene, &["solve", "scene.toml"]);
    assert!(stderr(&output).contains("not converged") && stderr(&output).contains("% of the way"));
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(text.starts_with("not converged;") && text.contains("progress"), "{text}");
    for word in ["stable", "margin", "force", "angle"] {
        assert!(!text.contains(word), "{word} of no shape: {text}");
    }
}

#[test]
fn a_shape_that_may_turn_freely_is_neutral_and_not_unstable() {
    // Turned over in a field against it, three segments may turn about its axis.
    let scene = "[design]\nsegments = 3\n[model]\ninteraction = \"none\"\n[field]\nuniform_mt = [0, 0, -20]";
    let answer = json("neutral", scene, 4);
    assert_eq!(answer["converged"], true);
    assert_eq!(answer["stable"], false);
    assert_eq!(answer["stability"], "neutral");
    assert_eq!(answer["outcome"], "neutral");
    assert!(answer["reason"].as_str().unwrap().contains("neutral"));
    assert!(answer["stability_margin"].as_f64().unwrap().abs() <= NEUTRAL_SHAPE);
    let (_, output) = with_scene("neutral", scene, &["solve", "scene.toml"]);
    assert_status(&output, 4);
    let text = String::from_utf8(output.stdout.clone()).unwrap();
    assert!(text.contains("; neutral: one direction is free;") && !text.contains("unstable"), "{text}");
    assert!(stderr(&output).starts_with("warning: the equilibrium is neutral"), "{}", stderr(&output));
}

#[test]
fn a_time_budget_is_read_and_checked() {
    let scene = |budget: &str| format!("{ONE_SEGMENT}time_budget_s = {budget}\n");
    json("budget", &scene("0.5"), 0);
    for (budget, expected) in [
        ("0", "model.time_budget_s = 0"),
        ("-1", "model.time_budget_s = -1"),
        ("inf", "model.time_budget_s = inf"),
    ] {
        let (_, output) = with_scene("budget", &scene(budget), &["solve", "scene.toml"]);
        assert_status(&output, 1);
        assert!(stderr(&output).contains(expected), "{}", stderr(&output));
    }
    let (_, output) =
        with_scene("budget", &format!("{ONE_SEGMENT}time_budget = 1"), &["solve", "scene.toml"]);
    assert!(stderr(&output).contains("did you mean `time_budget_s`?"), "{}", stderr(&output));
}

#[test]
fn jacobian_is_how_the_tip_moves_with_magnet_and_field() {
    let at = |millimetres: f64, millitesla: f64| {
        let scene = format!(
            "[design]\nsegments = 3\n[model]\ninteraction = \"rings\"\n[magnet]\nposition_mm = [5.0, -110.0, {millimetres:?}]\n[field]\n\
             uniform_mt = [0.0, {millitesla:?}, 0.0]"
        );
        json("jacobian", &scene, 0)
    };
    let position = |answer: &Value| -> Vec<f64> {
        answer["tip_position_m"].as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect()
    };
    let difference = |plus: &Value, minus: &Value, step: f64| -> Vec<f64> {
        position(plus).iter().zip(position(minus)).map(|(a, b)| (a - b) / (2.0 * step)).collect()
    };
    let jacobian = &at(20.0, 1.0)["jacobian"];
    let column = |matrix: &Value, column: usize| -> Vec<f64> {
        (0..3).map(|row| matrix[row][column].as_f64().unwrap()).collect()
    };
    let by_magnet = difference(&at(20.01, 1.0), &at(19.99, 1.0), 1e-5);
    assert_close("magnet", &column(&jacobian["tip_by_magnet"], 2), &by_magnet, DIFFERENCE);
    let by_field = difference(&at(20.0, 1.001), &at(20.0, 0.999), 1e-6);
    assert_close("field", &column(&jacobian["tip_by_uniform_field"], 1), &by_field, DIFFERENCE);
    assert_eq!(jacobian["tip_by_magnet"].as_array().unwrap().len(), 6);
    assert_eq!(jacobian["tip_by_uniform_field"][5].as_array().unwrap().len(), 3);
}

#[test]
fn at_a_fold_there_is_a_note_instead_of_a_jacobian() {
    // Straight in an antiparallel field, a millionth before it turns over.
    let scene = Scene::parse(ONE_SEGMENT, "one segment").unwrap();
    let mut equilibrium = Equilibrium::new(&scene.design().unwrap(), None, scene.settings, 2).unwrap();
    let straight = vec![0.0; equilibrium.freedoms()];
    let field = |size: f64| Inputs { uniform_field: Vector3::new(0.0, 0.0, -size), ..scene.inputs.clone() };
    let critical = last_true(1e-3, 1.0, |size| is_stable(&mut equilibrium, &field(size), &straight));
    let millitesla = -1e3 * critical * (1.0 - 1e-6);
    let answer = json("fold", &format!("{ONE_SEGMENT}[field]\nuniform_mt = [0, 0, {millitesla:?}]"), 0);
    assert_eq!(answer["converged"], true);
    assert!(answer["jacobian"].is_null());
    let note = answer["jacobian_note"].as_str().unwrap();
    assert!(note.starts_with("no derivatives: the shape is at a fold"), "{note}");
}

#[test]
fn a_slow_solve_says_what_it_is_doing_and_a_quick_one_is_silent() {
    // Far from done when its three seconds of processor time are over.
    let slow = "[design]\nsegments = 64\n[field]\nuniform_mt = [0, 20, -5]\n[model]\ninteraction = \"full\"\ntime_budget_s = 3\n";
    let (_, output) = with_scene("slow", slow, &["solve", "scene.toml"]);
    assert_status(&output, 2);
    let said = stderr(&output);
    let expected = "solving at level full, which may take 3 s of processor time (model.time_budget_s) ...\n";
    assert!(said.starts_with(expected), "{said}");
    let (_, output) = with_scene("quick", ONE_SEGMENT, &["solve", "scene.toml"]);
    assert_eq!(stderr(&output), "");
}

/// `mcm solve scene.toml | head -1` ends with the status of the solve.
#[test]
#[cfg(unix)]
fn a_reader_that_goes_early_is_no_bad_input() {
    let rows = "[design]\nsegments = 1\n[field]\nuniform_mt = [0, 5, 0]\n[model]\ninteraction = \"none\"\n";
    let folder = super::folder("closed pipe");
    std::fs::write(folder.join("scene.toml"), rows).unwrap();
    for (arguments, expected) in
        [("solve scene.toml --json --shape-points 20000", "0"), ("--help", "0"), ("study", "1")]
    {
        let line = format!("({} {arguments}; echo $? > status) | true", env!("CARGO_BIN_EXE_mcm"));
        let run = std::process::Command::new("sh").current_dir(&folder).args(["-c", &line]).output().unwrap();
        assert!(!String::from_utf8_lossy(&run.stderr).contains("pipe"), "{arguments}");
        assert_eq!(std::fs::read_to_string(folder.join("status")).unwrap().trim(), expected, "{arguments}");
    }
}

#[test]
fn a_bent_shape_without_load_is_explained() {
    let told = |test: &str, scene: &str| {
        let (_, output) = with_scene(test, scene, &["solve", "scene.toml"]);
        assert_status(&output, 0);
        let lines: Vec<String> = stdout(&output).lines().map(str::to_owned).collect();
        lines.into_iter().filter(|line| line.starts_with("note: ")).collect::<Vec<_>>()
    };
    let notes = told("rest", "[design]\nsegments = 3\n[base]\nturn_deg = 30");
    let [note] = &notes[..] else { panic!("{notes:?}") };
    for part in ["bent at rest", "spirals", "design.spiral_start_deg", "design.spiral = \"alternating\""] {
        assert!(note.contains(part), "{note}");
    }
    for (test, scene) in [
        ("rest loaded", "[design]\nsegments = 3\n[field]\nuniform_mt = [0, 1, 0]"),
        ("rest weight", "[design]\nsegments = 3\n[gravity]\nacceleration_m_s2 = [0, -9.81, 0]"),
        ("rest magnet", "[design]\nsegments = 3\n[magnet]\nposition_mm = [0, -200, 0]"),
        ("rest ring", "[design]\nsegments = 1\n[load]\nring_force_n = [[0, 0, 0], [0, 0.001, 0]]"),
        ("rest short", "[design]\nsegments = 1"),
        ("rest alternating", "[design]\nsegments = 3\nspiral = \"alternating\""),
        ("rest turned", "[design]\nsegments = 3\nspiral_start_deg = [0, 240, 120]"),
    ] {
        assert!(told(test, scene).is_empty(), "{test}");
    }
    // Nothing attracts, but the wall of a bent vessel holds the device bent.
    let bent = "[[vessel.branch]]\nname = \"bent\"\npoints_mm = [[0, 0, -10], [0, 0, 0], [0, 1, 6], [0, 4, 14]]\nradius_mm = 2.2\n";
    for (test, part) in [
        ("rest in a vessel", "[design.ring]\nremanence_t = 0"),
        ("rest alone", "[model]\ninteraction = \"none\""),
    ] {
        let scene = format!("[design]\nsegments = 2\nspiral = \"axisymmetric\"\n{part}\n{bent}");
        let answer = json(test, &scene, 0);
        assert!(answer["alpha_rad"].as_f64().unwrap() > 0.1 && answer["contact_count"].as_u64() > Some(0));
        assert!(told(test, &scene).is_empty(), "{test}");
    }
    let answer = json("rest json", "[design]\nsegments = 3", 0);
    assert!(answer.as_object().unwrap().keys().all(|key| !key.contains("note") || key == "jacobian_note"));
}

#[test]
fn the_wrench_of_sources_on_one_another_is_told_where_it_is_asked_for() {
    let scene = "[design]\nsegments = 1\n[[magnet]]\n[[magnet]]\nposition_mm = [0, 150, 3]\n[model]\ninteraction = \"none\"\n";
    let answer = json("sources", scene, 0);
    assert!(answer["mutual_forces_n"].is_null() && answer["magnet_reaction_force_n"].is_array());
    let asked = format!("{scene}mutual_wrenches = true\n");
    let answer = json("mutual", &asked, 0);
    let force = |number: usize| answer["mutual_forces_n"][number][1].as_f64().unwrap();
    // Side by side and parallel, they repel.
    assert!(force(1) > 0.1 && (force(0) + force(1)).abs() < 1e-12, "{} {}", force(0), force(1));
    assert_eq!(answer["mutual_torques_nm"].as_array().unwrap().len(), 2);
    let (_, output) = with_scene("mutual table", &asked, &["solve", "scene.toml"]);
    assert!(stdout(&output).contains("force on 2 by others"), "{}", stdout(&output));
}

#[test]
fn numbers_that_look_like_those_of_another_unit_are_warned_of() {
    let metres = "[design]\nsegments = 1\n[design.ring]\nlength_mm = 0.001\n[magnet]\nposition_mm = [0, -200, 0]\n\
                  cylinders = [{ radius_mm = 20, length_mm = 30, remanence_t = -14.5 }]\n";
    let (_, output) = with_scene("units", metres, &["solve", "scene.toml", "--json"]);
    assert_status(&output, 0);
    let told = stderr(&output);
    let warned: Vec<&str> = told.lines().filter(|line| line.starts_with("warning: scene.toml: ")).collect();
    assert_eq!(warned.len(), 2, "{told}");
    assert!(
        told.contains("design.ring.length_mm = 0.001: ") && told.contains("if it was meant in m, it is 1 mm")
    );
    assert!(
        told.contains("magnet.cylinders[1].remanence_t = -14.5: ") && told.contains("in kG, it is -1.45 T")
    );
    for grade in ["N35 1.17 to 1.22", "N42 1.28 to 1.32", "N52 1.43 to 1.48"] {
        assert!(told.contains(grade), "{told}");
    }
    let answer: serde_json::Value = serde_json::from_str(&stdout(&output)).unwrap();
    let listed = answer["warnings"].as_array().unwrap();
    assert!(
        listed.iter().zip(&warned).all(|(odd, line)| line.ends_with(odd.as_str().unwrap())),
        "{listed:?}"
    );
    assert!(json("usual units", ONE_SEGMENT, 0)["warnings"].is_null());

    let sweep = |range: &str| {
        let arguments = ["sweep", "scene.toml", "--vary", range, "--out", "out.csv"];
        stderr(&with_scene("swept units", ONE_SEGMENT, &arguments).1)
    };
    let told = sweep("design.ring.remanence_t=1.2:12:2");
    assert!(told.contains("warning: --vary design.ring.remanence_t = 12: no permanent magnet"), "{told}");
    assert!(!sweep("design.ring.remanence_t=1.2:1.3:2").contains("warning"));
}

//! `mcm field`.
#![allow(clippy::float_cmp, reason = "files must carry every bit")]

use mcm::magnetics::AxialSource;
use nalgebra::Vector3;

use super::{assert_status, folder, mcm, stderr, table};
use crate::tolerance::{FIELD, MAXWELL, ROUNDING, assert_close};

fn run(test: &str, scene: &str, points: &str, more: &[&str]) -> (std::path::PathBuf, std::process::Output) {
    let here = folder(test);
    std::fs::write(here.join("scene.toml"), scene).unwrap();
    std::fs::write(here.join("points.csv"), points).unwrap();
    let arguments = [&["field", "scene.toml", "--at", "points.csv", "--out", "field.csv"], more].concat();
    let output = mcm(&here, &arguments);
    (here, output)
}

#[test]
fn ring_field_carries_every_bit() {
    let points = "# a comment\nx_m, y_m, z_m\n1e-3, 2e-3, 3e-3\n-1e-3,0,2.5e-3\n";
    let (here, output) = run("ring", "", points, &["--ring"]);
    assert_status(&output, 0);
    let rows = table(&here.join("field.csv"));
    assert_eq!(rows.len(), 2);
    let ring = AxialSource::new(0.75e-3, 2e-3, 1e-3, 1.35).unwrap();
    let (field, gradient) = ring.field_gradient(&Vector3::new(1e-3, 2e-3, 3e-3)).unwrap();
    let number = |key: &str| rows[0][key].parse::<f64>().unwrap();
    assert_eq!([number("x_m"), number("y_m"), number("z_m")], [1e-3, 2e-3, 3e-3]);
    for (i, row) in ["x", "y", "z"].iter().enumerate() {
        assert_eq!(number(&format!("B{row}_t")), field[i]);
        for (j, column) in ["x", "y", "z"].iter().enumerate() {
            assert_eq!(number(&format!("dB{row}_d{column}_t_per_m")), gradient[(i, j)]);
        }
    }
}

#[test]
fn external_field_adds_up_in_the_world_frame() {
    let scene = "[field]\nuniform_mt = [1, 2, 3]\ngradient_t_per_m = [1, 2, 3, 4, 5]\n\
                 [magnet]\nposition_mm = [0, -120, 0]\norientation_wxyz = [0, 1, 0, 0]\nstrength = 0.5";
    let (here, output) = run("external", scene, "x_m,y_m,z_m\n0,0,0.01\n0,0,-0.01\n", &[]);
    assert_status(&output, 0);
    let rows = table(&here.join("field.csv"));
    let mean = |key: &str| rows.iter().map(|row| row[key].parse::<f64>().unwrap()).sum::<f64>() / 2.0;
    // The linear field is odd in z. Beside the magnet, whose axis points along -z, its field points along +z.
    assert_close("Bx", &[mean("Bx_t")], &[1e-3], ROUNDING);
    assert_close("By", &[mean("By_t")], &[2e-3], FIELD);
    assert!(mean("Bz_t") > 4e-3, "{}", mean("Bz_t"));
    let trace = mean("dBx_dx_t_per_m") + mean("dBy_dy_t_per_m") + mean("dBz_dz_t_per_m");
    assert!(trace.abs() <= MAXWELL, "{trace}");
    for (a, b) in [("dBx_dy", "dBy_dx"), ("dBx_dz", "dBz_dx"), ("dBy_dz", "dBz_dy")] {
        let difference = mean(&format!("{a}_t_per_m")) - mean(&format!("{b}_t_per_m"));
        assert!(difference.abs() <= MAXWELL, "curl {difference}");
    }
}

#[test]
fn bad_points_are_refused_with_their_line() {
    for (points, expected) in [
        ("x_m,y_m,z_m\n0,zero,0.01\n", "points.csv, line 2: y_m = \"zero\" is not a finite number"),
        ("x_m,y_m,z_m\n0,nan,0.01\n", "points.csv, line 2: y_m = \"nan\" is not a finite number"),
        ("x_m,y_m,z_m\n0,0\n", "cannot read points.csv: CSV error"),
        ("x,y,z\n0,0,0.01\n", "points.csv has no column x_m; it has x, y, z"),
        ("x_m,y_m,z_m\n0,0\n", "line: 2"),
    ] {
        let (_, output) = run("bad", "", points, &["--ring"]);
        assert_status(&output, 1);
        assert!(stderr(&output).contains(expected), "{points}: {}", stderr(&output));
    }
    let rod = "[design]\nkind = \"cylinder\"\nlength_mm = 40\nradius_mm = 2";
    let (_, output) = run("no_ring", rod, "x_m,y_m,z_m\n0,0,0\n", &["--ring"]);
    assert_status(&output, 1);
    assert!(stderr(&output).contains("has no ring"));
}

/// The columns of a row after those of its point.
fn cells(row: &std::collections::HashMap<String, String>) -> Vec<&str> {
    row.iter()
        .filter(|(title, _)| title.ends_with("_t") || title.contains("_t_"))
        .map(|(_, cell)| &cell[..])
        .collect()
}

#[test]
fn a_point_on_an_edge_costs_its_own_row_and_is_named_as_the_table_has_it() {
    // The ring lies at the origin: here the frames are one.
    let (here, output) = run("edge", "", "x_m,y_m,z_m\n0,0,0.01\n0.002,0,0.0005\n0,0,0.02\n", &["--ring"]);
    assert_status(&output, 0);
    let rows = table(&here.join("field.csv"));
    assert_eq!(rows.len(), 3);
    assert!(cells(&rows[1]).iter().all(|cell| cell.is_empty()), "{:?}", rows[1]);
    assert_eq!((cells(&rows[1]).len(), &rows[1]["x_m"][..]), (12, "0.002"));
    assert!([0, 2].iter().all(|row| cells(&rows[*row]).iter().all(|cell| cell.parse::<f64>().is_ok())));
    assert!(
        stderr(&output).contains("points.csv, line 3, (0.002, 0, 0.0005) m has no field"),
        "{}",
        stderr(&output)
    );

    // A magnet of two cylinders, turned and elsewhere: its second cylinder ends at 15 mm along its axis, the world's y.
    let scene = "[magnet]\nposition_mm = [0.0, -100.0, 0.0]\norientation_wxyz = [0.7071067811865476, -0.7071067811865475, 0.0, 0.0]\n\
                 cylinders = [{ radius_mm = 8, length_mm = 10, offset_mm = -10, remanence_t = 1 }, { radius_mm = 4, length_mm = 10, offset_mm = 10, remanence_t = 1 }]\n";
    let (here, output) = run("turned edge", scene, "x_m,y_m,z_m\n0.004,-0.085,0\n0,0,0\n", &[]);
    assert_status(&output, 0);
    let rows = table(&here.join("field.csv"));
    assert!(cells(&rows[0]).iter().all(|cell| cell.is_empty()), "{:?}", rows[0]);
    assert!(rows[1]["By_t"].parse::<f64>().unwrap() > 0.0);
    let told = stderr(&output);
    let told: Vec<&str> = told.split("the field at (").collect();
    assert!(told[1].starts_with("0.004 m, -0.085 m, 0 m)"), "{told:?}");
}

#[test]
fn a_point_within_an_iron_core_costs_its_own_row() {
    let scene = "[[coil]]\nposition_mm = [0.0, 100.0, 0.0]\ninner_radius_mm = 20\nouter_radius_mm = 40\nlength_mm = 60\n\
                 turns = 600\ncurrent_a = 1\nmultipoles = [1e-7]\n";
    let (here, output) = run("core", scene, "x_m,y_m,z_m\n0,0.1,0\n0,0,0\n", &[]);
    assert_status(&output, 0);
    let rows = table(&here.join("field.csv"));
    assert!(cells(&rows[0]).iter().all(|cell| cell.is_empty()) && !rows[1]["Bx_t"].is_empty());
    assert!(
        stderr(&output).contains("points.csv, line 2, (0, 0.1, 0) m has no field"),
        "{}",
        stderr(&output)
    );
}

#[test]
fn without_a_magnet_bad_points_are_refused_all_the_same_and_an_older_table_stays() {
    let points = "x_m,y_m,z_m\n0,0,0.01\n0,inf,0\n";
    let (here, output) = run("no magnet", "[field]\nuniform_mt = [0, 1, 0]", points, &[]);
    assert_status(&output, 1);
    let expected = "points.csv, line 3: y_m = \"inf\" is not a finite number";
    assert!(stderr(&output).contains(expected), "{}", stderr(&output));
    assert!(!here.join("field.csv").exists());
    std::fs::write(here.join("field.csv"), "older").unwrap();
    let arguments = ["field", "scene.toml", "--at", "points.csv", "--out"];
    for (out, expected) in [
        ("field.csv", "is not a finite number"),
        ("points.csv", "points.csv would be written over points.csv, which is read"),
        ("./scene.toml", "is called like a scene"),
    ] {
        let output = mcm(&here, &[&arguments[..], &[out]].concat());
        assert_status(&output, 1);
        assert!(stderr(&output).contains(expected), "{}", stderr(&output));
    }
    assert_eq!(std::fs::read_to_string(here.join("field.csv")).unwrap(), "older");
    assert_eq!(std::fs::read_to_string(here.join("points.csv")).unwrap(), points);
    assert_eq!(std::fs::read_dir(&here).unwrap().count(), 3, "nothing half written is left");
}

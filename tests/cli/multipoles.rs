//! Coils with iron cores, whose multipoles stand in a table.

use std::fs;

use mcm::manipulator::SceneFile;

use super::{assert_status, folder, mcm, stderr, stdout};

/// A small cylinder whose length is the root of 3 times its radius has no octupole.
const CYLINDER_MM: (f64, f64) = (4.5, 7.794_228_634_059_948);

fn scene(source: &str) -> String {
    format!("[design]\nsegments = 3\n[model]\ninteraction = \"rings\"\n{source}")
}

fn tip(test: &str, scene: &str, table: &str) -> Vec<f64> {
    let here = folder(test);
    fs::write(here.join("core.csv"), table).unwrap();
    fs::write(here.join("scene.toml"), scene).unwrap();
    let output = mcm(&here, &["solve", "scene.toml", "--json"]);
    assert_status(&output, 0);
    let json: serde_json::Value = serde_json::from_str(&stdout(&output)).unwrap();
    json["tip_position_m"].as_array().unwrap().iter().map(|part| part.as_f64().unwrap()).collect()
}

#[test]
fn a_table_of_multipoles_makes_the_field_of_its_dipole() {
    // Its moment makes B_r V / (2 pi) = 1.35 T a^2 L / 2 on the axis, times 1 / r^3; with two degrees that are 0.
    let (radius, length) = CYLINDER_MM;
    let remanence = 18.0;
    let dipole = 0.5e-9 * remanence * radius * radius * length;
    let core = format!("degree,t_m_per_a\n1,{:e}\n3,0\n", dipole / 4.0);
    let place = "position_mm = [10.0, 75.0, 9.0]\norientation_wxyz = [0.8, 0.6, 0, 0]\n";
    let coil = format!(
        "[[coil]]\n{place}inner_radius_mm = 5\nouter_radius_mm = 10\nlength_mm = 20\nturns = 100\ncurrent_a = 4\n"
    );
    let magnet = format!(
        "[magnet]\n{place}[[magnet.cylinders]]\nradius_mm = {radius}\nlength_mm = {length}\nremanence_t = {remanence}\n"
    );
    let named = scene(&format!("{coil}multipoles_csv = \"core.csv\"\n"));
    let by_magnet = tip("multipoles_magnet", &scene(&magnet), "");
    let by_core = tip("multipoles", &named, &core);
    let inline = scene(&format!("{coil}multipoles = [{:e}, 0, 0]\n", dipole / 4.0));
    let by_list = tip("multipoles_inline", &inline, "");
    let unloaded = tip("multipoles_none", &scene(""), "");
    let apart = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(apart(&by_magnet, &unloaded) > 1e-4, "the field bends the device");
    assert!(apart(&by_core, &by_magnet) < 1e-7, "{by_core:?} {by_magnet:?}");
    assert!(by_core == by_list);
    // A scene that is packed or written has the numbers in it, not the name of a file.
    let here = folder("multipoles_written");
    fs::write(here.join("core.csv"), core).unwrap();
    let file = SceneFile::parse_in(&named, "named", &here).unwrap();
    assert_eq!(file, SceneFile::parse(&file.to_toml().unwrap(), "written").unwrap());
    assert!(
        SceneFile::parse(&named, "text")
            .unwrap_err()
            .to_string()
            .contains("core.csv is not found from a text")
    );
    fs::write(here.join("scene.toml"), &named).unwrap();
    fs::remove_file(here.join("core.csv")).unwrap();
    let output = mcm(&here, &["solve", "scene.toml"]);
    assert_status(&output, 1);
    assert!(stderr(&output).contains("scene.toml, line 5: coil[1].multipoles_csv"), "{}", stderr(&output));
}

#[test]
fn flaws_of_a_table_are_told() {
    let here = folder("multipoles_flaws");
    let coil = "[[coil]]\nposition_mm = [0, 60, 9]\ninner_radius_mm = 5\nouter_radius_mm = 10\nlength_mm = 20\n\
                turns = 100\ncurrent_a = 4\n";
    let refused = |table: &str, keys: &str, reason: &str| {
        fs::write(here.join("core.csv"), table).unwrap();
        fs::write(here.join("scene.toml"), scene(&format!("{coil}{keys}"))).unwrap();
        let output = mcm(&here, &["solve", "scene.toml"]);
        assert_status(&output, 1);
        assert!(stderr(&output).contains(reason), "{}", stderr(&output));
    };
    let named = "multipoles_csv = \"core.csv\"\n";
    refused("degree,t_m_per_a\n0,1e-7\n", named, "degree 0: from 1 (the dipole) to 17");
    refused("degree,t_m_per_a\n1,1e-7\n1,1e-7\n", named, "degree 1 stands there twice");
    refused("degree,t_m_per_a\n", named, "it has no rows");
    refused("degree,value\n1,1e-7\n", named, "unknown field `value`");
    refused("degree,t_m_per_a\n1,0\n", named, "needs a multipole that is not 0");
    refused(
        "degree,t_m_per_a\n1,1e-7\n",
        "multipoles = [1e-7]\nmultipoles_csv = \"core.csv\"\n",
        "give one or the other",
    );
    refused("", "reach_mm = 20.0\n", "coil[1].reach_mm needs coil[1].multipoles");
    refused("", "multipoles = [1e-7]\nreach_mm = -1.0\n", "coil[1].reach_mm = -1");
    // The device reaches into the sphere in which the multipoles say nothing.
    fs::write(here.join("scene.toml"), scene(&format!("{coil}multipoles = [1e-7]\nreach_mm = 70.0\n")))
        .unwrap();
    let output = mcm(&here, &["solve", "scene.toml"]);
    assert_status(&output, 2);
    assert!(stderr(&output).contains("bodies touch: segment 2"), "{}", stderr(&output));
}

//! Scenes whose vessel is a mesh, and pictures of scenes.

use std::fs::{self, File};
use std::path::PathBuf;

use nalgebra::Vector3;
use serde_json::Value;
use zip::ZipArchive;

use super::svg::{Axes, Element, elements};
use super::{assert_status, folder, mcm, stderr, stdout, table, with_scene};
use crate::vessel::tube::{shifted, stl, straight, tube};

const PRESSED: &str = "[design]\nsegments = 1\n[field]\nuniform_mt = [0.0, 12.0, 0.0]\n[model]\ninteraction = \"rings\"\n\
    time_budget_s = 20.0\n[vessel]\n";

const BRANCH: &str =
    "[[vessel.branch]]\nname = \"tube\"\npoints_mm = [[0, 0, -20], [0, 0, 0], [0, 0, 40]]\nradius_mm = 2.2\n";

/// A folder with a folder `scenes`, in which a scene names a mesh beside it.
fn meshed(test: &str) -> PathBuf {
    let place = folder(test);
    fs::create_dir(place.join("scenes")).unwrap();
    let triangles = shifted(tube(straight(0.06, 2.2e-3), 120, 120), Vector3::new(0.0, 0.0, -0.02));
    fs::write(place.join("scenes/tube.stl"), stl(&triangles, "")).unwrap();
    fs::write(place.join("scenes/mesh.toml"), format!("{PRESSED}mesh_stl = \"tube.stl\"\n")).unwrap();
    fs::write(place.join("scenes/branch.toml"), format!("{PRESSED}{BRANCH}")).unwrap();
    place
}

#[test]
fn a_mesh_lies_beside_its_scene() {
    let place = meshed("mesh");
    let force = |scene: &str| {
        let output = mcm(&place, &["solve", scene, "--json"]);
        assert_status(&output, 0);
        let answer: Value = serde_json::from_slice(&output.stdout).unwrap();
        assert_eq!(answer["contact_places_m"].as_array().unwrap().len(), answer["contact_count"]);
        answer["contact_force_n"][1].as_f64().unwrap()
    };
    let [mesh, branch] = ["scenes/mesh.toml", "scenes/branch.toml"].map(force);
    assert!(branch < -1e-3 && (mesh / branch - 1.0).abs() < 1e-2, "{mesh}, {branch}");
    let library = ["pack", "--scene", "scenes/mesh.toml", "--out", "mesh.fmu"];
    assert_status(&mcm(&place, &library), 0);
    let archive = ZipArchive::new(File::open(place.join("mesh.fmu")).unwrap()).unwrap();
    assert!(archive.index_for_name("resources/vessel.grid").is_some());
    fs::remove_file(place.join("scenes/tube.stl")).unwrap();
    let refused = mcm(&place, &["solve", "scenes/mesh.toml"]);
    assert_status(&refused, 1);
    let told = stderr(&refused);
    assert!(
        told.contains("scenes/mesh.toml, line 9: vessel.mesh_stl: scenes/tube.stl: No such file"),
        "{told}"
    );
}

#[test]
fn a_sweep_in_a_vessel_has_columns_of_its_contacts() {
    let place = meshed("swept mesh");
    let sweep = |scene: &str, vary: &str| {
        let output = mcm(&place, &["sweep", scene, "--vary", vary, "--out", "out.csv"]);
        assert_status(&output, 0);
        table(&place.join("out.csv"))
    };
    let number =
        |row: &std::collections::HashMap<String, String>, key: &str| row[key].parse::<f64>().unwrap();
    let rows = sweep("scenes/mesh.toml", "field.uniform_mt[2]=0:12:4");
    assert_eq!(rows[0]["contact_count"], "0.0");
    let last = &rows[3];
    assert!(number(last, "contact_force_y_n") < -1e-3 && number(last, "largest_indentation_m") > 0.0);
    assert!(number(last, "largest_contact_force_n") >= -number(last, "contact_force_y_n") * (1.0 - 1e-9));
    assert!(!last.contains_key("feed_length_m"));
    // The wall's numbers are of separate devices.
    let walls = sweep("scenes/branch.toml", "vessel.wall_modulus_mpa=1:4:2");
    let depths: Vec<f64> = walls.iter().map(|row| number(row, "largest_indentation_m")).collect();
    assert!(depths[1] < 0.7 * depths[0], "{depths:?}");
    // A rest of another mesh is not gone on with.
    let vary = ["sweep", "scenes/mesh.toml", "--vary", "field.uniform_mt[2]=0:12:4", "--out", "cut.csv"];
    let whole = fs::read(place.join("scenes/tube.stl")).unwrap();
    let mut child = super::start(&place, &vary);
    super::wait_for(|| {
        fs::read_to_string(place.join("cut.csv.part")).is_ok_and(|text| text.lines().count() > 2)
    });
    super::interrupt(&child, true);
    child.wait().unwrap();
    if place.join("cut.csv.part").exists() {
        let wider = shifted(tube(straight(0.06, 2.3e-3), 120, 120), Vector3::new(0.0, 0.0, -0.02));
        fs::write(place.join("scenes/tube.stl"), stl(&wider, "")).unwrap();
        let other = mcm(&place, &[&vary[..], &["--resume"]].concat());
        assert_status(&other, 1);
        assert!(stderr(&other).contains("is of another sweep"), "{}", stderr(&other));
        fs::write(place.join("scenes/tube.stl"), whole).unwrap();
        assert_status(&mcm(&place, &[&vary[..], &["--resume"]].concat()), 0);
        assert_eq!(table(&place.join("cut.csv"))[3]["contact_count"], last["contact_count"]);
    }
}

#[test]
fn other_sweeps_have_no_such_columns() {
    let scene = "[design]\nsegments = 1\n[model]\ninteraction = \"none\"";
    let arguments = ["sweep", "scene.toml", "--vary", "field.uniform_mt[2]=0:1:2", "--out", "out.csv"];
    let (place, output) = with_scene("no contacts", scene, &arguments);
    assert_status(&output, 0);
    assert!(
        table(&place.join("out.csv"))[0].keys().all(|key| !key.contains("contact") && !key.contains("feed"))
    );
}

#[test]
fn a_picture_shows_the_scene_to_scale() {
    let place = meshed("picture");
    fs::write(place.join("free.toml"), "[design]\nsegments = 1\n[magnet]\n[model]\ninteraction = \"none\"")
        .unwrap();
    let picture = |scene: &str, out: &str| {
        let output = mcm(&place, &["solve", scene, "--picture", out]);
        assert_status(&output, 0);
        assert!(stdout(&output).contains("tip angle"));
        elements(&place.join(out))
    };
    let shown = |elements: &[Element], label: &str| elements.iter().any(|own| own.text.contains(label));
    let pressed = picture("scenes/mesh.toml", "mesh.svg");
    for label in ["tip angle", "z (mm)", "y (mm)", "rings", "vessel", "wall, ", "mN", "field, 12 mT", " mm"] {
        assert!(shown(&pressed, label), "{label}");
    }
    let drawn = |elements: &[Element], class: &str| -> Vec<Element> {
        elements.iter().filter(|element| element.get("class") == class).cloned().collect()
    };
    assert!(drawn(&pressed, "arrow").len() > 2, "arrows of the wall and of the field, and their legend");
    assert_eq!(drawn(&pressed, "vessel").len(), 1);
    let free = picture("free.toml", "free.SVG");
    assert!(shown(&free, "magnet") && !shown(&free, "vessel") && !shown(&free, "wall, "));
    // Two cylinders of 45 mm by 30 mm with a gap of 10 mm; without a load, two rings of 4 mm by 1 mm, 5 mm apart.
    fs::write(place.join("straight.toml"), "[design]\nsegments = 1\n[model]\ninteraction = \"none\"")
        .unwrap();
    let straight = picture("straight.toml", "straight.svg");
    for (elements, class, size, apart) in
        [(&free, "magnet", [30.0, 45.0], 40.0), (&straight, "ring", [1.0, 4.0], 5.0)]
    {
        let axes = &Axes::of(elements)[0];
        let [first, second] = &drawn(&axes.inside, class)[..] else { panic!("two of {class}") };
        let [first, second] = [first, second].map(|element| axes.bounds(element));
        for [left, low, right, high] in [first, second] {
            let scale = crate::tolerance::DRAWN * axes.ranges()[1];
            let errors = [right - left - size[0], high - low - size[1], (first[0] - second[0]).abs() - apart];
            assert!(errors.iter().all(|error| error.abs() <= scale), "{class}: {errors:?} mm");
        }
    }
    let axes = &Axes::of(&free)[0];
    let scale = &drawn(&axes.inside, "scale")[0];
    let [left, _, right, _] = axes.bounds(scale);
    assert!(shown(&free, &format!("{:.0} mm", right - left)), "a scale of {} mm", right - left);
}

#[test]
fn pictures_are_svg() {
    let place = meshed("pixels");
    for name in ["free.png", "free.jpg", "free"] {
        let refused = mcm(&place, &["solve", "scenes/mesh.toml", "--picture", name]);
        assert_status(&refused, 1);
        let expected = format!("--picture {name} must end in .svg");
        assert!(stderr(&refused).contains(&expected), "{}", stderr(&refused));
        assert!(stderr(&refused).contains("rsvg-convert free.svg"), "{}", stderr(&refused));
        assert!(!place.join(name).exists());
    }
}

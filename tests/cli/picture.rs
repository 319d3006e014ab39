//! What `mcm solve --picture` says: the plane of the bend, sources outside it, poles, and the size of forces.

use std::fs;
use std::path::Path;

use super::svg::{Element, elements};
use super::{assert_status, folder, mcm, stderr};

/// One segment that bends in the x-z plane, in a vessel that spreads along y.
const BENT: &str = "[design]\nsegments = 1\n[model]\ninteraction = \"none\"\n[field]\nuniform_mt = [5.0, 0.0, 0.0]\n[vessel]\n\
    [[vessel.branch]]\nname = \"tube\"\npoints_mm = [[0, 0, -10], [0, 0, 30]]\nradius_mm = 8.0\n[[vessel.branch]]\nname = \"side\"\n\
    points_mm = [[0, -40, 5], [0, 40, 5]]\nradius_mm = 6.0\n";

/// A device that a field presses against the wall of a tube, with a pull at its tip.
const PRESSED: &str = "[design]\nsegments = 3\n[model]\ninteraction = \"none\"\ntime_budget_s = 20.0\n[field]\n\
    uniform_mt = [0.0, FIELD, 0.0]\n[load]\ntip_force_n = [0, 0, PULL]\n[vessel]\nwall_modulus_mpa = MODULUS\n[[vessel.branch]]\n\
    name = \"tube\"\npoints_mm = [[0, 0, -20], [0, 0, 40]]\nradius_mm = 2.6\n";

fn drawn(place: &Path, scene: &str, options: &[&str]) -> Vec<Element> {
    fs::write(place.join("scene.toml"), scene).unwrap();
    let arguments = [&["solve", "scene.toml", "--picture", "out.svg"], options].concat();
    let output = mcm(place, &arguments);
    assert_status(&output, 0);
    elements(&place.join("out.svg"))
}

fn texts(elements: &[Element]) -> Vec<&str> {
    elements.iter().map(|element| element.text.as_str()).filter(|text| !text.is_empty()).collect()
}

fn of_class(elements: &[Element], class: &str) -> Vec<String> {
    elements.iter().filter(|element| element.get("class") == class).map(|own| own.text.clone()).collect()
}

#[test]
fn a_device_is_drawn_in_the_plane_in_which_it_bends_or_in_the_one_asked_for() {
    let place = folder("picture plane");
    for (scene, options, expected) in [
        (BENT, &[][..], ["z (mm)", "x (mm)"]),
        (BENT, &["--view", "y-z"], ["z (mm)", "y (mm)"]),
        (BENT, &["--view", "x-y"], ["x (mm)", "y (mm)"]),
        // A straight device is seen where the vessel spreads.
        (&BENT.replace("5.0, 0.0, 0.0", "0.0, 0.0, 0.0"), &[], ["z (mm)", "y (mm)"]),
    ] {
        let elements = drawn(&place, scene, options);
        let found = texts(&elements);
        for label in expected {
            assert!(found.contains(&label), "{options:?}: {found:?}");
        }
        let others = ["x (mm)", "y (mm)", "z (mm)"].into_iter().filter(|label| !expected.contains(label));
        assert!(others.into_iter().all(|label| !found.contains(&label)), "{options:?}: {found:?}");
    }
    let refused = mcm(&place, &["solve", "scene.toml", "--view", "x-z"]);
    assert_ne!(refused.status.code(), Some(0), "a view of no picture");
    let refused = mcm(&place, &["solve", "scene.toml", "--picture", "out.svg", "--view", "z"]);
    assert!(stderr(&refused).contains("x-z, y-z, x-y"), "{}", stderr(&refused));
}

#[test]
fn poles_are_named_and_sources_outside_the_plane_are_marked() {
    let place = folder("picture poles");
    let scene = "[design]\nsegments = 1\n[model]\ninteraction = \"none\"\n[field]\nuniform_mt = [0, 10, 0]\n[magnet]\n\
                 position_mm = [X, -120.0, 0.0]\norientation_wxyz = Q\n\
                 cylinders = [{ radius_mm = 10.0, length_mm = 20.0, remanence_t = 1.2 }]\n";
    let of = |x: &str, quaternion: &str| {
        let scene = scene.replace('X', x).replace('Q', quaternion);
        drawn(&place, &scene, &["--view", "y-z"])
    };
    let beside = of("0.0", "[0, 1, 0, 0]");
    assert_eq!(of_class(&beside, "pole"), ["N", "S"]);
    assert_eq!(of_class(&beside, "depth"), [] as [&str; 0]);
    // The axis points along -z: north is at the left of south, where z grows to the right.
    let places: Vec<f64> = (beside.iter().filter(|element| element.get("class") == "pole"))
        .map(|element| element.get("x").parse().unwrap())
        .collect();
    assert!(places[0] < places[1], "{places:?}");
    for (x, side) in [("37.0", "37 mm"), ("-37.0", "37 mm")] {
        let [remark] = &of_class(&of(x, "[0, 1, 0, 0]"), "depth")[..] else { panic!("{x}") };
        assert!(remark.starts_with(side), "{remark}");
    }
    let [one, other] = ["37.0", "-37.0"].map(|x| of_class(&of(x, "[0, 1, 0, 0]"), "depth"));
    assert_ne!(one, other, "in front and behind");
    // Seen along its axis, a magnet shows one pole, and the other one from behind.
    let half = core::f64::consts::FRAC_1_SQRT_2;
    let along =
        [1.0, -1.0].map(|sign| of_class(&of("0.0", &format!("[{half}, 0, {}, 0]", sign * half)), "pole"));
    assert_eq!(along.each_ref().map(Vec::len), [1, 1]);
    assert_ne!(along[0], along[1]);
}

#[test]
fn arrows_of_forces_have_a_size_that_means_something() {
    let place = folder("picture forces");
    let scene = |field: &str, pull: &str, modulus: &str| {
        PRESSED.replace("FIELD", field).replace("PULL", pull).replace("MODULUS", modulus)
    };
    let pressed = drawn(&place, &scene("4.0", "0.0", "1.0"), &[]);
    let legend = |elements: &[Element]| {
        texts(elements).into_iter().find(|text| text.starts_with("wall, ")).map(str::to_owned)
    };
    let arrows = |elements: &[Element]| of_class(elements, "arrow").len();
    let told = legend(&pressed).unwrap();
    assert!(told.ends_with(" mN") && !told.contains("not drawn"), "{told}");
    assert!(arrows(&pressed) > 3, "of the wall, of the field, and two of the legend");
    // A wall that is so soft that it presses by a hair on a device that a pull holds.
    let idle = drawn(&place, &scene("1.0", "0.05", "0.001"), &[]);
    let told = legend(&idle).unwrap();
    assert!(told.starts_with("wall, at most ") && told.ends_with(" mN: not drawn"), "{told}");
    assert_eq!(arrows(&idle), 2, "of the field, and of its legend");
}

//! What a page draws.

use approx::assert_relative_eq;
use mcm::manipulator::Scene;
use mcm::vessel::Aorta;
use mcm::web::Device;
use serde_json::Value;

use super::BESIDE;
use crate::tolerance::{ROUNDING, assert_close};

fn described(scene: &str) -> Value {
    serde_json::from_str(&Device::open(scene, None).unwrap().description().unwrap()).unwrap()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value}"))
}

#[test]
fn bodies_follow_one_another_to_the_tip() {
    let scene = "[design]\nsegments = 3\nspiral = \"alternating\"";
    let design = Scene::parse(scene, "test").unwrap().design().unwrap();
    let described = described(scene);
    let bodies = described["bodies"].as_array().unwrap();
    let mut end = 0.0;
    for body in bodies {
        assert_relative_eq!(number(&body["begin"]), end, epsilon = 1e-15);
        end += number(&body["length"]);
    }
    assert_relative_eq!(end, design.length(), epsilon = 1e-15);
    let of = |kind: &str| bodies.iter().filter(|body| body["kind"] == kind).collect::<Vec<_>>();
    assert_eq!([of("ring").len(), of("core").len(), of("disc").len()], [4, 3, 6]);
    let turns: Vec<f64> = of("core").iter().map(|body| number(&body["spiral"]["turn"])).collect();
    assert_eq!(turns, [1.0, -1.0, 1.0]);
    for core in of("core") {
        assert_relative_eq!(number(&core["boundaryAngle"]).to_degrees(), 40.0, epsilon = 1e-9);
    }
    assert!(of("ring").iter().all(|ring| (number(&ring["remanence"]) - 1.35).abs() < 1e-12));
    assert_eq!(described["level"], "auto");
    assert!(described["vessel"].is_null() && described["shaft"].is_null());
}

#[test]
fn the_magnet_has_its_cylinders_and_inputs_their_start() {
    let described = described(BESIDE);
    let cylinders = described["magnet"].as_array().unwrap();
    assert_eq!(cylinders.len(), 2);
    assert_relative_eq!(number(&cylinders[0]["outerRadius"]), 0.0225);
    let inputs = described["inputs"].as_array().unwrap();
    let start =
        |name: &str| inputs.iter().find(|row| row["name"] == name).map(|row| number(&row["start"])).unwrap();
    assert_relative_eq!(start("magnet.position[2]"), -0.12);
    assert_relative_eq!(start("magnet.strength"), 1.0);
}

#[test]
fn a_vessel_has_its_branches() {
    let aorta = Aorta::planar().scene_text().unwrap();
    let scene = format!(
        "[feed]\nmode = \"insertion\"\n[design.backbone]\nouter_radius_mm = 0.75\ninner_radius_mm = 0.25\nshore_a = 40.0\npoisson = 0.45\n[vessel]\n{aorta}"
    );
    let lumen = Scene::parse(&scene, "test").unwrap().vessel.unwrap().lumen;
    let described = described(&scene);
    let branches = described["vessel"]["branches"].as_array().unwrap();
    assert_eq!(branches.len(), lumen.branches().len());
    for (described, branch) in branches.iter().zip(lumen.branches()) {
        assert_eq!(described["name"], branch.name());
        let balls: Vec<f64> = described["balls"].as_array().unwrap().iter().map(number).collect();
        for (at, ball) in [(0.0, &balls[..4]), (*branch.range().end(), &balls[balls.len() - 4..])] {
            let (centre, radius) = branch.ball(at);
            assert_close(branch.name(), ball, &[centre.x, centre.y, centre.z, radius], ROUNDING);
        }
    }
    assert!(number(&described["shaft"]["outerRadius"]) > 0.0);
    assert_eq!(described["feedMode"], "insertion");
}

#[test]
fn further_magnets_and_coils_have_their_bodies_and_moments() {
    let scene = "[design]\nsegments = 1\n[[magnet]]\n[[magnet]]\nposition_mm = [150, 0, 0]\n\
                 [[coil]]\nposition_mm = [0, 90, 0]\ninner_radius_mm = 20\nouter_radius_mm = 40\nlength_mm = 60\n\
                 turns = 600\ncurrent_a = 1";
    let described = described(scene);
    let further = described["further"].as_array().unwrap();
    let names: Vec<_> = further.iter().map(|source| source["name"].as_str().unwrap()).collect();
    assert_eq!(names, ["magnet[2]", "coil[1]"]);
    assert_eq!(further[0]["parts"], described["magnet"], "both are the usual pair");
    let [winding] = &further[1]["parts"].as_array().unwrap()[..] else { panic!("one winding") };
    let [inner, outer, length] = ["innerRadius", "outerRadius", "length"].map(|key| number(&winding[key]));
    assert_close("winding", &[inner, outer, length], &[0.02, 0.04, 0.06], ROUNDING);
    // A coil of N turns between the radii a and b has the moment N pi (a^2 + a b + b^2) / 3 of one ampere.
    let moment = 600.0 * core::f64::consts::PI * (inner * inner + inner * outer + outer * outer) / 3.0;
    let volume = core::f64::consts::PI * (outer * outer - inner * inner) * length;
    let expected = 4e-7 * core::f64::consts::PI * moment / volume;
    assert_relative_eq!(number(&winding["remanence"][2]), expected, max_relative = 1e-9);
}

#[test]
fn magnets_have_their_shapes_and_remanences() {
    let scene = "[design]\nsegments = 1\n[[magnet]]\nshape = \"cuboid\"\nsize_mm = [10, 20, 30]\ndirection = [0, 0.6, 0.8]\n\
                 remanence_t = 1.2\n[[magnet]]\nposition_mm = [150, 0, 0]\nshape = \"sphere\"\nradius_mm = 12.5\ngrade = \"N42\"";
    let described = described(scene);
    let [cuboid] = &described["magnet"].as_array().unwrap()[..] else { panic!("one part") };
    let list = |value: &serde_json::Value| value.as_array().unwrap().iter().map(number).collect::<Vec<f64>>();
    assert_eq!(cuboid["shape"], "cuboid");
    assert_close("size", &list(&cuboid["size"]), &[0.01, 0.02, 0.03], ROUNDING);
    assert_close("remanence", &list(&cuboid["remanence"]), &[0.0, 0.72, 0.96], ROUNDING);
    assert_relative_eq!(number(&cuboid["volume"]), 6e-6, max_relative = 1e-12);
    let ball = &described["further"][0]["parts"][0];
    assert_eq!(ball["shape"], "sphere");
    assert_relative_eq!(number(&ball["radius"]), 0.0125);
    assert_relative_eq!(number(&ball["remanence"][2]), 1.3, max_relative = 1e-12);
}

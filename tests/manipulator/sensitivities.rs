//! Derivatives of all outputs by numbers of the scene against differences of whole solves, and against the Jacobian.

use mcm::equilibrium::{Interaction, Settings};
use mcm::manipulator::{Input, Manipulator, Neighbours, Output, Outputs, SceneFile, Status};

use super::jacobian::{differences, rates};
use crate::differences::{Compared, worst};
use crate::tolerance::{JACOBIAN, PAIRS, SENSITIVITY};

/// Centreline points.
const POINTS: usize = 5;

/// Step of the differences of fourth order, relative to the number.
const STEP: f64 = 1e-3;

const SEGMENTS: &str = "[design]\nsegments = 2\n[design.helix]\n[design.ring]\nrecoil_permeability = 1.05\n\
    [design.backbone]\nouter_radius_mm = 0.7\ninner_radius_mm = 0.6\nshore_a = 30.0\n\
    poisson = 0.48\ndensity_kg_m3 = 1100.0\n[field]\nuniform_mt = [2.0, 4.0, -1.0]\n[magnet]\nposition_mm = [10.0, -90.0, 20.0]\nstrength = 0.8\n\
    [load]\ntip_force_n = [0.001, -0.0005, 0.0015]\n[gravity]\nacceleration_m_s2 = [1.0, -2.0, 9.0]\n";

const OF_SEGMENTS: [&str; 25] = [
    "design.helix.length_mm",
    "design.helix.boundary_angle_deg",
    "design.helix.radius_mm",
    "design.helix.windings",
    "design.helix.core_outer_radius_mm",
    "design.helix.core_inner_radius_mm",
    "design.helix.shore_a",
    "design.helix.poisson",
    "design.helix.volume_fraction",
    "design.helix.particle_remanence_t",
    "design.ring.length_mm",
    "design.ring.remanence_t",
    "design.ring.recoil_permeability",
    "design.ring.density_kg_m3",
    "design.backbone.outer_radius_mm",
    "design.backbone.inner_radius_mm",
    "design.backbone.shore_a",
    "design.backbone.poisson",
    "design.backbone.density_kg_m3",
    "magnet.cylinders[1].remanence_t",
    "magnet.cylinders[1].radius_mm",
    "magnet.cylinders[2].length_mm",
    "magnet.cylinders[2].offset_mm",
    "magnet.position_mm[2]",
    "load.tip_force_n[2]",
];

const ROD: &str = "[design]\nkind = \"cylinder\"\nlength_mm = 30.0\nradius_mm = 1.0\nelastic_modulus_mpa = 1.5\n\
    poisson = 0.45\nremanence_t = 0.1\ndensity_kg_m3 = 3000.0\n[field]\nuniform_mt = [2.0, 4.0, -1.0]\n\
    [gravity]\nacceleration_m_s2 = [1.0, -2.0, 9.0]\n";

const OF_ROD: [&str; 6] = [
    "design.length_mm",
    "design.radius_mm",
    "design.elastic_modulus_mpa",
    "design.poisson",
    "design.remanence_t",
    "design.density_kg_m3",
];

/// On a silicone tube that is pushed in.
const SHAFT: &str = "[design]\nsegments = 1\n[field]\nuniform_mt = [0.0, 3.0, 0.0]\n[gravity]\n\
    acceleration_m_s2 = [0.3, -1.0, 3.0]\n[feed]\nmode = \"insertion\"\ninsertion_mm = 20.0\n[feed.shaft]\n\
    outer_radius_mm = 0.75\ninner_radius_mm = 0.5\nshore_a = 45.0\npoisson = 0.48\ndensity_kg_m3 = 1100.0\n";

const OF_SHAFT: [&str; 5] = [
    "feed.shaft.outer_radius_mm",
    "feed.shaft.shore_a",
    "feed.shaft.density_kg_m3",
    "feed.insertion_mm",
    "design.ring.remanence_t",
];

fn file(text: &str) -> SceneFile {
    SceneFile::parse(text, "test").unwrap()
}

/// The solved device of a scene, with quadratures so fine that differences of solves are smooth.
fn solved(file: &SceneFile, interaction: Interaction) -> Manipulator {
    let scene = file.scene().unwrap();
    let settings = Settings { interaction, pair_accuracy: PAIRS, tolerance: 1e-13, ..scene.settings };
    let (design, magnet) = (scene.design().unwrap(), scene.sources.magnet().cloned());
    let mut out = Manipulator::new(&design, magnet.as_ref(), settings, POINTS).unwrap();
    if let Some(vessel) = &scene.vessel {
        out = out.in_vessel(vessel);
    }
    let status = out.solve(&scene.inputs).unwrap().status;
    assert!(matches!(status, Status::Solved | Status::NearFold), "{status:?}");
    out.measure_strains();
    out
}

/// All outputs by the number `key`, times that number: central differences of fourth order of whole solves.
fn by_solves(file: &SceneFile, interaction: Interaction, key: &str) -> Vec<(Output, Vec<f64>)> {
    let value = file.number(key).unwrap();
    let step = STEP * value;
    let at = |by: f64| solved(&file.with(key, value + by).unwrap(), interaction).outputs().clone();
    let rates = rates(step, at).into_iter();
    rates.map(|(output, rate)| (output, rate.iter().map(|rate| rate * value).collect())).collect()
}

fn norm(vector: &[f64]) -> f64 {
    vector.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// Stops unless every output by every key is that of differences, relative to the largest effect on that output that a key has by as
/// much as it is.
fn check(name: &str, file: &SceneFile, interaction: Interaction, keys: &[&str]) {
    let manipulator = solved(file, interaction);
    let found = Neighbours::new(file, keys).unwrap().sensitivities(&manipulator).unwrap();
    // A push that is given does not change.
    let given = |output| output == Output::FeedReaction && file.scene().unwrap().inputs.feed_force.is_some();
    let mut compared = Vec::new();
    for (index, key) in keys.iter().enumerate() {
        let ([before, after], apart) = found.sides(index).unwrap();
        let size = file.number(key).unwrap() / apart;
        let expected = by_solves(file, interaction, key);
        for ((output, got), (_, expected)) in differences(after, before).into_iter().zip(expected) {
            let error: Vec<f64> = got.iter().zip(&expected).map(|(a, b)| a * size - b).collect();
            if !given(output) {
                let name = format!("{output:?} by {key}");
                compared.push(Compared { kind: output, name, error: norm(&error), effect: norm(&expected) });
            }
        }
    }
    let (error, place) = worst(&compared, |_| SENSITIVITY);
    println!("{name}: {error:.1e} of what is allowed ({place})");
    assert!(error > 0.0 && error <= 1.0, "{name}: {place} is off by {error:e} times what is allowed");
}

#[test]
fn every_output_by_every_number_of_the_design_and_the_magnet() {
    for &(interaction, level, _) in Interaction::ALL {
        check(&format!("segments, {level}"), &file(SEGMENTS), interaction, &OF_SEGMENTS);
    }
}

#[test]
fn every_output_by_every_number_of_a_plain_rod() {
    check("rod", &file(ROD), Interaction::None, &OF_ROD);
}

#[test]
fn every_output_by_the_numbers_of_a_shaft_and_at_a_given_push() {
    check("shaft", &file(SHAFT), Interaction::Rings, &OF_SHAFT);
    let push = solved(&file(SHAFT), Interaction::Rings).outputs().feed_reaction.unwrap();
    let pushed = SHAFT.replace("\"insertion\"", &format!("\"force\"\nforce_n = {push}"));
    let keys = ["feed.shaft.outer_radius_mm", "feed.shaft.shore_a", "design.ring.remanence_t"];
    check("pushed", &file(&pushed), Interaction::Rings, &keys);
}

#[test]
fn numbers_that_are_inputs_have_the_columns_of_the_jacobian() {
    let file = file(SEGMENTS);
    let manipulator = solved(&file, Interaction::Full);
    let jacobian = manipulator.jacobian().unwrap();
    // Each with its column, and the SI units of one of its units.
    let inputs = [
        ("field.uniform_mt[1]", Input::UniformField, 0, 1e-3),
        ("magnet.position_mm[3]", Input::SourcePosition(0), 2, 1e-3),
        ("magnet.strength", Input::SourceStrength(0), 0, 1.0),
        ("base.position_mm[2]", Input::BasePosition, 1, 1e-3),
        ("gravity.acceleration_m_s2[2]", Input::Gravity, 1, 1.0),
        ("load.tip_moment_nm[1]", Input::TipMoment, 0, 1.0),
    ];
    let keys = inputs.map(|(key, ..)| key);
    let found = Neighbours::new(&file, &keys).unwrap().sensitivities(&manipulator).unwrap();
    for (index, (key, input, axis, unit)) in inputs.into_iter().enumerate() {
        let ([before, after], apart) = found.sides(index).unwrap();
        for (output, got) in differences(after, before) {
            let block = jacobian.block(output, input).unwrap();
            let expected: Vec<f64> = block.column(axis).iter().map(|rate| rate * unit).collect();
            let error: Vec<f64> = got.iter().zip(&expected).map(|(a, b)| a / apart - b).collect();
            let scale = norm(&expected);
            if scale > 0.0 {
                assert!(
                    norm(&error) <= JACOBIAN * scale,
                    "{key}: {output:?} is off by {:e}",
                    norm(&error) / scale
                );
            }
        }
    }
}

#[test]
fn a_number_at_the_limit_of_its_range_has_a_one_sided_derivative() {
    let file = file(&SEGMENTS.replace("recoil_permeability = 1.05", "recoil_permeability = 1.0"));
    let key = "design.ring.recoil_permeability";
    let manipulator = solved(&file, Interaction::Rings);
    let found = Neighbours::new(&file, &[key]).unwrap().sensitivities(&manipulator).unwrap();
    let read = |outputs: &Outputs| outputs.tip.position.y;
    let slope = found.of(read)[0];
    let at = |value: f64| read(solved(&file.with(key, value).unwrap(), Interaction::Rings).outputs());
    let h = 1e-3;
    let expected = (-25.0 * at(1.0) + 48.0 * at(1.0 + h) - 36.0 * at(1.0 + 2.0 * h)
        + 16.0 * at(1.0 + 3.0 * h)
        - 3.0 * at(1.0 + 4.0 * h))
        / (12.0 * h);
    assert!((slope / expected - 1.0).abs() < 1e-5, "{slope} instead of {expected}");
}

#[test]
fn numbers_without_derivatives_are_refused() {
    let file = file(SEGMENTS);
    let refused = |keys: &[&str]| Neighbours::new(&file, keys).unwrap_err().to_string();
    assert_eq!(refused(&["design.helix.shore"]), "unknown key `design.helix.shore`; did you mean `shore_a`?");
    assert_eq!(refused(&["design.segments"]), "`design.segments` is a whole number");
    assert_eq!(refused(&["design.base_magnet"]), "`design.base_magnet` holds no number");
    assert_eq!(refused(&["magnet.strength", "magnet.strength"]), "`magnet.strength` is named twice");
    assert!(refused(&["vessel.friction"]).contains("depends on the way"));
    let unsolved = file.scene().unwrap().manipulator(2).unwrap();
    let mut neighbours = Neighbours::new(&file, &["design.helix.shore_a"]).unwrap();
    assert_eq!(
        neighbours.sensitivities(&unsolved).unwrap_err().to_string(),
        "no derivatives: nothing is solved yet"
    );
}

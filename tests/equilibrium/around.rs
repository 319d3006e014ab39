//! The paper's pair of magnets all around nine segments: a level whose energy is bounded below keeps a shape everywhere, and where
//! another one loses its shape, its branch folds.

use core::f64::consts::TAU;

use mcm::equilibrium::{Equilibrium, Inputs, Outcome};
use mcm::manipulator::Scene;
use mcm::numerics::continuation::Walk;
use nalgebra::Vector3;

use crate::tolerance::FOLD_ON_THE_WAY;

/// Steps of one turn around the middle of the manipulator, and how far away, m.
const STEPS: u32 = 200;
const AWAY: f64 = 0.14;

/// Height of the middle, m.
const MIDDLE: f64 = 0.0277;

/// Processor time that a solve may take, s: here a loaded machine must not material.
const PATIENCE: f64 = 30.0;

/// Positions of the magnet on the axis, beyond the tip and beyond the base, where next to nothing turns the straight shape, mm.
const ON_AXIS: [&str; 2] = ["[0, 0, 163]", "[0, -0.001, -117]"];

fn scene(level: &str, position: &str) -> Scene {
    let text = format!(
        "[design]\nsegments = 9\n[magnet]\nposition_mm = {position}\n[model]\ninteraction = \"{level}\""
    );
    let mut scene = Scene::parse(&text, "around").expect("a scene");
    scene.settings.time_budget = PATIENCE;
    scene
}

fn equilibrium(scene: &Scene) -> Equilibrium {
    let design = scene.design().expect("a design");
    Equilibrium::new(&design, &scene.sources, scene.settings, 2).expect("allowed")
}

/// With the magnet's orientation as it is, after so many steps around.
fn around(scene: &Scene, steps: f64) -> Inputs {
    let mut inputs = scene.inputs.clone();
    let (sine, cosine) = (TAU * steps / f64::from(STEPS)).sin_cos();
    inputs.sources[0].pose.position = Vector3::new(0.0, -AWAY * cosine, MIDDLE + AWAY * sine);
    inputs
}

/// With a magnet of that part of its strength.
fn of_strength(scene: &Scene, part: f64) -> Inputs {
    let mut inputs = scene.inputs.clone();
    inputs.sources[0].strength = part;
    inputs
}

/// Where the branch of a solved model folds, between the values `ends` of a path, of which the first is that of its shape.
fn fold(model: &Equilibrium, path: impl Fn(f64) -> Inputs, ends: [f64; 2]) -> f64 {
    let walk = Walk { from: ends[0], upwards: true, range: ends, longest_step: 0.02, points: 200 };
    let diagram = model.trace(|value| Ok(path(value)), &walk).expect("a potential");
    let fold = diagram.folds().next().map(|fold| fold.value);
    fold.unwrap_or_else(|| panic!("no fold between {ends:?}"))
}

#[test]
fn without_the_rings_attraction_there_is_a_shape_all_around() {
    let scene = scene("none", "[0, 0, 0]");
    let mut model = equilibrium(&scene);
    for step in 0..=STEPS {
        let report = model.solve(&around(&scene, f64::from(step))).expect("finite inputs");
        assert!(report.outcome == Outcome::Solved && report.stable == Some(true), "step {step}: {report:?}");
    }
}

#[test]
fn without_the_rings_attraction_there_is_a_shape_beyond_tip_and_base() {
    for position in ON_AXIS {
        let scene = scene("none", position);
        let report = equilibrium(&scene).solve(&scene.inputs).expect("finite inputs");
        assert!(report.outcome == Outcome::Solved && report.stable == Some(true), "{position}: {report:?}");
    }
}

#[test]
fn on_the_way_around_the_rings_come_to_touch_beyond_a_fold() {
    let scene = scene("rings", "[0, 0, 0]");
    let mut model = equilibrium(&scene);
    let mut last = model.clone();
    let lost = (0..=STEPS).find_map(|step| {
        let report = model.solve(&around(&scene, f64::from(step))).expect("finite inputs");
        if report.solved() {
            last = model.clone();
        }
        (!report.solved()).then_some((f64::from(step), report))
    });
    let (step, report) = lost.expect("an end");
    assert!(matches!(report.outcome, Outcome::Contact(_)), "{report:?}");
    let fold = fold(&last, |step| around(&scene, step), [step - 1.0, step]);
    println!("fold at step {fold}, told at {}", step - 1.0 + report.progress);
    assert!((step - 1.0 + report.progress - fold).abs() <= FOLD_ON_THE_WAY, "fold at {fold}: {report:?}");
}

#[test]
fn beyond_the_base_the_rings_come_to_touch_beyond_a_fold() {
    for level in ["rings", "full"] {
        let scene = scene(level, ON_AXIS[1]);
        let report = equilibrium(&scene).solve(&scene.inputs).expect("finite inputs");
        assert!(matches!(report.outcome, Outcome::Contact(_)), "{level}: {report:?}");
        // Up to a little before, by the same way.
        let mut model = equilibrium(&scene);
        let before = 0.95 * report.progress;
        assert!(model.solve(&of_strength(&scene, before)).expect("finite inputs").solved(), "{level}");
        let fold = fold(&model, |part| of_strength(&scene, part), [before, 1.0]);
        println!("{level}: fold at {fold}, told at {}", report.progress);
        assert!((report.progress - fold).abs() <= FOLD_ON_THE_WAY, "{level}: fold at {fold}, {report:?}");
    }
}

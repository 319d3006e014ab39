//! Ways from pose to pose past folds.

use mcm::manipulator::{Scene, Status};
use mcm::steer::{Limit, Limits, Move, Steering};

use super::{assert_walked, solved};

/// The pass of the study `hysteresis`: the paper's magnet pair opposes nine segments, at 120 mm from axis to axis.
fn pass(place: f64) -> Scene {
    let text = format!(
        "[design]\nsegments = 9\n[magnet]\nposition_mm = [0.0, -120.0, {place}]\norientation_wxyz = [1.0, 0.0, 0.0, 0.0]\n\
         [model]\ninteraction = \"rings\"\nbending_stop = true\n"
    );
    Scene::parse(&text, "pass").unwrap()
}

#[test]
fn a_way_round_the_fold_of_the_hysteresis_pass_is_found() {
    let scene = pass(-40.0);
    let goal = pass(0.0).inputs;
    let mut device = solved(&scene);
    let mut snapped = false;
    for step in 0..=40 {
        let mut inputs = scene.inputs.clone();
        inputs.sources[0].pose.position.z += 1e-3 * f64::from(step);
        snapped |= device.solve(&inputs).unwrap().status == Status::Snapped;
    }
    assert!(snapped, "the straight way snaps");
    let moves = [Move::MagnetPosition, Move::MagnetOrientation];
    let mut steering = Steering::new(&scene, &moves, Limits::default()).unwrap();
    let plan = steering.plan(&goal, None, 300).unwrap();
    assert_eq!(plan.straight, Some(Limit::Snap));
    println!("{} tries, {} steps, {:?}", plan.tries, plan.way.len(), plan.limit);
    assert_eq!(plan.limit, None);
    assert_walked(&solved(&scene), &plan.way);
    let last = &plan.way.last().unwrap().inputs;
    assert!((last.sources[0].pose.position - goal.sources[0].pose.position).norm() < 1e-9);
    assert!(last.sources[0].pose.axis().angle(&goal.sources[0].pose.axis()) < 1e-6);
}

#[test]
fn a_straight_way_needs_no_tries_and_a_closed_one_says_how_many() {
    let scene = pass(-40.0);
    let mut steering = Steering::new(&scene, &[Move::MagnetPosition], Limits::default()).unwrap();
    let plan = steering.plan(&pass(-30.0).inputs, None, 1).unwrap();
    assert_eq!((plan.straight, plan.tries, plan.limit), (None, 0, None));
    // Along a line there is no way round.
    let place = scene.inputs.sources[0].pose.position;
    let tight = nalgebra::Vector3::new(1e-6, 1e-6, 0.1);
    let limits = Limits { workspace: Some([place - tight, place + tight]), ..Limits::default() };
    let mut steering = Steering::new(&scene, &[Move::MagnetPosition], limits).unwrap();
    let plan = steering.plan(&pass(0.0).inputs, None, 5).unwrap();
    assert_eq!((plan.straight, plan.limit), (Some(Limit::Snap), Some(Limit::NoWay(5))));
    assert!(plan.way.is_empty() && *steering.inputs() == scene.inputs);
    assert!(steering.plan(&scene.inputs, None, 0).unwrap_err().to_string().contains("number of tries"));
}

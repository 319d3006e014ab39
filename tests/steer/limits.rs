//! Limits are kept, and told where they stop the tip; what nothing can keep to is refused.

use mcm::manipulator::Scene;
use mcm::steer::{Limit, Limits, Move, Steering, Target, Tolerances};
use nalgebra::Vector3;

use super::{assert_walked, scene, solved};
use crate::differences::derivative;

const POSE: [Move; 2] = [Move::MagnetPosition, Move::MagnetOrientation];

fn angle(degrees: f64) -> Target {
    Target { angle: Some(degrees.to_radians()), ..Target::default() }
}

#[test]
fn the_gradient_of_the_margin_is_that_of_differences_of_another_order() {
    let scene = scene(3);
    let steering = Steering::new(&scene, &POSE, Limits::default()).unwrap();
    let gradient = steering.margin_gradient().unwrap().unwrap();
    assert_eq!(gradient.len(), 5);
    let margin = |by: [f64; 3]| {
        let mut inputs = scene.inputs.clone();
        inputs.sources[0].pose.position += Vector3::from(by);
        let mut device = solved(&scene);
        device.solve(&inputs).unwrap();
        device.measure_margin().stability_margin
    };
    let largest = gradient.iter().take(3).fold(0.0_f64, |most, rate| most.max(rate.abs()));
    for axis in 0..3 {
        let fourth = derivative(1e-3, |step| {
            let mut by = [0.0; 3];
            by[axis] = step;
            margin(by)
        });
        let apart = (gradient[axis] - fourth).abs() / largest;
        println!("axis {axis}: {} and {fourth}, {apart:.1e} of the largest", gradient[axis]);
        assert!(apart < 2e-4, "axis {axis}: {} beside {fourth}", gradient[axis]);
    }
}

#[test]
fn the_workspace_is_kept_and_told() {
    let scene = scene(3);
    let place = scene.inputs.sources[0].pose.position;
    let around = Vector3::repeat(0.004);
    let limits = Limits { workspace: Some([place - around, place + around]), ..Limits::default() };
    let mut steering = Steering::new(&scene, &[Move::MagnetPosition], limits).unwrap();
    let before = steering.outputs().tip_angle.to_degrees();
    let answer = steering.to(&angle(before + 20.0)).unwrap();
    assert_eq!((answer.reached, answer.limit), (false, Some(Limit::Workspace)));
    for step in &answer.way {
        let off = step.inputs.sources[0].pose.position - place;
        assert!(off.amax() <= 0.004, "{off}");
    }
    // The nearest is at a corner or on a face: no corner bends more.
    let bent = steering.outputs().tip_angle;
    for corner in 0..8 {
        let mut inputs = scene.inputs.clone();
        for axis in 0..3 {
            inputs.sources[0].pose.position[axis] += if corner >> axis & 1 == 0 { 0.004 } else { -0.004 };
        }
        let there = solved(&scene).solve(&inputs).unwrap().tip_angle;
        assert!(there <= bent + 1e-6, "corner {corner}: {there}, {bent}");
    }
}

#[test]
fn the_distance_of_the_magnet_is_kept_and_told() {
    let scene = scene(3);
    let limits = Limits { distance: 0.08, ..Limits::default() };
    let mut steering = Steering::new(&scene, &[Move::MagnetPosition], limits).unwrap();
    let before = steering.outputs().magnetic_force;
    let answer = steering.to(&Target { force: Some(before * 20.0), ..Target::default() }).unwrap();
    assert_eq!((answer.reached, answer.limit), (false, Some(Limit::Distance)));
    let magnet = scene.sources.magnet().cloned().unwrap();
    let radius = scene.design().unwrap().largest_radius();
    for step in &answer.way {
        let pose = step.inputs.sources[0].pose;
        let local = |point: &Vector3<f64>| pose.rotation.tr_mul(&(point - pose.position));
        let nearest = step
            .outputs
            .shape
            .iter()
            .map(|point| magnet.distance(&local(point)))
            .fold(f64::INFINITY, f64::min);
        assert!(nearest - radius >= 0.08 - 1e-12, "{nearest}");
    }
    let close = answer.way.last().unwrap();
    assert!(close.outputs.magnetic_force.norm() > 1.5 * before.norm());
}

#[test]
fn the_margin_is_kept_and_told() {
    // The attraction of rings and helix pulls one segment shut as the magnet grows stronger.
    let text = "[design]\nsegments = 1\n[magnet]\nposition_mm = [0, -100, 3]\norientation_wxyz = [0.7071067811865476, -0.7071067811865476, 0.0, 0.0]\n[model]\ninteraction = \"full\"";
    let scene = Scene::parse(text, "margin").unwrap();
    let limits = Limits { margin: 0.3, ..Limits::default() };
    let mut steering = Steering::new(&scene, &[Move::MagnetStrength], limits).unwrap();
    let answer = steering.to(&angle(100.0)).unwrap();
    assert_eq!((answer.reached, answer.limit), (false, Some(Limit::Margin)));
    let margin = |step: &mcm::steer::Step| {
        let mut device = solved(&scene);
        device.solve(&step.inputs).unwrap();
        device.measure_margin().stability_margin
    };
    assert!(answer.way.iter().all(|step| margin(step) >= 0.3 - 1e-6));
    assert!(margin(answer.way.last().unwrap()) < 0.301);
    // Without that limit the fold itself stops it, before the snap.
    let strong = steering.inputs().sources[0].strength;
    let mut steering = Steering::new(&scene, &[Move::MagnetStrength], Limits::default()).unwrap();
    let answer = steering.to(&angle(100.0)).unwrap();
    assert!(matches!(answer.limit, Some(Limit::Snap | Limit::NoShape(_))), "{:?}", answer.limit);
    assert_walked(&solved(&scene), &answer.way);
    let last = answer.way.last().unwrap();
    assert!(margin(last) < 0.05 && last.inputs.sources[0].strength > strong, "{}", margin(last));
}

#[test]
fn the_field_and_the_shaft_have_their_limits() {
    let text = "[design]\nsegments = 1\n[field]\nuniform_mt = [0, 5, 0]\n[model]\ninteraction = \"rings\"";
    let scene = Scene::parse(text, "field").unwrap();
    let limits = Limits { field: Some(0.012), ..Limits::default() };
    let mut steering = Steering::new(&scene, &[Move::UniformField], limits).unwrap();
    let answer = steering.to(&angle(60.0)).unwrap();
    assert_eq!((answer.reached, answer.limit), (false, Some(Limit::Field)));
    assert!((steering.inputs().uniform_field.norm() - 0.012).abs() < 1e-6);
}

#[test]
fn what_nothing_can_keep_to_is_refused_with_a_reason() {
    let magnet = scene(1);
    let plain = Scene::parse("[design]\nsegments = 1", "plain").unwrap();
    let new = |scene: &Scene, moves: &[Move], limits: Limits| {
        Steering::new(scene, moves, limits).map(|_| ()).unwrap_err().to_string()
    };
    let fine = Limits::default;
    assert_eq!(new(&magnet, &[], fine()), "nothing may move");
    assert_eq!(new(&plain, &POSE, fine()), "`magnet.position` cannot be moved: the scene has no magnet");
    assert_eq!(
        new(&plain, &[Move::Insertion], fine()),
        "`feed.insertion` cannot be moved: the scene has no shaft"
    );
    let twice = [Move::UniformField, Move::UniformField];
    assert_eq!(new(&plain, &twice, fine()), "`field.uniform` is named twice");
    assert!(new(&magnet, &POSE, Limits { distance: f64::NAN, ..fine() }).contains("least distance"));
    assert!(new(&magnet, &POSE, Limits { margin: 1.0, ..fine() }).contains("from 0 to below 1"));
    assert!(new(&magnet, &POSE, Limits { step: 0.0, ..fine() }).contains("longest step"));
    assert!(new(&magnet, &POSE, Limits { distance: 0.2, ..fine() }).contains("already exceed a limit"));
    let [high, low] = [Vector3::repeat(0.1), Vector3::repeat(-0.1)];
    assert!(
        new(&magnet, &POSE, Limits { workspace: Some([high, low]), ..fine() }).contains("above its lowest")
    );
    let elsewhere = Limits { workspace: Some([low, Vector3::zeros()]), ..fine() };
    assert!(new(&magnet, &POSE, elsewhere).contains("edge of its workspace"));
    let refused = Move::named("coil.current", &magnet).unwrap_err().to_string();
    assert_eq!(refused, "`coil.current` cannot be moved: the scene has no coil");
    assert_eq!(Move::named("magnet.strength", &magnet).unwrap()[0].name(), "magnet.strength");
    let mut steering = Steering::new(&magnet, &POSE, fine()).unwrap();
    let mut to = |target: Target| steering.to(&target).unwrap_err().to_string();
    assert_eq!(to(Target::default()), "the target asks for nothing");
    assert!(to(angle(200.0)).contains("from 0 to pi"));
    assert!(to(Target { position: Some(Vector3::repeat(f64::NAN)), ..Target::default() }).contains("finite"));
    assert!(to(Target { direction: Some(Vector3::zeros()), ..Target::default() }).contains("> 0"));
    assert!(to(Target { direction: Some(Vector3::x()), ..angle(3.0) }).contains("not both"));
    let tolerances = Tolerances { position: 0.0, ..Tolerances::default() };
    assert!(steering.with_tolerances(tolerances).is_err());
}

//! Inputs that bring the tip to a target.

mod limits;
mod plans;
mod targets;

use mcm::manipulator::{Manipulator, Scene, Status};
use mcm::steer::{Answer, Step};
use nalgebra::Vector3;
use rand::{RngExt, SeedableRng, rngs::StdRng};

/// A device of so many segments above the paper's magnet pair, at the level `rings`.
fn scene(segments: usize) -> Scene {
    let text = format!(
        "[design]\nsegments = {segments}\n[magnet]\nposition_mm = [0.0, -120.0, {}]\n[model]\ninteraction = \"rings\"\n",
        3 * segments
    );
    Scene::parse(&text, "steer").unwrap()
}

/// Walks the steps of a way anew: none may snap, and all give the shapes told.
fn assert_walked(start: &Manipulator, way: &[Step]) {
    let mut device = start.clone();
    let snaps = device.outputs().snaps;
    for (number, step) in way.iter().enumerate() {
        let outputs = device.solve(&step.inputs).unwrap();
        assert_ne!(outputs.status, Status::NotSolved, "step {number}");
        assert_eq!(outputs.snaps, snaps, "step {number} snaps");
        let apart = (outputs.tip.position - step.outputs.tip.position).norm();
        assert!(apart < 1e-9, "step {number}: {apart}");
    }
}

/// The device of a scene, solved.
fn solved(scene: &Scene) -> Manipulator {
    let mut device = scene.manipulator(2).unwrap();
    assert_ne!(device.solve(&scene.inputs).unwrap().status, Status::NotSolved);
    device
}

fn reached(answer: &Answer) {
    assert!(answer.reached, "{:?} {:?}", answer.limit, answer.residual);
    let Answer { residual, .. } = answer;
    assert!(residual.position.is_none_or(|apart| apart <= 1e-6), "{residual:?}");
    assert!(residual.direction.is_none_or(|apart| apart <= 1e-4), "{residual:?}");
}

/// A source of random numbers from -1 to 1.
fn numbers(seed: u64) -> impl FnMut() -> f64 {
    let mut random = StdRng::seed_from_u64(seed);
    move || 2.0 * random.random::<f64>() - 1.0
}

/// A random vector in a cube of this half width.
fn vector(number: &mut impl FnMut() -> f64, half: f64) -> Vector3<f64> {
    Vector3::from_fn(|_, _| half * number())
}

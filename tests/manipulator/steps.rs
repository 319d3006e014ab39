//! Small steps along a branch: without a trace in memory, on the way or in what is told of stability.

use allocation_counter::measure;
use mcm::manipulator::{Inputs, Manipulator, Scene, Status};
use nalgebra::{Rotation3, Vector3};

use crate::tolerance::{KEPT_MARGIN, WAY};

/// Steps of a walk: further than a factorisation is kept.
const STEPS: u32 = 150;

/// What moves the manipulator, by step, at 1 kHz.
type Motion = fn(&mut Inputs, f64);

/// The exact pair passes at 0.1 m/s.
fn passing(inputs: &mut Inputs, step: f64) {
    inputs.sources[0].pose.position.z += 1e-4 * step;
}

/// A field of 20 mT turns at 100 deg/s.
fn turning(inputs: &mut Inputs, step: f64) {
    let turn = Rotation3::from_axis_angle(&Vector3::x_axis(), (0.1 * step).to_radians());
    inputs.uniform_field = turn * Vector3::new(0.0, 0.02, 0.0);
}

/// All levels with a verdict, by the exact pair and by a uniform field.
fn walks() -> impl Iterator<Item = (String, Scene, Motion)> {
    let levels = ["none", "rings", "full"].into_iter();
    levels.flat_map(|level| [1, 9].map(|segments| (level, segments))).flat_map(|(level, segments)| {
        let text = format!("[design]\nsegments = {segments}\n[model]\ninteraction = \"{level}\"\n");
        let beside = format!("{text}[magnet]\norientation_wxyz = [0, 1, 0, 0]\n");
        let walk = |name: &str, text: &str, motion: Motion| {
            (format!("S={segments} {level} {name}"), Scene::parse(text, "test scene").unwrap(), motion)
        };
        let closes = level == "full" && segments > 1; // across 20 mT it pulls itself shut
        [walk("pair", &beside, passing)].into_iter().chain((!closes).then(|| walk("uniform", &text, turning)))
    })
}

fn at(scene: &Scene, motion: Motion, step: u32) -> Inputs {
    let mut inputs = scene.inputs.clone();
    motion(&mut inputs, f64::from(step));
    inputs
}

fn solved(manipulator: &mut Manipulator, inputs: &Inputs) {
    assert_ne!(manipulator.solve(inputs).unwrap().status, Status::NotSolved);
}

#[test]
fn a_warm_step_allocates_nothing() {
    let mut factorisations = 0;
    for (name, scene, motion) in walks() {
        let mut manipulator = scene.manipulator(21).unwrap();
        // The first steps fill the storage.
        let path: Vec<Inputs> = (0..STEPS).map(|step| at(&scene, motion, step)).collect();
        let (first, rest) = path.split_at(10);
        for inputs in first {
            solved(&mut manipulator, inputs);
        }
        let mut margins = Vec::with_capacity(rest.len());
        let allocated = measure(|| {
            for inputs in rest {
                solved(&mut manipulator, inputs);
                margins.push(manipulator.outputs().stability_margin);
            }
        });
        margins.dedup();
        println!("{name}: {} factorisations in {} steps", margins.len(), rest.len());
        factorisations += margins.len() - 1;
        assert_eq!(allocated.count_total, 0, "{name}");
    }
    assert!(factorisations > 10, "steps with new factorisations are among them");
    // The counter counts.
    assert_eq!(measure(|| drop(std::hint::black_box(vec![0.0; 3]))).count_total, 1);
}

#[test]
fn what_is_told_after_many_steps_is_what_one_solve_tells() {
    for (name, scene, motion) in walks() {
        let mut manipulator = scene.manipulator(21).unwrap();
        let length = scene.design().unwrap().length();
        let (mut above, mut below, mut ways) = (0.0_f64, 0.0_f64, 0.0_f64);
        for step in 0..STEPS {
            let inputs = at(&scene, motion, step);
            solved(&mut manipulator, &inputs);
            let (told, tip) = (manipulator.outputs().stability_margin, manipulator.outputs().tip.position);
            if step % 7 == 6 {
                let measured = manipulator.clone().measure_margin().stability_margin;
                above = above.max(told / measured - 1.0);
                below = below.max(1.0 - told / measured);
                let mut direct = scene.manipulator(21).unwrap();
                solved(&mut direct, &inputs);
                ways = ways.max((direct.outputs().tip.position - tip).norm() / length);
            }
        }
        println!("{name}: margin {above:.1e} above, {below:.1e} below, tip within {ways:.1e} of the length");
        assert!(below <= KEPT_MARGIN, "{name}: {below}");
        assert!(ways <= WAY, "{name}: {ways}");
    }
}

//! Time of one solve, cold from the straight manipulator and warm as one of many input changes of one 1 kHz step, of all
//! derivatives there, and the error on a case with a closed form: `cargo bench --bench solve`.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::print_stdout,
    missing_docs,
    reason = "a program that stops when a scene is wrong; criterion's macros write undocumented items"
)]

#[path = "cpu_time.rs"]
mod cpu_time;

use std::time::Duration;

use cpu_time::CpuTime;

use criterion::{Criterion, criterion_group, criterion_main};
use mcm::design::Design;
use mcm::equilibrium::Settings;
use mcm::manipulator::{Inputs, Manipulator, Scene, Status};
use nalgebra::{Rotation3, Vector3};

/// Centreline points of the outputs, as many as the FMU has by default.
const SHAPE_POINTS: usize = 21;

/// Steps that a walk goes before it turns back: further than a factorisation is kept.
const STEPS: u32 = 100;

/// 20 mT across the manipulator; with every step the field turns by 0.1 deg (100 deg/s).
fn uniform(scene: &Scene) -> Vec<Inputs> {
    let field = Vector3::new(0.0, 0.02, 0.0);
    walk(|step| {
        let turn = Rotation3::from_axis_angle(&Vector3::x_axis(), (0.1 * step).to_radians());
        Inputs { uniform_field: turn * field, ..scene.inputs.clone() }
    })
}

/// The paper's pair at 120 mm; with every step it moves by 0.1 mm along the manipulator (0.1 m/s).
const PAIR: &str = "[magnet]\norientation_wxyz = [0, 1, 0, 0]";

fn passing(scene: &Scene) -> Vec<Inputs> {
    walk(|step| {
        let mut inputs = scene.inputs.clone();
        inputs.sources[0].pose.position.z += 1e-4 * step;
        inputs
    })
}

/// The inputs of all steps forth and back.
fn walk(at: impl Fn(f64) -> Inputs) -> Vec<Inputs> {
    (0..STEPS).chain((1..=STEPS).rev()).map(|step| at(f64::from(step))).collect()
}

fn scene(segments: usize, interaction: &str, field: &str) -> Scene {
    let text = format!(
        "{field}\n[design]\nsegments = {segments}\n[model]\ninteraction = \"{interaction}\"\ntime_budget_s = 60"
    );
    Scene::parse(&text, "bench").expect("a valid scene")
}

fn checked_solve(manipulator: &mut Manipulator, inputs: &Inputs) -> f64 {
    let outputs = manipulator.solve(inputs).expect("valid inputs");
    assert!(outputs.status != Status::NotSolved, "not solved");
    outputs.tip_angle
}

fn measure(criterion: &mut Criterion<CpuTime>, name: &str, scene: &Scene, path: &[Inputs]) {
    let mut manipulator = scene.manipulator(SHAPE_POINTS).expect("a valid design");
    criterion.bench_function(&format!("cold {name}"), |b| {
        b.iter(|| {
            manipulator.reset();
            checked_solve(&mut manipulator, &path[0])
        });
    });
    warm(criterion, &format!("warm {name}"), &mut manipulator, path);
    criterion.bench_function(&format!("jacobian {name}"), |b| {
        b.iter(|| manipulator.jacobian().expect("no fold"));
    });
}

fn warm(criterion: &mut Criterion<CpuTime>, name: &str, manipulator: &mut Manipulator, path: &[Inputs]) {
    let mut inputs = path.iter().cycle();
    criterion.bench_function(name, |b| {
        b.iter(|| checked_solve(manipulator, inputs.next().expect("no end")));
    });
}

fn solve(criterion: &mut Criterion<CpuTime>) {
    for segments in [1, 3, 9] {
        for interaction in ["none", "rings", "full"] {
            // Across 20 mT the longer ones pull themselves shut.
            if segments == 1 || interaction != "full" {
                let name = format!("S={segments} {interaction} uniform");
                let in_field = scene(segments, interaction, "[field]");
                measure(criterion, &name, &in_field, &uniform(&in_field));
            }
            let beside = scene(segments, interaction, PAIR);
            measure(criterion, &format!("S={segments} {interaction} pair"), &beside, &passing(&beside));
        }
        let beside = scene(segments, "auto", PAIR);
        measure(criterion, &format!("S={segments} auto pair"), &beside, &passing(&beside));
    }
}

/// What a control loop may ask for: a setting for it, its worst error along the walk, and its time.
fn targets(criterion: &mut Criterion<CpuTime>) {
    let uniform_scene = scene(1, "rings", "[field]");
    target(criterion, "S=1 rings uniform, 0.1 mm", &uniform_scene, &uniform(&uniform_scene), COARSE);
    let passed = scene(9, "rings", PAIR);
    target(criterion, "S=9 rings pair, 0.1 mm", &passed, &passing(&passed), COARSE);
    let passed = scene(9, "full", PAIR);
    target(criterion, "S=9 full pair, 1 um", &passed, &passing(&passed), MICROMETRE);
    target(criterion, "S=9 full pair, 1e-3 of the length", &passed, &passing(&passed), THOUSANDTH);
}

/// For 0.1 mm and 0.1 deg at the tip of nine segments.
const COARSE: fn(&mut Settings) = |settings| {
    (settings.degree, settings.pair_accuracy, settings.tolerance) = (0, 9e-2, 1e-5);
    *settings = settings.as_discretised();
};

/// For 1 um.
const MICROMETRE: fn(&mut Settings) = |settings| {
    (settings.pair_accuracy, settings.tolerance) = (1e-4, 1e-6);
    *settings = settings.as_discretised();
};

/// For a thousandth of the length and 0.1 deg.
const THOUSANDTH: fn(&mut Settings) = |settings| {
    (settings.pair_accuracy, settings.tolerance) = (3e-4, 1e-6);
    *settings = settings.as_discretised();
};

/// What those are compared with.
const RICHEST: fn(&mut Settings) = |settings| {
    *settings = Settings { degree: 4, pair_accuracy: 1e-7, ..settings.as_discretised() };
};

fn target(
    criterion: &mut Criterion<CpuTime>,
    name: &str,
    scene: &Scene,
    path: &[Inputs],
    set: fn(&mut Settings),
) {
    let manipulator = |set: fn(&mut Settings)| {
        let mut scene = scene.clone();
        set(&mut scene.settings);
        scene.manipulator(SHAPE_POINTS).expect("a valid design")
    };
    let (mut cheap, mut rich) = (manipulator(set), manipulator(RICHEST));
    let (mut distance, mut angle) = (0.0_f64, 0.0_f64);
    let mut iterations = 0;
    for (step, inputs) in path.iter().enumerate() {
        checked_solve(&mut cheap, inputs);
        iterations += cheap.outputs().iterations;
        if step % 20 != 0 {
            continue;
        }
        checked_solve(&mut rich, inputs);
        let (tip, exact) = (cheap.outputs().tip, rich.outputs().tip);
        distance = distance.max((tip.position - exact.position).norm());
        angle = angle.max(tip.axis().angle(&exact.axis()));
    }
    let mean = f64::from(iterations) / path.len() as f64;
    println!(
        "target {name}: tip within {distance:.2e} m, {:.2e} deg, told {:.2e} m, degree {}, {mean:.1} corrections",
        angle.to_degrees(),
        cheap.outputs().error_estimate,
        cheap.outputs().degree
    );
    warm(criterion, &format!("target {name}"), &mut cheap, path);
}

/// Time to make a solver.
fn making(criterion: &mut Criterion<CpuTime>) {
    for interaction in ["rings", "full", "auto"] {
        for segments in [1, 9] {
            let scene = scene(segments, interaction, PAIR);
            criterion.bench_function(&format!("make S={segments} {interaction}"), |b| {
                b.iter(|| scene.manipulator(SHAPE_POINTS).expect("a valid design"));
            });
        }
    }
}

/// Time against the number of segments.
fn growth(criterion: &mut Criterion<CpuTime>) {
    for interaction in ["none", "rings", "full"] {
        for segments in [1, 2, 4, 9, 16, 32] {
            let scene = scene(segments, interaction, "[field]");
            let path: Vec<Inputs> = uniform(&scene)
                .into_iter()
                .map(|inputs| Inputs { uniform_field: inputs.uniform_field * 0.05, ..inputs })
                .collect();
            let mut manipulator = scene.manipulator(SHAPE_POINTS).expect("a valid design");
            checked_solve(&mut manipulator, &path[0]);
            warm(criterion, &format!("growth S={segments} {interaction}"), &mut manipulator, &path);
        }
    }
}

/// One segment without magnetic particles: only the tip ring feels the field, the moment is the same everywhere, and
/// the angle solves `theta = Lam sin(phi - theta)`.
fn tip_dipole(criterion: &mut Criterion<CpuTime>) {
    let text = "[design]\nsegments = 1\nbase_magnet = false\n[design.helix]\nparticle_remanence_t = 0.0\n\
                [model]\ninteraction = \"none\"";
    let mut scene = Scene::parse(text, "tip dipole").expect("a valid scene");
    // The moment is the same everywhere: constant strains are exact.
    scene.settings.degree = 0;
    let path = uniform(&scene);
    let mut manipulator = scene.manipulator(SHAPE_POINTS).expect("a valid design");
    let theta = checked_solve(&mut manipulator, &path[0]);
    let error = (theta - closed_form(&scene.design().expect("a valid design"), 0.02)).abs();
    println!("tip dipole: error of the angle {error:.2e} rad");
    measure(criterion, "tip dipole", &scene, &path);
}

/// Angle (rad) in a perpendicular field (T): Newton on `theta = Lam cos(theta)`.
fn closed_form(design: &Design, field: f64) -> f64 {
    let ring = design.rings().next().expect("a tip ring");
    let section = ring.outer_radius.powi(2) - ring.inner_radius.powi(2);
    let moment =
        ring.remanence / mcm::constants::VACUUM_PERMEABILITY * core::f64::consts::PI * section * ring.length;
    let spans = design.segments().iter().flat_map(|segment| &segment.spans);
    let lambda = moment * field * spans.map(|span| span.length / span.stiffness.bending).sum::<f64>();
    (0..50).fold(0.5, |theta: f64, _| theta - (theta - lambda * theta.cos()) / (1.0 + lambda * theta.sin()))
}

criterion_group! {
    name = benches;
    config = Criterion::default()
        .with_measurement(CpuTime)
        .without_plots()
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_secs(1))
        .sample_size(20);
    targets = tip_dipole, making, targets, solve, growth
}
criterion_main!(benches);

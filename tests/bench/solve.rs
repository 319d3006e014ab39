//! Time of one solve, cold from the unloaded shape and warm after an input change of one 1 kHz step, of all derivatives
//! there, and the error on a case with a closed form: `cargo bench --bench solve`.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::print_stdout,
    missing_docs,
    reason = "a program that stops when a scene is wrong; criterion's macros write undocumented items"
)]

use std::time::Duration;

use criterion::{Criterion, criterion_group, criterion_main};
use mcm::design::Design;
use mcm::manipulator::{Inputs, Manipulator, Scene, Status};
use nalgebra::{Rotation3, Vector3};

/// Centreline points of the outputs, as many as the FMU has by default.
const SHAPE_POINTS: usize = 21;

/// 20 mT across the manipulator; one step later the field has turned by 0.1 deg (100 deg/s).
fn uniform() -> (&'static str, [Vector3<f64>; 2]) {
    let field = Vector3::new(0.0, 0.02, 0.0);
    ("[field]", [field, Rotation3::from_axis_angle(&Vector3::x_axis(), 0.1_f64.to_radians()) * field])
}

/// The paper's pair at 120 mm; one step later it is 0.1 mm further along the manipulator (0.1 m/s).
const PAIR: &str = "[magnet]\norientation_wxyz = [0, 1, 0, 0]";
const PAIR_STEP: f64 = 1e-4;

fn scene(segments: usize, interaction: &str, field: &str) -> Scene {
    let text = format!("{field}\n[design]\nsegments = {segments}\n[model]\ninteraction = \"{interaction}\"");
    Scene::parse(&text, "bench").expect("a valid scene")
}

fn checked_solve(manipulator: &mut Manipulator, inputs: &Inputs) -> f64 {
    let outputs = manipulator.solve(inputs).expect("valid inputs");
    assert!(outputs.status != Status::NotSolved, "not solved");
    outputs.tip_angle
}

fn measure(criterion: &mut Criterion, name: &str, scene: &Scene, inputs: &[Inputs; 2]) {
    let mut manipulator = scene.manipulator(SHAPE_POINTS).expect("a valid design");
    criterion.bench_function(&format!("cold {name}"), |b| {
        b.iter(|| {
            manipulator.reset();
            checked_solve(&mut manipulator, &inputs[0])
        });
    });
    let mut turn = 0;
    criterion.bench_function(&format!("warm {name}"), |b| {
        b.iter(|| {
            turn = 1 - turn;
            checked_solve(&mut manipulator, &inputs[turn])
        });
    });
    criterion.bench_function(&format!("jacobian {name}"), |b| {
        b.iter(|| manipulator.jacobian().expect("no fold"));
    });
}

fn solve(criterion: &mut Criterion) {
    for segments in [1, 3, 9] {
        for interaction in ["none", "rings"] {
            let (table, fields) = uniform();
            let in_field = scene(segments, interaction, table);
            let inputs = fields.map(|uniform_field| Inputs { uniform_field, ..in_field.inputs.clone() });
            measure(criterion, &format!("S={segments} {interaction} uniform"), &in_field, &inputs);

            let beside = scene(segments, interaction, PAIR);
            let mut moved = beside.inputs.clone();
            moved.magnet.position.z += PAIR_STEP;
            let inputs = [beside.inputs.clone(), moved];
            measure(criterion, &format!("S={segments} {interaction} pair"), &beside, &inputs);
        }
    }
}

/// One segment without magnetic particles: only the tip ring feels the field, the moment is the same everywhere, and
/// the angle solves `theta = Lam sin(phi - theta)`.
fn tip_dipole(criterion: &mut Criterion) {
    let text = "[design]\nsegments = 1\nbase_magnet = false\n[design.helix]\nparticle_remanence_t = 0.0\n\
                [model]\ninteraction = \"none\"";
    let mut scene = Scene::parse(text, "tip dipole").expect("a valid scene");
    // The moment is the same everywhere: constant strains are exact.
    scene.settings.degree = 0;
    let inputs = uniform().1.map(|uniform_field| Inputs { uniform_field, ..scene.inputs.clone() });
    let mut manipulator = scene.manipulator(SHAPE_POINTS).expect("a valid design");
    let theta = checked_solve(&mut manipulator, &inputs[0]);
    let error = (theta - closed_form(&scene.design().expect("a valid design"), 0.02)).abs();
    println!("tip dipole: error of the angle {error:.2e} rad");
    measure(criterion, "tip dipole", &scene, &inputs);
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
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_secs(1))
        .sample_size(20);
    targets = tip_dipole, solve
}
criterion_main!(benches);

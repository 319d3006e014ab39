//! What the relative tolerance of the tip costs: time of a step of level `auto` with it, beside that without it, along the same paths in one
//! run, and how far both are from a converged model.
//!
//! `cargo run --release --example tolerance`

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a program that tells what it measures")]

use cpu_time::ThreadTime;
use mcm::equilibrium::{Interaction, Settings};
use mcm::geometry::RotationVector;
use mcm::manipulator::{Inputs, Manipulator, Scene};
use nalgebra::Vector3;

/// Steps forth, and as many back.
const STEPS: u32 = 100;

/// Number of times that a path is timed; the fastest run counts.
const ROUNDS: usize = 5;

/// Tolerances relative to the way of the tip: none, and the default.
const RELATIVE: [f64; 2] = [0.0, 1e-3];

/// Name of a path, its scene, how the magnet moves in all (m), and by how much the field turns in all (rad).
const PATHS: [(&str, &str, [f64; 3], f64); 8] = [
    (
        "1 segment, 10 mT turning by 90 deg",
        "[design]\nsegments = 1\n[field]\nuniform_mt = [0, 10, 0]",
        [0.0; 3],
        1.57,
    ),
    (
        "1 segment, pair at 120 mm passing",
        "[design]\nsegments = 1\n[magnet]\nposition_mm = [0, -120, -5]",
        [0.0, 0.0, 0.02],
        0.0,
    ),
    (
        "3 segments, pair at 120 mm passing",
        "[design]\nsegments = 3\n[magnet]\nposition_mm = [0, -120, 0]",
        [0.0, 0.0, 0.02],
        0.0,
    ),
    (
        "9 segments, pair at 130 mm passing",
        "[design]\nsegments = 9\n[magnet]\nposition_mm = [0, -130, 15]",
        [0.0, 0.0, 0.02],
        0.0,
    ),
    (
        "3 segments, pair at 300 mm passing",
        "[design]\nsegments = 3\n[magnet]\nposition_mm = [0, -300, 0]",
        [0.0, 0.0, 0.05],
        0.0,
    ),
    (
        "9 segments, pair at 300 mm passing",
        "[design]\nsegments = 9\n[magnet]\nposition_mm = [0, -300, 15]",
        [0.0, 0.0, 0.05],
        0.0,
    ),
    (
        "3 segments, no spirals, 1 mT turning by 90 deg",
        "[design]\nsegments = 3\nspiral = \"axisymmetric\"\n[field]\nuniform_mt = [0, 1, 0]",
        [0.0; 3],
        1.57,
    ),
    (
        "a rod of 40 mm, pair at 150 mm passing",
        "[design]\nkind = \"cylinder\"\nlength_mm = 40\nradius_mm = 1\n[magnet]\nposition_mm = [0, -150, 15]",
        [0.0, 0.0, 0.02],
        0.0,
    ),
];

fn main() {
    println!(
        "| path | way of the tip (mm) | without (us) | with (us) | ratio | error without (um) | error with (um) |"
    );
    println!("| --- | --- | --- | --- | --- | --- | --- |");
    for (name, text, moved, turned) in PATHS {
        let scene = Scene::parse(text, name).unwrap();
        let path: Vec<Inputs> = (0..STEPS)
            .chain((1..=STEPS).rev())
            .map(|step| later(&scene.inputs, moved, turned, step))
            .collect();
        let mut devices = RELATIVE.map(|relative| {
            let settings = Settings { tolerance_relative: relative, ..scene.settings };
            Scene { settings, ..scene.clone() }.manipulator(2).unwrap()
        });
        let (errors, ways) = errors(&scene, &mut devices, &path);
        let mut times = [f64::INFINITY; 2];
        for _ in 0..ROUNDS {
            for (device, time) in devices.iter_mut().zip(&mut times) {
                let begin = ThreadTime::now();
                for inputs in &path {
                    device.solve(inputs).unwrap();
                }
                *time = time.min(begin.elapsed().as_secs_f64() * 1e6 / path.len() as f64);
            }
        }
        println!(
            "| {name} | {:.2} to {:.2} | {:.0} | {:.0} | {:.2} | {:.2} | {:.2} |",
            ways[0] * 1e3,
            ways[1] * 1e3,
            times[0],
            times[1],
            times[1] / times[0],
            errors[0] * 1e6,
            errors[1] * 1e6
        );
    }
}

/// The inputs at a step.
fn later(start: &Inputs, moved: [f64; 3], turned: f64, step: u32) -> Inputs {
    let part = f64::from(step) / f64::from(STEPS);
    let mut out = start.clone();
    out.sources[0].pose.position += Vector3::from(moved) * part;
    out.uniform_field = RotationVector::new(Vector3::x() * (turned * part)).matrix() * out.uniform_field;
    out
}

/// Largest errors of the devices along the path, and the shortest and longest way of the tip, m.
fn errors(scene: &Scene, devices: &mut [Manipulator; 2], path: &[Inputs]) -> ([f64; 2], [f64; 2]) {
    let exact = Settings {
        interaction: Interaction::Full,
        bending_stop: Some(true),
        degree: 6,
        pair_accuracy: 1e-9,
        ..scene.settings
    };
    let mut exact = Scene { settings: exact.as_discretised(), ..scene.clone() }.manipulator(2).unwrap();
    let straight = Vector3::z() * scene.design().unwrap().length();
    let (mut errors, mut ways) = ([0.0_f64; 2], [f64::INFINITY, 0.0]);
    for inputs in path {
        let tip = exact.solve(inputs).unwrap().tip.position;
        let way = (tip - straight).norm();
        ways = [way.min(ways[0]), way.max(ways[1])];
        for (device, error) in devices.iter_mut().zip(&mut errors) {
            *error = error.max((device.solve(inputs).unwrap().tip.position - tip).norm());
        }
    }
    (errors, ways)
}

//! Are targets met that can be reached? Tips of random poses of the magnet, asked for from the scene's pose.
//!
//! `cargo run --release --example targets [count of each number of segments] [seed]`

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a program that tells what it finds")]

use std::time::Instant;

use mcm::geometry::RotationVector;
use mcm::manipulator::{Manipulator, Scene, Status};
use mcm::steer::{Limits, Move, Steering, Step, Target};
use nalgebra::Vector3;
use rand::{RngExt, SeedableRng, rngs::StdRng};

/// Distance of the magnet from its place (m), and its turn (rad), at most, along each axis.
const AROUND: [f64; 2] = [0.02, 0.5];

/// Distance of the magnet from the target before (m), and its turn from there (rad), at most, of targets asked for from that one.
const NEAR: [f64; 2] = [1e-4, 1e-3];

fn main() {
    let numbers: Vec<u64> = std::env::args().skip(1).map(|text| text.parse().unwrap()).collect();
    let (count, seed) = (numbers.first().copied().unwrap_or(334), numbers.get(1).copied().unwrap_or(1));
    println!(
        "| segments | targets | met | missed | unreported snaps | steps | from the scene's pose (ms) | longest | warm (ms) |"
    );
    println!("| --- | --- | --- | --- | --- | --- | --- | --- | --- |");
    for segments in [1, 3, 9] {
        let text = format!(
            "[design]\nsegments = {segments}\n[magnet]\nposition_mm = [0.0, -120.0, {}]\n[model]\ninteraction = \"rings\"\n",
            3 * segments
        );
        let scene = Scene::parse(&text, "targets").unwrap();
        let mut random = StdRng::seed_from_u64(seed + segments);
        let moves = [Move::MagnetPosition, Move::MagnetOrientation];
        let rest = Steering::new(&scene, &moves, Limits::default()).unwrap();
        let mut device = scene.manipulator(2).unwrap();
        device.solve(&scene.inputs).unwrap();
        let (mut times, mut warm, mut steps, mut unreported, mut met) =
            (Vec::new(), Vec::new(), Vec::new(), 0, 0);
        while times.len() < usize::try_from(count).unwrap() {
            let Some(target) = beside(&device, &scene.inputs, AROUND, &mut random) else { continue };
            let mut steering = rest.clone();
            let started = Instant::now();
            let answer = steering.to(&target).unwrap();
            times.push(started.elapsed().as_secs_f64() * 1e3);
            steps.push(answer.way.len());
            unreported += usize::from(snaps(&device, &answer.way));
            if !answer.reached {
                println!("missed: {:?}, {:?}", answer.limit, answer.residual);
                continue;
            }
            met += 1;
            let mut there = device.clone();
            for step in &answer.way {
                there.solve(&step.inputs).unwrap();
            }
            for _ in 0..5 {
                let Some(near) = beside(&there, steering.inputs(), NEAR, &mut random) else { continue };
                let started = Instant::now();
                let answer = steering.to(&near).unwrap();
                warm.push(started.elapsed().as_secs_f64() * 1e3);
                assert!(answer.reached, "{:?}", answer.limit);
            }
        }
        times.sort_by(f64::total_cmp);
        warm.sort_by(f64::total_cmp);
        steps.sort_unstable();
        println!(
            "| {segments} | {count} | {met} | {} | {unreported} | {} | {:.1} | {:.0} | {:.2} |",
            times.len() - met,
            steps[steps.len() / 2],
            times[times.len() / 2],
            times[times.len() - 1],
            warm[warm.len() / 2]
        );
    }
}

/// The tip for a magnet moved at random from these inputs; `None` where the way there snaps or leads nowhere.
fn beside(
    device: &Manipulator,
    inputs: &mcm::manipulator::Inputs,
    [far, turned]: [f64; 2],
    random: &mut StdRng,
) -> Option<Target> {
    let mut vector = |half: f64| Vector3::from_fn(|_, _| half * (2.0 * random.random::<f64>() - 1.0));
    let mut there = inputs.clone();
    there.sources[0].pose.position += vector(far);
    there.sources[0].pose.rotation =
        RotationVector::new(vector(turned)).matrix() * there.sources[0].pose.rotation;
    let mut device = device.clone();
    let outputs = device.solve(&there).unwrap();
    let (position, direction) = (Some(outputs.tip.position), Some(outputs.tip.axis()));
    (outputs.status == Status::Solved).then(|| Target { position, direction, ..Target::default() })
}

/// Whether a way snaps, or has no shape, in steps a quarter as long.
fn snaps(device: &Manipulator, way: &[Step]) -> bool {
    let mut device = device.clone();
    let before = device.outputs().snaps;
    let mut from = None;
    for step in way {
        for part in 1..=4 {
            let start = from.as_ref().unwrap_or(&step.inputs);
            let inputs = mcm::manipulator::Inputs::between(start, &step.inputs, 0.25 * f64::from(part));
            if device.solve(&inputs).unwrap().status == Status::NotSolved {
                return true;
            }
        }
        from = Some(step.inputs.clone());
    }
    device.outputs().snaps != before
}

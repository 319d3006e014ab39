//! Is a target called unreachable that is not? Tips of random poses of the magnet, asked for from other random poses, with limits and without.
//!
//! A target counts as reachable where the straight path of the magnet leads to its pose without a snap and within the limits.
//!
//! `cargo run --release --example reachable [count] [seed]`

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a program that tells what it finds")]

use mcm::geometry::RotationVector;
use mcm::magnetics::Source;
use mcm::manipulator::{Inputs, Manipulator, Outputs, Scene, Status};
use mcm::steer::{Limits, Move, Steering, Target};
use nalgebra::Vector3;
use rand::{RngExt, SeedableRng, rngs::StdRng};

/// Distance of the magnet from its place (m), and its turn (rad), at most, along each axis.
const AROUND: [f64; 2] = [0.04, 0.5];

/// Number of steps of the straight path that are checked.
const STEPS: u32 = 40;

fn main() {
    let numbers: Vec<u64> = std::env::args().skip(1).map(|text| text.parse().unwrap()).collect();
    let (count, seed) = (numbers.first().copied().unwrap_or(200), numbers.get(1).copied().unwrap_or(1));
    let mut random = StdRng::seed_from_u64(seed);
    println!("| segments | asked | limits | targets | met | steps, median | most |");
    println!("| --- | --- | --- | --- | --- | --- | --- |");
    for segments in [1, 3, 9] {
        for directed in [false, true] {
            for limited in ["none", "60 mm apart", "box of 80 mm"] {
                row(segments, directed, limited, count.div_ceil(18), &mut random);
            }
        }
    }
}

/// Asks for so many targets and prints what became of them.
fn row(segments: u64, directed: bool, limited: &str, count: u64, random: &mut StdRng) {
    let text = format!(
        "[design]\nsegments = {segments}\n[magnet]\nposition_mm = [0.0, -120.0, {}]\n[model]\ninteraction = \"rings\"\n",
        3 * segments
    );
    let scene = Scene::parse(&text, "reachable").unwrap();
    let place = scene.inputs.sources[0].pose.position;
    let around = Vector3::repeat(AROUND[0]);
    let limits = match limited {
        "none" => Limits::default(),
        "60 mm apart" => Limits { distance: 0.06, ..Limits::default() },
        _ => Limits { workspace: Some([place - around, place + around]), ..Limits::default() },
    };
    let (mut steps, mut met) = (Vec::new(), 0);
    while steps.len() < usize::try_from(count).unwrap() {
        let [start, goal] = [(); 2].map(|()| moved(&scene.inputs, random));
        let Some(there) = led(&scene, &limits, &start, &goal) else { continue };
        let (position, direction) = (Some(there.tip.position), directed.then(|| there.tip.axis()));
        let target = Target { position, direction, ..Target::default() };
        let from = Scene { inputs: start.clone(), ..scene.clone() };
        let moves = [Move::MagnetPosition, Move::MagnetOrientation];
        let mut steering = Steering::new(&from, &moves, limits.clone()).unwrap();
        let answer = steering.to(&target).unwrap();
        steps.push(answer.way.len());
        met += usize::from(answer.reached);
        if !answer.reached {
            let quaternion = |inputs: &Inputs| inputs.sources[0].pose.quaternion();
            println!("missed: {:?}, {:?}", answer.limit, answer.residual);
            println!("    from {:?} {:?}", start.sources[0].pose.position.as_slice(), quaternion(&start));
            println!("    to {:?} {:?}", goal.sources[0].pose.position.as_slice(), quaternion(&goal));
        }
    }
    steps.sort_unstable();
    let asked = if directed { "position, direction" } else { "position" };
    let (median, most) = (steps[steps.len() / 2], steps[steps.len() - 1]);
    println!("| {segments} | {asked} | {limited} | {count} | {met} | {median} | {most} |");
}

/// The magnet at random near its place.
fn moved(inputs: &Inputs, random: &mut StdRng) -> Inputs {
    let mut vector = |half: f64| Vector3::from_fn(|_, _| half * (2.0 * random.random::<f64>() - 1.0));
    let mut out = inputs.clone();
    out.sources[0].pose.position += vector(AROUND[0]);
    out.sources[0].pose.rotation =
        RotationVector::new(vector(AROUND[1])).matrix() * out.sources[0].pose.rotation;
    out
}

/// The device at `goal` where the straight path leads there from `start` without a snap and at the distance that is asked for.
fn led(scene: &Scene, limits: &Limits, start: &Inputs, goal: &Inputs) -> Option<Outputs> {
    let magnet = scene.sources.magnet().cloned().unwrap();
    let radius = scene.design().unwrap().largest_radius();
    let mut device: Manipulator =
        scene.manipulator(2 * scene.design().unwrap().segments().len() + 2).unwrap();
    for step in 0..=STEPS {
        let inputs = Inputs::between(start, goal, f64::from(step) / f64::from(STEPS));
        let outputs = device.solve(&inputs).unwrap();
        let apart = gap(&magnet, &inputs, outputs) - radius;
        let stays = matches!(outputs.status, Status::Solved | Status::NearFold) && outputs.snaps == 0;
        if !stays || outputs.stable != Some(true) || apart < limits.distance {
            return None;
        }
    }
    Some(device.outputs().clone())
}

/// Distance of the device's centreline from the magnet, m.
fn gap(magnet: &Source, inputs: &Inputs, outputs: &Outputs) -> f64 {
    let pose = &inputs.sources[0].pose;
    let local = |point: &Vector3<f64>| pose.rotation.tr_mul(&(point - pose.position));
    outputs.shape.iter().map(|point| magnet.distance(&local(point))).fold(f64::INFINITY, f64::min)
}

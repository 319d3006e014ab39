//! Nanoseconds per field evaluation beside the crate magba, in rounds that alternate between both, the fastest round
//! of each kept: what other programs do on the machine drops out. `cargo run --release --example field_speed`.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::print_stdout,
    dead_code,
    reason = "a program that prints a table; it shares modules with the tests"
)]

#[path = "peer.rs"]
mod peer;
#[path = "../magnetics/reference.rs"]
mod reference;

use core::hint::black_box;
use std::time::Instant;

use mcm::magnetics::AxialSource;
use nalgebra::Vector3;

const ROUNDS: usize = 2000;
const PASSES: usize = 4;

/// Nanoseconds per point of one round.
fn time<T>(points: &[Vector3<f64>], evaluate: impl Fn(&Vector3<f64>) -> T) -> f64 {
    let start = Instant::now();
    for _ in 0..PASSES {
        for point in points {
            black_box(evaluate(black_box(point)));
        }
    }
    start.elapsed().as_secs_f64() * 1e9 / (PASSES * points.len()) as f64
}

fn measure(
    name: &str,
    source: &AxialSource,
    points: &[Vector3<f64>],
    other: impl Fn(&Vector3<f64>) -> [f64; 3],
) {
    let mut best = [f64::INFINITY; 4];
    for _ in 0..ROUNDS {
        let round = [
            time(points, |p| source.field(p)),
            time(points, |p| source.field_gradient(p)),
            time(points, |p| source.jet(p)),
            time(points, &other),
        ];
        best = core::array::from_fn(|i| best[i].min(round[i]));
    }
    let [field, gradient, jet, peer] = best;
    println!("| {name} | {field:.0} | {gradient:.0} | {jet:.0} | {peer:.0} |");
}

fn main() {
    println!("nanoseconds per point, fastest of {ROUNDS} alternating rounds");
    println!("| source | B | B and G | B, G and H | magba B |\n| --- | --- | --- | --- | --- |");
    let (ring, near) = (reference::ring(), peer::points(2.0e-3));
    measure("ring, 2 to 6 radii", &ring, &near, peer::ring);
    let far: Vec<_> = near.iter().map(|point| point * 8.0).collect();
    measure("ring, 17 to 48 radii", &ring, &far, peer::ring);
    let cylinder = AxialSource::new(0.0, 22.5e-3, 30.0e-3, 1.35).expect("allowed");
    measure("cylinder, 2 to 6 radii", &cylinder, &peer::points(22.5e-3), |p| {
        peer::cylinder(p, 22.5e-3, 30.0e-3)
    });
}

//! Poses per second of `Manipulator::solve_many`: many poses of the magnet around the last one, on one core and on all.
//!
//! `cargo run --release --example many`
#![allow(clippy::print_stdout, reason = "what it prints is its result")]

use std::error::Error;
use std::time::Instant;

use mcm::manipulator::{Manipulator, Outputs, Scene};
use nalgebra::Vector3;
use rayon::{ThreadPoolBuilder, current_num_threads};

/// Poses along each axis, and the distance (m) between two.
const ALONG: i32 = 6;
const STEP: f64 = 2e-3;

/// Number of runs; the fastest counts.
const RUNS: usize = 3;

/// Time (s) of all poses with this number of threads, and the answers.
fn timed(scene: &Scene, start: &Manipulator, threads: usize) -> Result<(f64, Vec<Outputs>), Box<dyn Error>> {
    let axis = || (0..ALONG).map(|k| STEP * (f64::from(k) - 0.5 * f64::from(ALONG - 1)));
    let mut inputs = Vec::new();
    for x in axis() {
        for (y, z) in axis().flat_map(|y| axis().map(move |z| (y, z))) {
            let mut pose = scene.inputs.clone();
            pose.sources[0].pose.position += Vector3::new(x, y, z);
            inputs.push(pose);
        }
    }
    let pool = ThreadPoolBuilder::new().num_threads(threads).build()?;
    let mut best = f64::INFINITY;
    let mut answers = Vec::new();
    for _ in 0..RUNS {
        let begin = Instant::now();
        answers = pool.install(|| start.solve_many(&inputs))?;
        best = best.min(begin.elapsed().as_secs_f64());
    }
    Ok((best, answers))
}

fn main() -> Result<(), Box<dyn Error>> {
    let cores = current_num_threads();
    println!("| segments | level | poses per second, one core | {cores} cores | of {cores} times one |");
    println!("| --- | --- | --- | --- | --- |");
    for segments in [1, 3, 9] {
        for level in ["none", "rings", "full", "auto"] {
            let magnet = "[magnet]\norientation_wxyz = [0, 1, 0, 0]";
            let model = format!("[model]\ninteraction = \"{level}\"\ntime_budget_s = 60");
            let scene = Scene::parse(&format!("{magnet}\n[design]\nsegments = {segments}\n{model}"), "many")?;
            let mut start = scene.manipulator(21)?;
            start.solve(&scene.inputs)?;
            let ((alone, first), (together, second)) =
                (timed(&scene, &start, 1)?, timed(&scene, &start, cores)?);
            assert!(first == second, "the number of threads changes the answers");
            let count = first.len() as f64;
            println!(
                "| {segments} | `{level}` | {:.0} | {:.0} | {:.0} % |",
                count / alone,
                count / together,
                100.0 * alone / together / cores as f64
            );
        }
    }
    Ok(())
}

//! How often the intervals of `mcm fit` hold the truth, and how long a fit takes.
//!
//! `cargo run --release --example fit coverage 1000` and `cargo run --release --example fit time`
#![allow(clippy::print_stdout, reason = "what it prints is its result")]

use std::error::Error;
use std::time::Instant;

use mcm::fit::{Fit, Measurable, Measurements, Settings};
use mcm::manipulator::SceneFile;
use rand::RngExt;
use rand::SeedableRng;
use rand::rngs::StdRng;

const SCENE: &str = "[design]\nsegments = 1\n[field]\n[model]\ninteraction = \"rings\"";
const FIELD: &str = "field.uniform_mt[2]";
const OUTPUTS: [&str; 2] = ["tip_y_mm", "tip_z_mm"];
const TRUTH: [(&str, f64); 2] = [("design.helix.shore_a", 33.0), ("design.helix.length_mm", 4.0)];

/// Standard deviation of a measured value, mm.
const NOISE: f64 = 0.05;

/// Runs of which the fastest counts.
const RUNS: usize = 20;

/// A standard normal number (G. E. P. Box and M. E. Muller, Ann. Math. Stat. 29 (1958) 610).
fn normal(random: &mut StdRng) -> f64 {
    let (a, b): (f64, f64) = (random.random_range(f64::MIN_POSITIVE..1.0), random.random_range(0.0..1.0));
    (-2.0 * a.ln()).sqrt() * (core::f64::consts::TAU * b).cos()
}

/// Rows of a device as in the scene, without noise.
fn exact(file: &SceneFile, count: i32) -> Result<Vec<[f64; 3]>, Box<dyn Error>> {
    (1..=count)
        .map(|step| {
            let field = 20.0 * f64::from(step) / f64::from(count);
            let scene = file.with(FIELD, field)?.scene()?;
            let mut manipulator = scene.manipulator(2)?;
            let outputs = manipulator.solve(&scene.inputs)?;
            let read = |name| Measurable::named(name).map_or(f64::NAN, |output| output.read(outputs));
            Ok([field, read(OUTPUTS[0]), read(OUTPUTS[1])])
        })
        .collect()
}

fn noisy(file: &SceneFile, rows: &[[f64; 3]], random: &mut StdRng) -> Result<Measurements, Box<dyn Error>> {
    let texts = rows.iter().map(|[field, y, z]| {
        [*field, y + NOISE * normal(random), z + NOISE * normal(random)].map(|value| value.to_string())
    });
    let texts: Vec<[String; 3]> = texts.collect();
    let cells = texts.iter().zip(2..).map(|(row, line)| (line, row.iter().map(String::as_str).collect()));
    Ok(Measurements::parse(file, &[FIELD, OUTPUTS[0], OUTPUTS[1]], cells)?)
}

fn coverage(fits: u32) -> Result<(), Box<dyn Error>> {
    let file = SceneFile::parse(SCENE, "fit")?;
    let rows = exact(&file, 4)?;
    let mut random = StdRng::seed_from_u64(1);
    let mut covered = [0_u32; 2];
    for _ in 0..fits {
        let measured = noisy(&file, &rows, &mut random)?;
        let fit = Fit::new(&file, &TRUTH.map(|(key, _)| key), &measured, &Settings::default())?;
        for (count, (parameter, (_, value))) in covered.iter_mut().zip(fit.parameters.iter().zip(TRUTH)) {
            let inside =
                matches!(parameter.interval, [Some(low), Some(high)] if low <= value && value <= high);
            *count += u32::from(inside);
        }
    }
    for ((key, _), count) in TRUTH.iter().zip(covered) {
        println!(
            "{key}: {:.1} % of {fits} intervals hold the truth",
            100.0 * f64::from(count) / f64::from(fits)
        );
    }
    Ok(())
}

fn time() -> Result<(), Box<dyn Error>> {
    let file = SceneFile::parse(SCENE, "fit")?;
    let start = file.with(TRUTH[0].0, 30.0)?.with(TRUTH[1].0, 4.2)?;
    let measured = noisy(&file, &exact(&file, 100)?, &mut StdRng::seed_from_u64(1))?;
    for profiles in [false, true] {
        let settings = Settings { profiles, ..Settings::default() };
        let mut best = f64::INFINITY;
        let mut steps = 0;
        for _ in 0..RUNS {
            let begin = Instant::now();
            steps = Fit::new(&start, &TRUTH.map(|(key, _)| key), &measured, &settings)?.steps;
            best = best.min(begin.elapsed().as_secs_f64());
        }
        println!("100 rows, 2 parameters, profiles {profiles}: {:.1} ms, {steps} steps", 1e3 * best);
    }
    Ok(())
}

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        ["coverage", fits] => coverage(fits.parse()?),
        ["time"] => time(),
        _ => Err("coverage FITS, or time".into()),
    }
}

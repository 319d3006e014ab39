//! Do intervals of 95 % cover the truth in 95 % of noisy fits, and how long does a fit take?
//!
//! `cargo run --release --example fits [number of fits] [seed]`

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a program that tells what it finds")]

use std::time::Instant;

use mcm::fit::{Data, Fit, Loss, Measured, Options, Quantity};
use mcm::manipulator::SceneFile;
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};

const KEYS: [&str; 2] = ["design.helix.shore_a", "design.ring.remanence_t"];
const INPUTS: [&str; 2] = ["field.uniform_mt[2]", "load.tip_force_n[2]"];
const MEASURED: [(&str, f64); 3] = [("alpha_deg", 0.3), ("tip_y_mm", 0.05), ("tip_z_mm", 0.05)];

/// One segment whose helix and rings have these hardness and remanence (T).
fn scene(hardness: f64, remanence: f64) -> SceneFile {
    let text = format!(
        "[design]\nsegments = 1\n[design.helix]\nshore_a = {hardness}\n[design.ring]\nremanence_t = {remanence}\n[field]\n\
         [model]\ninteraction = \"rings\"\n"
    );
    SceneFile::parse(&text, "fits").unwrap()
}

/// What the true device gives in each row of fields (mT) and forces across the tip (N).
fn answers(rows: &[[f64; 2]]) -> Vec<[f64; 3]> {
    let truth = scene(34.2, 1.31);
    let mut device = truth.scene().unwrap().manipulator(2).unwrap();
    let answer = |row: &[f64; 2]| {
        let loaded = truth.with(INPUTS[0], row[0]).unwrap().with(INPUTS[1], row[1]).unwrap();
        let outputs = device.solve(&loaded.scene().unwrap().inputs).unwrap();
        MEASURED.map(|(name, _)| Quantity::named(name).unwrap().read(outputs))
    };
    rows.iter().map(answer).collect()
}

/// A normal deviate (Box and Muller 1958, doi 10.1214/aoms/1177706645).
fn normal(random: &mut StdRng) -> f64 {
    let [radius, angle] = [random.random::<f64>(), random.random::<f64>()];
    (-2.0 * (1.0 - radius).ln()).sqrt() * (core::f64::consts::TAU * angle).cos()
}

/// The answers with noise, whose deviations may be said.
fn noisy(rows: &[[f64; 2]], answers: &[[f64; 3]], said: bool, random: &mut StdRng) -> Data {
    let mut data = Data::new(&scene(33.0, 1.35), &INPUTS).unwrap();
    for (row, answer) in rows.iter().zip(answers) {
        let each = |(value, (name, deviation)): (&f64, (&str, f64))| Measured {
            quantity: Quantity::named(name).unwrap(),
            value: value + deviation * normal(random),
            deviation: said.then_some(deviation),
        };
        let measured: Vec<Measured> = answer.iter().zip(MEASURED).map(each).collect();
        data.add(row, &measured).unwrap();
    }
    data
}

fn main() {
    let numbers: Vec<u64> = std::env::args().skip(1).map(|text| text.parse().unwrap()).collect();
    let (count, seed) = (numbers.first().copied().unwrap_or(1000), numbers.get(1).copied().unwrap_or(1));
    let rows: Vec<[f64; 2]> =
        (0..12).map(|row| [f64::from(row) * 1.5, if row % 2 == 0 { 0.0 } else { 0.02 }]).collect();
    let known = answers(&rows);
    println!("| noise | fits | parameter | covered by profiles | by 1.96 deviations | bias over deviation |");
    println!("| --- | --- | --- | --- | --- | --- |");
    for said in [true, false] {
        let mut random = StdRng::seed_from_u64(seed);
        let (mut profiles, mut ellipses, mut bias) = ([0.0; 2], [0.0; 2], [0.0; 2]);
        for _ in 0..count {
            let data = noisy(&rows, &known, said, &mut random);
            let fit = Fit::new(&scene(33.0, 1.35), &KEYS, &data, Options::default()).unwrap();
            for (index, truth) in [34.2, 1.31].into_iter().enumerate() {
                let (value, deviation) = (fit.values()[index], fit.deviations()[index]);
                let inside = fit.intervals()[index].is_some_and(|[low, high]| (low..=high).contains(&truth));
                profiles[index] += f64::from(u8::from(inside));
                ellipses[index] += f64::from(u8::from((value - truth).abs() < 1.96 * deviation));
                bias[index] += (value - truth) / deviation;
            }
        }
        for (index, key) in KEYS.iter().enumerate() {
            let part = |sum: f64| 100.0 * sum / count as f64;
            let noise = if said { "said" } else { "estimated" };
            println!(
                "| {noise} | {count} | `{key}` | {:.1} % | {:.1} % | {:+.2} |",
                part(profiles[index]),
                part(ellipses[index]),
                bias[index] / count as f64
            );
        }
    }
    let rows: Vec<[f64; 2]> = (0..100).map(|row| [0.2 * f64::from(row), 0.0]).collect();
    let known = answers(&rows);
    let data = noisy(&rows, &known, true, &mut StdRng::seed_from_u64(seed));
    let mut times: Vec<f64> = (0..20)
        .map(|_| {
            let started = Instant::now();
            let options = Options { loss: Loss::Squares, profiles: false };
            Fit::new(&scene(33.0, 1.35), &KEYS[..1], &data, options).unwrap();
            started.elapsed().as_secs_f64() * 1e3
        })
        .collect();
    times.sort_by(f64::total_cmp);
    println!("\n100 rows, one segment, one parameter: {:.0} ms (median of 20)", times[times.len() / 2]);
}

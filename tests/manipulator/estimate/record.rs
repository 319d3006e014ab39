//! The error that is told beside the error that is, on random scenes of every level, to be recorded:
//!
//! ```text
//! cargo run --release --example estimate 300 > estimate.csv    # scenes; the summary goes to stderr
//! cargo run --release --example estimate warm 40 > warm.csv    # ways of 48 warm steps of `auto`, 24 of them compared
//! ```
#![allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a place in a list")]
#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a broken scene stops the run")]
#![allow(clippy::print_stdout, clippy::print_stderr, reason = "tells what it measured")]
#![allow(unreachable_pub, missing_docs, reason = "a program")]

#[path = "../../given.rs"]
#[allow(dead_code, reason = "others take all of it")]
mod given;
mod scenes;
mod warm;

use mcm::equilibrium::Interaction;
use rayon::prelude::*;
use scenes::{ANOTHER_SHAPE, Scene, Told};
use warm::{Warm, Way};

/// Segments at most.
const SEGMENTS: usize = 9;

/// Segments at most on the ways.
const SEGMENTS_OF_WAYS: usize = 5;

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let count: u64 = arguments.last().map_or(300, |count| count.parse().unwrap());
    if arguments.len() == 2 && arguments[0] == "warm" {
        return warm_steps(count);
    }

    let told: Vec<Told> = (0..count)
        .into_par_iter()
        .filter_map(|number| Scene::random(number, SEGMENTS).told(number))
        .collect();
    println!("{}", Told::HEADER);
    for row in &told {
        println!("{}", row.line());
    }
    let (same, other): (Vec<Told>, Vec<Told>) = told.into_iter().partition(|row| row.error < ANOTHER_SHAPE);
    eprintln!("{} of {count} scenes solved, {} of them another shape", same.len() + other.len(), other.len());
    for (level, name, _) in Interaction::ALL {
        summarise(name, same.iter().filter(|row| row.level == *level));
    }
    summarise("all", same.iter());
}

fn warm_steps(ways: u64) {
    let told: Vec<Vec<Warm>> =
        (0..ways).into_par_iter().map(|number| Way::random(number, SEGMENTS_OF_WAYS).told(number)).collect();
    let told: Vec<Warm> = told.into_iter().flatten().collect();
    println!("{}", Warm::HEADER);
    for row in &told {
        println!("{}", row.line());
    }

    let count = |holds: &dyn Fn(&&Warm) -> bool| told.iter().filter(holds).count();
    let mut ratios: Vec<f64> = told.iter().map(|row| row.estimate / row.error).collect();
    ratios.sort_by(f64::total_cmp);
    let at = |part: f64| ratios[((ratios.len() - 1) as f64 * part).round() as usize];
    eprintln!(
        "{} warm steps: {} too pessimistic, of these {} below a fiftieth of the tolerance; error above the estimate in {}, \
         above the tolerance in {}; estimate over error: 1 % {:.2}, 10 % {:.2}, median {:.2}, 90 % {:.2}, 99 % {:.2}",
        told.len(),
        count(&|row| row.is_pessimistic()),
        count(&|row| row.is_pessimistic() && 50.0 * row.estimate < row.tolerance),
        count(&|row| row.error > row.estimate),
        count(&|row| row.error > row.tolerance),
        at(0.01),
        at(0.1),
        at(0.5),
        at(0.9),
        at(0.99)
    );
}

fn summarise<'a>(name: &str, rows: impl Iterator<Item = &'a Told>) {
    let rows: Vec<&Told> = rows.collect();
    if rows.is_empty() {
        return;
    }
    let share = |holds: &dyn Fn(&Told) -> bool| {
        100.0 * rows.iter().filter(|row| holds(row)).count() as f64 / rows.len() as f64
    };
    let mut ratios: Vec<f64> = rows.iter().map(|row| row.estimate / row.error).collect();
    ratios.sort_by(f64::total_cmp);
    let at = |part: f64| ratios[((ratios.len() - 1) as f64 * part).round() as usize];
    eprintln!(
        "{name:>10}: {:3} scenes, error below the estimate in {:.1} %, within the tolerance {:.1} %, told so {:.1} %; \
         estimate over error: 1 % {:.2}, 10 % {:.2}, median {:.2}, 90 % {:.2}",
        rows.len(),
        share(&|row| row.error <= row.estimate),
        share(&|row| row.error <= row.tolerance),
        share(&|row| row.estimate <= row.tolerance),
        at(0.01),
        at(0.1),
        at(0.5),
        at(0.9)
    );
}

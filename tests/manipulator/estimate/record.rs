//! The error that is told beside the error that is, on random scenes of every level, to be recorded:
//!
//! ```text
//! cargo run --release --example estimate 300 > estimate.csv    # scenes; the summary goes to stderr
//! ```
#![allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a place in a list")]
#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a broken scene stops the run")]
#![allow(clippy::print_stdout, clippy::print_stderr, reason = "tells what it measured")]
#![allow(unreachable_pub, missing_docs, reason = "a program")]

#[path = "../../given.rs"]
#[allow(dead_code, reason = "others take all of it")]
mod given;
mod scenes;

use mcm::equilibrium::Interaction;
use rayon::prelude::*;
use scenes::{ANOTHER_SHAPE, Scene, Told};

/// Segments at most.
const SEGMENTS: usize = 9;

fn main() {
    let count: u64 = std::env::args().nth(1).map_or(300, |count| count.parse().unwrap());
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

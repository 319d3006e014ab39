//! Snaps of random slow walks beside walks in steps a hundred times as fine:
//!
//! ```text
//! cargo run --release --example walks 1000     # so many ways; further: first number, seed
//! ```
//!
//! Every snap of the fine walk is told in the coarse one, in the step that contains it, and none else. The exit status tells.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a broken promise stops the run")]
#![allow(clippy::print_stdout, reason = "tells what it measured")]
#![allow(missing_docs, reason = "a program")]

#[path = "../given.rs"]
mod given;
#[path = "numbers.rs"]
mod numbers;
#[path = "../manipulator/walks/ways.rs"]
mod ways;

use std::process::ExitCode;
use std::time::Instant;

use numbers::Numbers;
use rayon::prelude::*;
use ways::{Comparison, Way};

/// Coarse steps of a way.
const STEPS: usize = 60;

fn main() -> ExitCode {
    let Some(Numbers { numbers, seed }) = Numbers::asked() else { return ExitCode::FAILURE };
    let start = Instant::now();
    let compared = numbers.into_par_iter().map(|index| {
        let comparison = Way::random(seed, index).compare(STEPS);
        if let Comparison::Differs(how) = &comparison {
            println!("DEFECT way {index}: {how}");
        }
        comparison
    });
    let compared: Vec<Comparison> = compared.collect();
    let number = |wanted: &dyn Fn(&Comparison) -> bool| compared.iter().filter(|c| wanted(c)).count();
    let unfit = number(&|c| *c == Comparison::Unfit);
    let plain = number(&|c| *c == Comparison::Alike(0));
    let differing = number(&|c| matches!(c, Comparison::Differs(_)));
    let ended = number(&|c| *c == Comparison::End);
    let snapped = compared.len() - unfit - plain - ended - differing;
    println!(
        "seed {seed}: {} ways in {:.0} s: {plain} without a snap, {snapped} with one and {ended} to an end alike, {unfit} not \
         slow, {differing} defects",
        compared.len(),
        start.elapsed().as_secs_f64()
    );
    if differing == 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

//! Folds and ends of random ramps, followed in three sizes of steps:
//!
//! ```text
//! cargo run --release --example ramps 1000     # so many ramps; further: first number, seed
//! ```
//!
//! All steps tell the same folds and come to the same end. The exit status tells.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a broken promise stops the run")]
#![allow(clippy::print_stdout, reason = "tells what it measured")]
#![allow(missing_docs, reason = "a program")]

#[allow(dead_code, reason = "scenes have magnets of their own")]
#[path = "../given.rs"]
mod given;
#[path = "numbers.rs"]
mod numbers;
#[path = "../manipulator/walks/ramps.rs"]
mod ramps;

use std::process::ExitCode;
use std::time::Instant;

use numbers::Numbers;
use ramps::{Ramp, Verdict};
use rayon::prelude::*;

fn main() -> ExitCode {
    let Some(Numbers { numbers, seed }) = Numbers::asked() else { return ExitCode::FAILURE };
    let start = Instant::now();

    let compared = numbers.into_par_iter().map(|index| {
        let ramp = Ramp::random(seed, index);
        let verdict = ramp.compare();
        if let Verdict::Differs(how) = &verdict {
            println!("DEFECT ramp {index}: {how}\n{ramp:?}");
        }
        verdict
    });
    let compared: Vec<Verdict> = compared.collect();

    let number = |wanted: &dyn Fn(&Verdict) -> bool| compared.iter().filter(|v| wanted(v)).count();
    let plain = number(&|v| *v == Verdict::Alike(0, false));
    let snapped = number(&|v| matches!(v, Verdict::Alike(1.., false)));
    let ended = number(&|v| matches!(v, Verdict::Alike(_, true)));
    let unfit = number(&|v| *v == Verdict::Unfit);
    let differing = number(&|v| matches!(v, Verdict::Differs(_)));
    println!(
        "seed {seed}: {} ramps in {:.0} s: {plain} without a fold, {snapped} with snaps and {ended} to an end alike, {unfit} \
         without a stable start, {differing} defects",
        compared.len(),
        start.elapsed().as_secs_f64()
    );
    if differing == 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

//! Random scenes, each solved cold and then along a few steps, and what the answers promise:
//!
//! ```text
//! cargo run --release --example million 1000000          # so many walks; further: first number, seed
//! cargo run --release --example million only 123 [SEED]  # one walk alone: its scenes and what was answered
//! ```
//!
//! Every output is a finite number, a solve ends within its processor time, nothing panics; of one walk in a hundred every
//! answer that is called stable is verified by independent eigenvalues and by a finer model. The exit status tells.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a broken promise stops the run")]
#![allow(clippy::print_stdout, reason = "tells what it measured")]
#![allow(missing_docs, reason = "a program")]

#[path = "../../given.rs"]
#[allow(dead_code, reason = "others take all of it")]
mod given;
mod promises;
mod scenes;
mod tally;
#[path = "../worst.rs"]
mod worst;

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::process::ExitCode;
use std::time::Instant;

use promises::try_walk;
use rayon::prelude::*;
use scenes::Walk;
use tally::Tally;
use worst::Defect;

/// Walks between two lines of progress.
const CHUNK: u64 = 5_000;

/// The seed unless another one is given.
const SEED: u64 = 20_260_101;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let number = |at: usize| arguments.get(at).and_then(|text| text.parse::<u64>().ok());
    if arguments.first().is_some_and(|word| word == "only") {
        let Some(index) = number(1) else { return usage() };
        let tally = attempt(number(2).unwrap_or(SEED), index, true);
        println!("{tally}");
        return ending(&tally);
    }
    let Some(count) = number(0) else { return usage() };
    let (first, seed) = (number(1).unwrap_or(0), number(2).unwrap_or(SEED));
    let (start, mut sum) = (Instant::now(), Tally::default());
    for chunk in (first..first + count).step_by(usize::try_from(CHUNK).expect("a small number")) {
        let walks = chunk..(chunk + CHUNK).min(first + count);
        let done = walks.into_par_iter().map(|index| attempt(seed, index, false));
        let more = done.reduce(Tally::default, Tally::with);
        for defect in &more.defects {
            println!("DEFECT walk {defect}");
        }
        sum = sum.with(more);
        println!("{} walks after {:.0} s", sum.walks, start.elapsed().as_secs_f64());
    }
    println!("seed {seed}, walks {first} to {}\n{sum}", first + count - 1);
    ending(&sum)
}

fn usage() -> ExitCode {
    println!("say: COUNT [FIRST [SEED]], or only NUMBER [SEED]");
    ExitCode::FAILURE
}

fn ending(tally: &Tally) -> ExitCode {
    if tally.defects.is_empty() { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

/// One walk; a panic is a defect.
fn attempt(seed: u64, index: u64, alone: bool) -> Tally {
    let walk = Walk::random(seed, index);
    let tried = catch_unwind(AssertUnwindSafe(|| try_walk(&walk, index, alone)));
    tried.unwrap_or_else(|_| {
        let mut tally = Tally::of_one_walk();
        tally.defects.push(Defect { index, step: 0, what: "panics".into() });
        tally
    })
}

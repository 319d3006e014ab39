//! Random devices pushed into random vessels:
//!
//! ```text
//! cargo run --release --example insertions 10000         # so many; further: first number, seed
//! cargo run --release --example insertions only 123 [SEED]
//! ```
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a broken promise stops the run")]
#![allow(clippy::print_stdout, reason = "tells what it measured")]
#![allow(missing_docs, reason = "a program")]

#[path = "../../given.rs"]
#[allow(dead_code, reason = "others take all of it")]
mod given;
#[path = "mod.rs"]
mod insertions;

use std::process::ExitCode;

use insertions::{SEED, Tally, attempt, attempt_all};

/// Insertions between two tables.
const CHUNK: u64 = 100;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let number = |at: usize| arguments.get(at).and_then(|text| text.parse::<u64>().ok());
    let (first, seed) = (number(1).unwrap_or(0), number(2).unwrap_or(SEED));
    if arguments.first().is_some_and(|word| word == "only") {
        let tally = attempt(seed, first, true);
        println!("{tally}");
        return ending(&tally);
    }
    let Some(count) = number(0) else {
        println!("say: COUNT [FIRST [SEED]], or only NUMBER [SEED]");
        return ExitCode::FAILURE;
    };
    let (mut sum, end) = (Tally::default(), first + count);
    let mut next = first;
    while next < end {
        let part = next..(next + CHUNK).min(end);
        next = part.end;
        sum = sum.with(attempt_all(seed, part));
        println!("seed {seed}, insertions {first} to {}\n{sum}\n", next - 1);
    }
    ending(&sum)
}

fn ending(tally: &Tally) -> ExitCode {
    if tally.defects.is_empty() { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

//! Random devices pushed into random vessels, and what the answers promise: nothing deeper in the wall than told, forces in
//! balance, jumps told, the last good shape kept, time kept.

mod promises;
mod scenes;
mod tally;
#[path = "../worst.rs"]
mod worst;

use std::panic::{AssertUnwindSafe, catch_unwind};

use promises::try_insertion;
use scenes::Insertion;
pub(crate) use tally::Tally;
use worst::Defect;

/// The seed unless another one is given.
pub(crate) const SEED: u64 = 20_260_101;

/// One insertion; a panic is a defect.
pub(crate) fn attempt(seed: u64, index: u64, alone: bool) -> Tally {
    let insertion = Insertion::random(seed, index);
    let tried = catch_unwind(AssertUnwindSafe(|| try_insertion(&insertion, index, alone)));
    tried.unwrap_or_else(|_| {
        let mut tally = Tally::of_one();
        tally.defects.push(Defect { index, step: 0, what: "panic".into() });
        tally
    })
}

/// These insertions, one after the other.
pub(crate) fn attempt_all(seed: u64, numbers: std::ops::Range<u64>) -> Tally {
    numbers.map(|index| attempt(seed, index, false)).fold(Tally::default(), Tally::with)
}

/// Insertions in the test.
#[cfg(test)]
const FEW: u64 = 24;

#[test]
fn random_insertions_keep_their_promises() {
    let tally = attempt_all(SEED, 0..FEW);
    println!("{tally}");
    assert!(tally.defects.is_empty());
    // Most find a shape: promises of shapes that are not there are easily kept.
    assert!(tally.ended("solved") > tally.solves() / 2);
}

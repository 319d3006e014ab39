//! The paper's figures: each claim beside something independent.

mod accuracy;
mod bands;
mod budget;
mod coils;
mod communication_step;
mod field_ring;
mod fig4;
mod fig5;
mod fig7a;
mod fig7b;
mod fig7c;
mod fig7d;
mod fig8;
mod fig9;
mod hysteresis;
mod rest;
mod stability;

use std::sync::atomic::{AtomicUsize, Ordering};

use mcm::studies::{Comparison, Progress, Study, Value};

use crate::tolerance::ROUNDING;

/// Counts the parts of a study.
#[derive(Default)]
struct Counted {
    announced: AtomicUsize,
    done: AtomicUsize,
}

impl Progress for Counted {
    fn more(&self, parts: usize) {
        self.announced.fetch_add(parts, Ordering::Relaxed);
    }

    fn done(&self) {
        let done = self.done.fetch_add(1, Ordering::Relaxed) + 1;
        assert!(done <= self.announced.load(Ordering::Relaxed), "more is done than was announced");
    }
}

impl Counted {
    /// Asserts that at least this many parts were announced, and all of them done.
    fn assert_complete(&self, least: usize) {
        let [announced, done] = [&self.announced, &self.done].map(|count| count.load(Ordering::Relaxed));
        assert_eq!(announced, done);
        assert!(done >= least, "only {done} parts");
    }
}

/// A column of a study.
fn column<'a>(study: &'a Study, name: &str) -> &'a [f64] {
    study.column(name).unwrap_or_else(|| panic!("there is no column {name}"))
}

/// The number of the row in which a column has a value.
fn row_with(study: &Study, name: &str, value: f64) -> usize {
    let same = |other: &f64| (other - value).abs() <= ROUNDING * value.abs();
    column(study, name).iter().position(same).unwrap_or_else(|| panic!("{name} is nowhere {value}"))
}

/// The row of a comparison whose quantity begins so.
fn row<'a>(study: &'a Study, quantity: &str) -> &'a Comparison {
    let found = study.comparison.iter().find(|row| row.quantity.starts_with(quantity));
    found.unwrap_or_else(|| panic!("no comparison of {quantity}"))
}

fn number(value: &Value) -> f64 {
    match value {
        Value::Number(number) => *number,
        other => panic!("{other:?} is not a number"),
    }
}

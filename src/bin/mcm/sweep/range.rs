//! Values of one key, as given by `--vary`.

use std::str::FromStr;

/// Maximum number of values of one key, and of rows of a table; a larger one would not fit into memory.
pub(super) const MOST_VALUES: u32 = 1_000_000;

/// Largest value: none of a scene is as large.
const LARGEST: f64 = 1e100;

/// Values of one key.
#[derive(Clone)]
pub(super) struct Range {
    pub(super) key: String,
    pub(super) values: Vec<f64>,
}

impl FromStr for Range {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let form = || format!("\"{text}\" is not of the form KEY=START:STOP:COUNT");
        let (key, range) = text.split_once('=').ok_or_else(form)?;
        let [start, stop, count] = range.split(':').collect::<Vec<_>>()[..] else { return Err(form()) };
        let number = |text: &str| match text.trim().parse::<f64>() {
            Ok(number) if number.is_finite() => Ok(number),
            _ => Err(format!("\"{text}\" is not a finite number")),
        };
        let (start, stop) = (number(start)?, number(stop)?);
        if start.abs().max(stop.abs()) > LARGEST {
            return Err(format!("{start} to {stop} is not allowed: values must be from -1e100 to 1e100"));
        }
        let count: u32 = count.trim().parse().map_err(|_| format!("\"{count}\" is not a valid count"))?;
        if !(1..=MOST_VALUES).contains(&count) {
            return Err(format!("COUNT = {count} is not allowed: it must be from 1 to {MOST_VALUES}"));
        }
        let last = f64::from(count - 1);
        let value = |i: u32| match f64::from(i) {
            0.0 => start,
            i if i >= last => stop,
            // A whole number of steps between whole numbers gives whole numbers.
            i => (start * (last - i) + stop * i) / last,
        };
        Ok(Self { key: key.trim().into(), values: (0..count).map(value).map(tidy).collect() })
    }
}

/// The nearest number with fifteen digits: what a step of 0.1 means, without the rounding of its sum.
fn tidy(value: f64) -> f64 {
    format!("{value:.14e}").parse().unwrap_or(value)
}

impl Range {
    /// Distance between the first and the last value.
    pub(super) fn span(&self) -> f64 {
        let (first, last) = (self.values[0], self.values[self.values.len() - 1]);
        (last - first).abs()
    }
}

/// Every combination of the ranges' values, the last range fastest.
pub(super) fn grid(ranges: &[Range]) -> Vec<Vec<f64>> {
    ranges.iter().fold(vec![Vec::new()], |grid, range| {
        let extended = |start: &Vec<f64>| {
            let start = start.clone();
            range.values.iter().map(move |&value| [&start[..], &[value]].concat())
        };
        grid.iter().flat_map(extended).collect()
    })
}

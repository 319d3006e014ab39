//! Round numbers on an axis.

/// Decimals from which, and size from which, a number is written with an exponent.
const MOST_DECIMALS: i32 = 4;
const LARGEST: f64 = 1e6;

/// A mark on an axis.
pub(super) struct Tick {
    pub(super) value: f64,
    pub(super) label: String,
}

/// About this many numbers within a range, 1, 2 or 5 times a power of ten apart.
pub(super) fn ticks([low, high]: [f64; 2], count: f64) -> Vec<Tick> {
    let step = round_below(2.0 * (high - low) / count);
    let (first, last) = ((low / step - 1e-9).ceil(), (high / step + 1e-9).floor());
    let mut out = Vec::new();
    let mut number = first;
    while number <= last {
        out.push(Tick { value: number * step, label: label(number * step, step) });
        number += 1.0;
    }
    out
}

/// The largest of 1, 2 and 5 times a power of ten that is not above a positive number.
pub(super) fn round_below(value: f64) -> f64 {
    let power = 10_f64.powf(value.log10().floor());
    // A quotient next to a round number counts as that.
    let digits = value / power * (1.0 + 1e-12);
    power * [5.0, 2.0].into_iter().find(|round| *round <= digits).unwrap_or(1.0)
}

/// A multiple of a step, with the digits that the step needs.
#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "decimal exponents of finite numbers"
)]
fn label(value: f64, step: f64) -> String {
    if value == 0.0 {
        return "0".into();
    }
    let exponent = |value: f64| (value.abs() * (1.0 + 1e-12)).log10().floor() as i32;
    let decimals = (-exponent(step)).max(0);
    if decimals <= MOST_DECIMALS && value.abs() < LARGEST {
        return format!("{value:.*}", decimals as usize);
    }
    let digits = (exponent(value) - exponent(step)).max(0) as usize;
    format!("{value:.digits$e}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_inside() {
        for (range, expected) in [
            ([0.0, 25.0], &["0", "10", "20"][..]),
            ([-0.3, 0.3], &["-0.2", "0", "0.2"]),
            ([98.0, 101.0], &["98", "99", "100", "101"]),
            ([1e-7, 4e-7], &["1e-7", "2e-7", "3e-7", "4e-7"]),
            ([0.0, 4e6], &["0", "2e6", "4e6"]),
        ] {
            let found = ticks(range, 4.0);
            let labels: Vec<&str> = found.iter().map(|tick| tick.label.as_str()).collect();
            assert_eq!(labels, expected, "{range:?}");
            assert!(found.iter().all(|tick| {
                tick.label.parse::<f64>().is_ok_and(|v| (v - tick.value).abs() <= 1e-9 * v.abs())
            }));
        }
    }

    #[test]
    fn a_round_number_is_below_itself() {
        for (value, expected) in
            [(1.0, 1.0), (1.99, 1.0), (2.0, 2.0), (0.3, 0.2), (70.0, 50.0), (1000.0, 1000.0)]
        {
            assert!((round_below(value) / expected - 1.0).abs() < 1e-9, "{value}");
        }
    }
}

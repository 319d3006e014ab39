//! Fig. 7D: field beside the magnet pair.

use mcm::studies::fig7d;

use super::{column, row_with};
use crate::tolerance::{COARSE_DIFFERENCE, PRINTED_THREE_DIGITS, assert_close};

#[test]
fn field_and_gradient_at_the_middle_are_those_of_an_independent_sum() {
    let study = fig7d().unwrap();
    let at = |name: &str, z: f64| column(&study, name)[row_with(&study, "z_mm", z)];
    assert_close("B", &[at("bz_at_40_mt", 0.0)], &[26.7], PRINTED_THREE_DIGITS);
    // Weaker away from the magnet, which therefore attracts.
    assert_close("gradient", &[at("dbz_dy_at_40_t_per_m", 0.0)], &[-0.86], PRINTED_THREE_DIGITS);
    let size = at("bz_at_40_mt", 40.0).hypot(at("by_at_40_mt", 40.0));
    assert_close("B 40 mm along", &[size], &[30.0], PRINTED_THREE_DIGITS);
    assert!(at("bz_at_30_mt", 0.0) > at("bz_at_40_mt", 0.0));
    assert!(at("bz_at_40_mt", 0.0) > at("bz_at_50_mt", 0.0));
}

#[test]
fn gradients_are_the_slopes_of_the_fields() {
    let study = fig7d().unwrap();
    for distance in [30, 40, 50] {
        for (field, slope) in [("bz", "dbz_dz"), ("by", "dbz_dy")] {
            // curl B = 0: dB_y/dz is dB_z/dy.
            let values = column(&study, &format!("{field}_at_{distance}_mt"));
            let slopes = column(&study, &format!("{slope}_at_{distance}_t_per_m"));
            let differences: Vec<f64> = values.windows(3).map(|v| 0.5 * (v[2] - v[0])).collect();
            assert_close((field, distance), &differences, &slopes[1..slopes.len() - 1], COARSE_DIFFERENCE);
        }
    }
}

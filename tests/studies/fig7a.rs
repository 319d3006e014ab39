//! Fig. 7A: one segment, and the gain from its base ring.

use mcm::equilibrium::Interaction;
use mcm::studies::{fig7a, gain_from_base_ring};

use super::{column, number, row};
use crate::equilibrium::rows;
use crate::tolerance::{RATIO_ON_TWO_WAYS, ROUNDING, SPANS_ANGLE_DEG, TWO_DECIMALS_DEG};

#[test]
fn angles_are_those_of_the_independent_model() {
    let study = fig7a().unwrap();
    for (name, id, field) in [
        ("alpha_tip_deg", "c1a_S1_none_By5", 5),
        ("alpha_tip_deg", "c1a_S1_none_By10", 10),
        ("alpha_tip_full_deg", "c1a_S1_full_By10", 10),
        ("alpha_tip_full_deg", "c1a_S1_full_By30", 30),
        ("alpha_both_preceding_deg", "c1b_S1_base_By5", 5),
        ("alpha_both_preceding_deg", "c1b_S1_base_By20", 20),
        ("alpha_both_rings_deg", "c1b_S1_rings_By10", 10),
        ("alpha_both_rings_deg", "c1b_S1_rings_By30", 30),
        ("alpha_both_full_deg", "c1b_S1_full_By5", 5),
        ("alpha_both_full_deg", "c1b_S1_full_By30", 30),
    ] {
        let expected = rows::number(&rows::row(id).outputs, "alpha_deg");
        let got = column(&study, name)[field];
        assert!((got - expected).abs() <= SPANS_ANGLE_DEG, "{id}: {got} deg, expected {expected}");
    }
}

/// In percent, from two independent models.
#[test]
fn the_gain_is_that_of_two_independent_models() {
    for (level, expected) in
        [(Interaction::Preceding, [24.0, 26.0, 25.0]), (Interaction::Full, [29.0, 31.0, 32.0])]
    {
        let gain = gain_from_base_ring(level).unwrap();
        for (field, expected) in [5, 10, 20].into_iter().zip(expected) {
            let percent = 100.0 * gain.angle[field - 5];
            assert!((percent - expected).abs() <= 0.5, "{level:?}, {field} mT: {percent} %");
        }
    }
}

#[test]
fn with_less_field_the_angle_is_that_without_the_base_ring() {
    let study = fig7a().unwrap();
    for (level, without) in
        [("preceding", "alpha_tip_deg"), ("rings", "alpha_tip_deg"), ("full", "alpha_tip_full_deg")]
    {
        let with = column(&study, &format!("alpha_both_{level}_deg"));
        for field in 5..=25 {
            let less = column(&study, &format!("gain_field_{level}"))[field];
            let angle = parabola(with, field as f64 * (1.0 - less));
            let expected = column(&study, without)[field];
            assert!(
                (angle - expected).abs() <= TWO_DECIMALS_DEG,
                "{level}, {field} mT: {angle} and {expected} deg"
            );
            let more = column(&study, &format!("gain_angle_{level}"))[field];
            assert!((with[field] / expected - 1.0 - more).abs() <= RATIO_ON_TWO_WAYS);
        }
    }
    let paper = row(&study, "more tip angle");
    let mean = column(&study, "gain_angle_full")[5..=25].iter().sum::<f64>() / 21.0;
    assert!((number(&paper.exact) - mean).abs() <= ROUNDING);
}

/// The value at `x` of the parabola through the three nearest of values at 0, 1, 2, ...
fn parabola(values: &[f64], x: f64) -> f64 {
    let middle = (x.round() as usize).max(1);
    let t = x - middle as f64;
    let [a, b, c] = [values[middle - 1], values[middle], values[middle + 1]];
    b + 0.5 * t * (c - a) + 0.5 * t * t * (a - 2.0 * b + c)
}

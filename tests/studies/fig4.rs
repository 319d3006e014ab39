//! Fig. 4: the choice of the design.

use std::sync::LazyLock;

use mcm::studies::{Study, Value, fig4};

use super::{Counted, column, number, row};
use crate::tolerance::{ROUNDING, TWO_DECIMALS_DEG};

static STUDY: LazyLock<Study> = LazyLock::new(|| {
    let parts = Counted::default();
    let study = fig4(&parts).unwrap();
    parts.assert_complete(100);
    study
});

const LEVELS: [&str; 4] = ["none", "preceding", "rings", "full"];

/// Number of the row of a length (mm) and a boundary angle (deg).
fn at(length: f64, angle: f64) -> usize {
    let places = column(&STUDY, "length_mm").iter().zip(column(&STUDY, "boundary_angle_deg"));
    let near = |a: f64, b: f64| (a - b).abs() < ROUNDING * b;
    places.into_iter().position(|(l, a)| near(*l, length) && near(*a, angle)).unwrap()
}

#[test]
fn the_papers_segment_bends_as_independent_models_say() {
    let chosen = at(4.0, 40.0);
    for (level, angle) in LEVELS.into_iter().zip([30.50, 38.18, 34.78, 42.56]) {
        let got = column(&STUDY, &format!("alpha_{level}_deg"))[chosen];
        assert!((got - angle).abs() < TWO_DECIMALS_DEG, "{level}: {got}");
    }
}

#[test]
fn a_design_is_scored_if_and_only_if_it_meets_the_constraints() {
    let (mut scored, mut refused) = (0, 0);
    for (index, (&length, &angle)) in
        column(&STUDY, "length_mm").iter().zip(column(&STUDY, "boundary_angle_deg")).enumerate()
    {
        // Two windings of radius 2 mm: p = Theta mm, 4 h = L - 2 p. Eq. (16) in whole tenths of a millimetre and degrees.
        let pitch = angle.to_radians();
        let height = (length - 2.0 * pitch) / 4.0;
        let (tenths, degrees) = ((length * 10.0).round() as u64, angle.round() as u64);
        let bends = 120 * tenths + (120 / degrees) * 10 * degrees <= 150 * degrees;
        let allowed = bends && height >= 0.6 && height >= 0.9 * pitch;
        for level in LEVELS {
            let score = column(&STUDY, &format!("score_sum_{level}"))[index];
            assert_eq!(!score.is_nan(), allowed, "{length} mm, {angle} deg, {level}");
        }
        if allowed { scored += 1 } else { refused += 1 }
    }
    assert!(scored > 100 && refused > 100);
}

#[test]
fn scores_go_from_zero_to_one_in_the_order_of_what_they_score() {
    let angles = column(&STUDY, "boundary_angle_deg");
    for level in LEVELS {
        let of = |name: &str| column(&STUDY, &format!("{name}_{level}"));
        let alpha = column(&STUDY, &format!("alpha_{level}_deg"));
        let mismatches: Vec<f64> = alpha.iter().zip(angles).map(|(a, b)| -(a - b).abs()).collect();
        for (scores, values) in
            [(of("score_deflection"), mismatches.as_slice()), (of("score_moment"), of("mu_rel"))]
        {
            let mut order: Vec<usize> = (0..scores.len()).filter(|&i| !scores[i].is_nan()).collect();
            order.sort_by(|&a, &b| values[a].total_cmp(&values[b]));
            assert!(order.windows(2).all(|pair| scores[pair[0]] <= scores[pair[1]]), "{level}");
            let (worst, best) = (scores[order[0]], scores[order[order.len() - 1]]);
            assert!(worst.abs() < ROUNDING && (best - 1.0).abs() < ROUNDING, "{level}: {worst} to {best}");
        }
    }
}

#[test]
fn of_the_round_designs_the_papers_is_best_and_on_a_finer_grid_it_is_not() {
    let round = row(&STUDY, "best design on a grid of 0.5 mm, 5 deg");
    let paper = Value::Words("4.0 mm, 40 deg".into());
    assert_eq!((&round.paper, &round.printed, &round.exact), (&paper, &paper, &paper));
    let chosen = at(4.0, 40.0);
    for level in LEVELS {
        let sums = column(&STUDY, &format!("score_sum_{level}"));
        // The round designs: 4 mm, 40 deg to 6.5 mm, 60 deg along the band of the allowed ones.
        for (length, angle) in [(4.5, 45.0), (5.0, 50.0), (5.5, 55.0), (6.0, 60.0), (6.5, 60.0)] {
            let other = sums[at(length, angle)];
            assert!(other.is_nan() || other < sums[chosen], "{level}: {length} mm, {angle} deg");
        }
        assert!(sums.iter().any(|sum| *sum > sums[chosen]), "{level}");
    }
    let share = row(&STUDY, "score of 4 mm, 40 deg");
    assert!(number(&share.printed) < number(&share.exact) && number(&share.exact) < 1.0);
}

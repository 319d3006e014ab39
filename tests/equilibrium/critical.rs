//! Straight shapes: where they lose their stability, and how the rings' attraction shortens them.

use mcm::design::{Helix, gent_modulus};
use mcm::equilibrium::{Equilibrium, Inputs, Interaction, Solution};
use nalgebra::Vector3;

use super::rows::{Row, number, row, rows, vector};
use crate::tolerance::{BISECTION, CRITICAL, CRITICAL_WITHOUT_PAIRS, ON_AXIS, STATICS_LENGTH, STATICS_SPANS};

/// Bisects between `low`, where `holds` is true, and `high`, where it is not.
pub(crate) fn last_true(mut low: f64, mut high: f64, mut holds: impl FnMut(f64) -> bool) -> f64 {
    assert!(holds(low), "nothing to bisect: already false at {low}");
    assert!(!holds(high), "nothing to bisect: still true at {high}");
    while high - low > BISECTION * high {
        let middle = 0.5 * (low + high);
        if holds(middle) { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

/// Whether the Hessian at these unknowns is positive definite.
pub(crate) fn is_stable(equilibrium: &mut Equilibrium, inputs: &Inputs, unknowns: &[f64]) -> bool {
    equilibrium.solve_at(inputs, unknowns, 0.0, &vec![0.0; unknowns.len()]).is_some()
}

fn off_axis(equilibrium: &Equilibrium) -> f64 {
    let tip = equilibrium.tip().position;
    tip.x.hypot(tip.y) / tip.z
}

fn antiparallel(row: &Row, size: f64) -> Inputs {
    Inputs { uniform_field: Vector3::new(0.0, 0.0, -size), ..row.inputs.clone() }
}

#[test]
fn an_antiparallel_field_buckles_the_straight_shape() {
    let mut count = 0;
    for row in rows().iter().filter(|row| row.id.starts_with("c5_crit_antiparallel")) {
        let mut equilibrium = row.refined();
        assert!(equilibrium.solve(&row.inputs).expect("finite inputs").solved(), "{}", row.id);
        let straight = equilibrium.unknowns().to_vec();
        let length = row.design().length();
        let error = (equilibrium.tip().position - vector(&row.outputs["straight_tip_p"])).norm() / length;
        assert!(error <= STATICS_LENGTH, "{}: straight length off by {error:e}", row.id);
        let expected = number(&row.outputs, "critical_B_T");
        let found = last_true(0.5 * expected, 2.0 * expected, |size| {
            is_stable(&mut equilibrium, &antiparallel(row, size), &straight)
        });
        let error = (found / expected - 1.0).abs();
        let pairs = row.interaction() != Some(Interaction::None);
        let bound = if pairs { CRITICAL } else { CRITICAL_WITHOUT_PAIRS };
        assert!(error <= bound, "{}: got {found}, expected {expected}: {error:e}", row.id);
        println!("{}: {error:e}", row.id);
        // The solver sees the same: straight up to there, bent beyond.
        let mut solver = row.refined();
        let before = solver.solve(&antiparallel(row, 0.99 * expected)).expect("finite inputs");
        assert!(before.solved() && before.snaps == 0 && before.margin > 0.0, "{}: {before:?}", row.id);
        assert!(before.margin < 0.05, "{}: {before:?}", row.id);
        assert!(off_axis(&solver) < ON_AXIS, "{}: bent by {:e}", row.id, off_axis(&solver));
        // Exactly antiparallel, all directions of bending are alike: an answer there may be refused, but is never straight.
        let beyond = antiparallel(row, 1.05 * expected);
        let after = solver.solve(&beyond).expect("finite inputs");
        assert!(
            !after.solved() || off_axis(&solver) > 1e-3,
            "{}: on the unstable straight shape: {after:?}",
            row.id
        );
        // A hundredth aside it is bent and stable.
        let mut aside = antiparallel(row, 1.01 * expected);
        aside.uniform_field.y = 0.01 * expected;
        let mut solver = row.refined();
        let after = solver.solve(&aside).expect("finite inputs");
        assert!(after.solved() && after.margin > 0.0 && off_axis(&solver) > 0.1, "{}: {after:?}", row.id);
        count += 1;
    }
    assert_eq!(count, 2);
}

#[test]
fn without_a_field_the_manipulator_is_straight_stable_and_shorter() {
    let mut count = 0;
    for row in rows().iter().filter(|row| row.id.starts_with("c5_zero_field") && row.interaction().is_some())
    {
        let mut equilibrium = row.refined();
        let report = equilibrium.solve(&row.inputs).expect("finite inputs");
        assert!(report.solved() && report.snaps == 0, "{}: {report:?}", row.id);
        assert!(report.margin > 0.0 && number(&row.outputs, "min_hessian_eig_sign") > 0.0, "{}", row.id);
        assert!(off_axis(&equilibrium) < ON_AXIS, "{}: bent by {:e}", row.id, off_axis(&equilibrium));
        let expected = vector(&row.outputs["tip_p"]);
        let error = (equilibrium.tip().position - expected).norm() / row.design().length();
        let spans = row.interaction().is_some_and(Interaction::acts_on_spans);
        let bound = if spans { STATICS_SPANS } else { STATICS_LENGTH };
        assert!(error <= bound, "{}: tip off by {error:e} of the length", row.id);
        println!("{}: {error:e}, margin {}", row.id, report.margin);
        count += 1;
    }
    assert_eq!(count, 3);
}

#[test]
fn the_rings_own_attraction_buckles_a_soft_enough_core() {
    // The table raises the remanence beyond what a magnet has. The shape depends on remanence^2 / modulus alone:
    // here the core is softened instead.
    let row = row("c5_crit_Br_S1_rings");
    let (remanence, hardness) = (row.segmented.ring.remanence, Helix::paper().shore_a);
    let equivalent = |shore_a: f64| remanence * (gent_modulus(hardness) / gent_modulus(shore_a)).sqrt();
    let is_stable_straight = |softening: f64| {
        let mut softer = row_with_hardness(hardness - softening);
        let straight = straight(&mut softer, &row.inputs);
        straight.is_some_and(|straight| is_stable(&mut softer, &row.inputs, &straight))
    };
    let found = equivalent(hardness - last_true(5.0, 31.0, is_stable_straight));
    let expected = number(&row.outputs, "critical_Br_ring_T");
    let error = (found / expected - 1.0).abs();
    println!("critical remanence: {error:e}");
    assert!(error <= CRITICAL, "got {found} T, expected {expected} T: {error:e}");
}

fn row_with_hardness(shore_a: f64) -> Equilibrium {
    let mut row = row("c5_crit_Br_S1_rings");
    row.segmented.helix.shore_a = shore_a;
    row.refined()
}

/// The unknowns of the straight equilibrium, stable or not: Newton's method, damped so that every step is a descent;
/// by symmetry it stays on the axis. `None` where the rings pull the core shut.
fn straight(equilibrium: &mut Equilibrium, inputs: &Inputs) -> Option<Vec<f64>> {
    const DAMPING: f64 = 0.5;
    let mut unknowns = vec![0.0; equilibrium.freedoms()];
    for _ in 0..100 {
        let (_, gradient) = equilibrium.gradient(inputs, &unknowns)?;
        let step = equilibrium.solve_at(inputs, &unknowns, DAMPING, &gradient)?;
        unknowns.iter_mut().zip(step).for_each(|(x, s)| *x -= s);
    }
    Some(unknowns)
}

//! The rows of `statics_dev.json` that are expected failures: their branch folds before the inputs are reached.

use mcm::equilibrium::Report;

use super::rows::{Row, list, number, row, rows, vector};
use crate::tolerance::{FOLD_ANGLE_DEG, FOLD_SHAPE, FOLD_STRENGTH};

/// Steps of the field's angle (deg) and of the magnet's strength (relative to the fold's).
const TURN: f64 = 0.1;
const RAMP: f64 = 0.01;

fn lost_rows() -> Vec<Row> {
    let lost: Vec<Row> =
        rows().into_iter().filter(|row| row.interaction().is_some() && row.is_lost()).collect();
    assert!(!lost.is_empty());
    lost
}

fn is_lost(report: &Report) -> bool {
    !report.solved || report.snaps > 0
}

#[test]
fn a_lost_branch_is_never_passed_in_silence() {
    for row in lost_rows() {
        // In one step from the unloaded shape, by the way that the table took.
        let mut equilibrium = row.equilibrium();
        if row.turned.is_some() {
            equilibrium.solve(&row.turned_to(0.0)).expect("finite inputs");
            let mut lost = false;
            for tenth in 1..=10 {
                let angle = 0.1 * f64::from(tenth) * row.field_angle;
                lost |= is_lost(&equilibrium.solve(&row.turned_to(angle)).expect("finite inputs"));
            }
            assert!(lost, "{}: passed its fold without a word", row.id);
        } else {
            let report = equilibrium.solve(&row.inputs).expect("finite inputs");
            assert!(is_lost(&report), "{}: a silent answer beyond the fold: {report:?}", row.id);
        }
    }
}

#[test]
fn the_turned_field_loses_the_branch_where_the_table_does() {
    let mut count = 0;
    for row in lost_rows().iter().filter(|row| row.turned.is_some()) {
        let fold = list(&row.outputs["fold_theta_deg"]);
        let mut equilibrium = row.equilibrium();
        let mut angle = 0.0;
        while angle < row.field_angle
            && !is_lost(&equilibrium.solve(&row.turned_to(angle)).expect("finite inputs"))
        {
            angle += TURN;
        }
        assert!(
            angle > fold[0] - FOLD_ANGLE_DEG && angle < fold[1] + FOLD_ANGLE_DEG,
            "{}: lost at {angle} deg, expected within {FOLD_ANGLE_DEG} of {fold:?}",
            row.id
        );
        println!("{}: lost at {angle:.2} deg, expected {fold:?}", row.id);
        count += 1;
    }
    assert_eq!(count, 3);
}

#[test]
fn the_growing_magnet_loses_the_branch_where_the_table_does() {
    let mut count = 0;
    for row in lost_rows().iter().filter(|row| row.magnet.is_some()) {
        let fold = list(&row.outputs["fold_magnet_scale"]);
        let mut equilibrium = row.equilibrium();
        let mut strength = 0.0;
        let end = fold[1] * (1.0 + 2.0 * FOLD_STRENGTH);
        while strength < end
            && !is_lost(&equilibrium.solve(&row.ramped_to(strength)).expect("finite inputs"))
        {
            strength += RAMP * fold[0];
        }
        assert!(
            strength > fold[0] * (1.0 - FOLD_STRENGTH) && strength < fold[1] * (1.0 + FOLD_STRENGTH),
            "{}: lost at {strength}, expected within {FOLD_STRENGTH} of {fold:?}",
            row.id
        );
        println!("{}: lost at {strength:.4}, expected {fold:?}", row.id);
        count += 1;
    }
    assert_eq!(count, 13);
}

#[test]
fn just_before_the_fold_the_shape_is_the_tables() {
    for id in ["c2_S3_rings_B10_th170", "c2_S3_rings_B20_th120"] {
        let row = row(id);
        let last = list(&row.outputs["fold_theta_deg"])[0];
        let expected = &row.outputs["state_at_last_stable"];
        let mut equilibrium = row.equilibrium();
        let mut report = equilibrium.solve(&row.turned_to(0.0)).expect("finite inputs");
        for step in 1..=200 {
            report = equilibrium.solve(&row.turned_to(last * f64::from(step) / 200.0)).expect("finite inputs");
            assert!(!is_lost(&report), "{id}: lost at step {step}: {report:?}");
        }
        assert!(report.margin > 0.0, "{id}: {report:?}");
        assert!(number(expected, "min_hessian_eig_sign") > 0.0);
        let error = (equilibrium.tip().position - vector(&expected["tip_p"])).norm() / row.design().length();
        assert!(error <= FOLD_SHAPE, "{id}: tip off by {error:e} of the length");
        println!("{id}: tip {error:e} margin {}", report.margin);
    }
}

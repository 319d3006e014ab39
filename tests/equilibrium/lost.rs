//! The rows of `statics_dev.json` that are expected failures: their branch folds before the inputs are reached.

use mcm::equilibrium::{Equilibrium, Inputs, Report, Solution};
use mcm::manipulator::{Scene, Status};
use nalgebra::{Cholesky, SymmetricEigen};

use super::rows::{Row, list, number, row, rows, vector};
use crate::tolerance::{FOLD_ANGLE_DEG, FOLD_SHAPE, FOLD_STRENGTH, MARGIN, MARGIN_BOUND};

/// Steps of the field's angle (deg) and of the magnet's strength (relative to the fold's).
const TURN: f64 = 0.1;
const RAMP: f64 = 0.01;

/// Distance from the fold at which the margin is looked at, deg.
const BEFORE: f64 = 0.2;

fn lost_rows() -> Vec<Row> {
    let lost: Vec<Row> =
        rows().into_iter().filter(|row| row.interaction().is_some() && row.is_lost()).collect();
    assert!(!lost.is_empty());
    lost
}

fn is_lost(report: &Report) -> bool {
    !report.solved() || report.snaps > 0
}

#[test]
fn a_lost_branch_is_never_passed_in_silence() {
    for row in lost_rows() {
        // In one step from the unloaded shape, by the way that the table took.
        let mut equilibrium = row.refined();
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
        let mut equilibrium = row.refined();
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
    let (mut count, mut unreachable) = (0, 0);
    for row in lost_rows().iter().filter(|row| row.magnet.is_some()) {
        let fold = list(&row.outputs["fold_magnet_scale"]);
        let mut equilibrium = row.refined();
        let mut strength = 0.0;
        let end = fold[1] * (1.0 + 2.0 * FOLD_STRENGTH);
        while strength < end && !is_lost(&equilibrium.solve(&row.ramped_to(strength)).expect("finite inputs"))
        {
            strength += RAMP * fold[0];
        }
        // Where the table's last shape reaches into the magnet's material, its branch is one that a ramp cannot reach.
        let last =
            vector(&row.outputs["state_at_last_stable"]["tip_p"]) - row.inputs.sources[0].pose.position;
        let magnet = row.magnet.as_ref().expect("a row with a magnet");
        let inside = magnet.contains(&row.inputs.sources[0].pose.rotation.tr_mul(&last));
        unreachable += usize::from(inside);
        assert!(
            (inside || strength > fold[0] * (1.0 - FOLD_STRENGTH))
                && strength < fold[1] * (1.0 + FOLD_STRENGTH),
            "{}: lost at {strength}, expected within {FOLD_STRENGTH} of {fold:?}",
            row.id
        );
        println!("{}: lost at {strength:.4}, expected {fold:?}", row.id);
        count += 1;
    }
    assert_eq!((count, unreachable), (12, 1));
}

/// A fifth of a degree before the fold, where the table's own state lies at the fold itself.
#[test]
fn close_to_the_fold_the_margin_tells() {
    for id in ["c2_S3_rings_B10_th170", "c2_S3_rings_B20_th120"] {
        let row = row(id);
        let last = list(&row.outputs["fold_theta_deg"])[0] - BEFORE;
        let expected = &row.outputs["state_at_last_stable"];
        assert!(number(expected, "min_hessian_eig_sign") > 0.0, "{id}");
        let mut equilibrium = row.refined();
        let (mut margins, mut above) = (Vec::new(), f64::NAN);
        for step in 0..=100 {
            let inputs = row.turned_to(last * f64::from(step) / 100.0);
            let report = equilibrium.solve(&inputs).expect("finite inputs");
            assert!(!is_lost(&report), "{id}: lost at step {step}: {report:?}");
            let exact = smallest_eigenvalue(&mut equilibrium, &inputs);
            let margin = equilibrium.margin().expect("a solved shape");
            assert!(
                (margin - exact).abs() <= MARGIN,
                "{id}: step {step}: margin {margin}, eigenvalue {exact}"
            );
            let bound = report.margin;
            assert!(bound > exact - MARGIN, "{id}: step {step}: bound {bound}, eigenvalue {exact}");
            above = bound / exact - 1.0;
            margins.push(margin);
        }
        let error = (equilibrium.tip().position - vector(&expected["tip_p"])).norm() / row.design().length();
        println!("{id}: tip {error:e}, margin {:?}, bound {above:e} above it", margins.last());
        assert!(
            above <= MARGIN_BOUND,
            "{id}: close to the fold the quick bound is {above:e} above the margin"
        );
        assert!(error <= FOLD_SHAPE, "{id}: tip off by {error:e} of the length");
        assert!(
            margins[100] < 0.15 && margins[100] < 0.2 * margins[0],
            "{id}: no sign of the fold: {margins:?}"
        );
    }
}

/// The smallest eigenvalue of `H x = lambda K x`, from the whole inverse and the whole norm.
fn smallest_eigenvalue(equilibrium: &mut Equilibrium, inputs: &Inputs) -> f64 {
    let shape = equilibrium.unknowns().to_vec();
    let root = Cholesky::new(equilibrium.elastic_norm(inputs, &shape)).expect("positive definite").l();

    let mut inverse = root.clone();
    for mut column in inverse.column_iter_mut() {
        let solution =
            equilibrium.solve_at(inputs, &shape, 0.0, column.as_slice()).expect("positive definite");
        column.copy_from_slice(&solution);
    }
    let scaled = root.tr_mul(&inverse);
    1.0 / SymmetricEigen::new((&scaled + scaled.transpose()) * 0.5).eigenvalues.max()
}

#[test]
fn a_solve_ends_with_its_budget() {
    let mut scene =
        Scene::parse("[design]\nsegments = 3\n[field]\nuniform_mt = [0.0, 20.0, 0.0]", "bent").unwrap();
    let status = |scene: &Scene| scene.manipulator(2).unwrap().solve(&scene.inputs).unwrap().status;
    assert_eq!(status(&scene), Status::Solved);
    scene.settings.iterations = 1;
    assert_eq!(status(&scene), Status::NotSolved);
}

//! Every equilibrium of `statics_dev.json`, an independent energy model.

use mcm::equilibrium::{Equilibrium, Interaction, Report, Solution};
use mcm::geometry::{Pose, rotation_log};

use super::rows::{Row, list, number, rows, vector};
use crate::tolerance::{
    STATICS_ANGLE_DEG, STATICS_ENERGY, STATICS_LENGTH, STATICS_SPANS_ENERGY, STATICS_WRENCH,
};

/// Rows by what is done with them; a new level of ours moves rows from the last to the first.
const EQUILIBRIA: usize = 47;
const LOST: usize = 15;
const STRAIGHT: usize = 6;
const OTHER_LEVELS: usize = 0;

/// The field is turned in steps of this, deg.
const TURN: f64 = 1.0;

#[test]
fn every_row_belongs_to_a_test() {
    let all = rows();
    let ours = || all.iter().filter(|row| row.interaction().is_some());
    let straight = |row: &&Row| row.id.starts_with("c5_");
    let counts = [
        ours().filter(|row| row.is_equilibrium()).count(),
        ours().filter(|row| row.is_lost()).count(),
        ours().filter(straight).count(),
        all.iter().filter(|row| row.interaction().is_none()).count(),
    ];
    assert_eq!(
        counts,
        [EQUILIBRIA, LOST, STRAIGHT, OTHER_LEVELS],
        "equilibria, lost, straight, other levels"
    );
    assert_eq!(counts.iter().sum::<usize>(), all.len(), "a row that no test takes");
}

#[test]
fn every_equilibrium_is_met() {
    let mut worst = [("", 0.0); 6];
    let mut count = 0;
    for row in rows().iter().filter(|row| row.interaction().is_some() && row.is_equilibrium()) {
        let mut equilibrium = row.equilibrium();
        let mut snaps = 0;
        if row.turned.is_some() {
            let mut angle = 0.0;
            while angle < row.field_angle {
                snaps += equilibrium.solve(&row.turned_to(angle)).expect("finite inputs").snaps;
                angle += TURN;
            }
        }
        let report = equilibrium.solve(&row.inputs).expect("finite inputs");
        assert!(report.solved(), "{}: not solved: {report:?}", row.id);
        assert_eq!(snaps + report.snaps, 0, "{}: snaps on the way to a shape that needs none", row.id);
        for (slot, (name, error, bound)) in worst.iter_mut().zip(errors(row, &equilibrium, &report)) {
            assert!(error <= bound, "{}: {name}: error {error:e}, allowed {bound:e}", row.id);
            *slot = if error > slot.1 { (name, error) } else { *slot };
        }
        count += 1;
    }
    println!("worst of {count} rows: {worst:?}");
    assert_eq!(count, EQUILIBRIA);
}

/// Name, error and bound of every output; the bound is the table's own accuracy where that is worse than ours.
fn errors(row: &Row, equilibrium: &Equilibrium, report: &Report) -> [(&'static str, f64, f64); 6] {
    let out = &row.outputs;
    let digits =
        |key: &str| out["converged_digits"][key].as_f64().map_or(0.0, |digits| 10.0_f64.powf(-digits));
    let length = row.design().length();
    let tip = equilibrium.tip();
    let expected =
        Pose::new(vector(&out["tip_p"]).into(), array(&list(&out["tip_q"]))).expect("a unit quaternion");
    let alpha = number(out, "alpha_deg");
    let turn = rotation_log(&expected.rotation.tr_mul(&tip.rotation)).norm().to_degrees();
    let angle_bound = STATICS_ANGLE_DEG.max(digits("alpha") * alpha);
    let length_bound = STATICS_LENGTH.max(digits("tip_p"));
    let wrench = equilibrium.magnetic_wrench();
    let (force, torque) = (vector(&out["force"]), vector(&out["torque_about_base"]));
    let spans = row.interaction().is_some_and(Interaction::acts_on_spans);
    let energy_bound = if spans { STATICS_SPANS_ENERGY } else { STATICS_ENERGY };
    let energy_error = (report.energy / number(out, "energy") - 1.0).abs();
    let expected_rings = out["ring_positions"].as_array().expect("a list of rings");
    let rings: Vec<_> = equilibrium.rings().collect();
    assert_eq!(rings.len(), expected_rings.len(), "{}: rings", row.id);
    let ring = |(ring, expected): (&Pose, _)| (ring.position - vector(expected)).norm();
    let farthest = rings.iter().zip(expected_rings).map(ring).fold(0.0, f64::max);
    assert_eq!(
        report.margin > 0.0,
        number(out, "min_hessian_eig_sign") > 0.0,
        "{}: stability, margin {}",
        row.id,
        report.margin
    );
    let alpha_got = tip.axis().z.atan2(tip.axis().y.hypot(tip.axis().x));
    let alpha_error = (90.0 - alpha_got.to_degrees() - alpha).abs();
    // A uniform field pulls at nothing: then the force is measured against the torque.
    let force_scale = if force.norm() > 0.0 { force.norm() } else { torque.norm() / length };
    let torque_scale = torque.norm();
    let relative = |error: f64, scale: f64| if error == 0.0 { 0.0 } else { error / scale };
    [
        ("tip over length", (tip.position - expected.position).norm() / length, length_bound),
        ("rings over length", farthest / length, length_bound),
        ("angle, deg", alpha_error.max(turn), angle_bound),
        ("force", relative((wrench.force - force).norm(), force_scale), STATICS_WRENCH.max(digits("force"))),
        (
            "torque",
            relative((wrench.torque - torque).norm(), torque_scale),
            STATICS_WRENCH.max(digits("torque")),
        ),
        ("energy", energy_error, energy_bound),
    ]
}

fn array(values: &[f64]) -> [f64; 4] {
    values.try_into().expect("four numbers")
}

//! Magnetised rods and dipoles in a uniform field.

use mcm::equilibrium::{Inputs, Solution};
use nalgebra::Vector3;

use super::table::{Chain, Rod, rows_of};
use crate::equilibrium::critical::{is_stable, last_true};
use crate::tolerance::{CRITICAL_WITHOUT_PAIRS, ELASTICA, NEUTRAL};

/// A field of that size, `angle` degrees from +z towards +y.
fn field(rings: usize, size: f64, angle: f64) -> Inputs {
    let (sine, cosine) = angle.to_radians().sin_cos();
    Inputs { uniform_field: Vector3::new(0.0, sine, cosine) * size, ..Inputs::unloaded(rings) }
}

#[test]
fn hard_magnetic_elastica() {
    let mut worst = 0.0;
    for row in rows_of("hard_magnetic_elastica") {
        let mut rod = Rod::slender();
        // Lam = M A B L^2/EI.
        let unit = rod.bending / (rod.moment * rod.length);
        let angle = row.parameter("phi_deg");
        let got = if row.quantity == "Lam_critical" {
            let straight = vec![0.0; rod.equilibrium.freedoms()];
            last_true(0.5 * row.value, 2.0 * row.value, |lam| {
                is_stable(&mut rod.equilibrium, &field(0, lam * unit, angle), &straight)
            })
        } else {
            let report = rod.solve(&field(0, row.parameter("Lam") * unit, angle));
            assert!(report.margin > 0.0 && report.snaps == 0, "{row:?}: {report:?}");
            let tip = rod.equilibrium.tip();
            match row.quantity.as_str() {
                "theta" => tip.axis().y.atan2(tip.axis().z),
                "x/L" => tip.position.z / rod.length,
                "y/L" => tip.position.y / rod.length,
                other => panic!("an unknown quantity: {other}"),
            }
        };
        let error = (got / row.value - 1.0).abs();
        assert!(error <= ELASTICA, "{row:?}: got {got}: {error:e}");
        worst = f64::max(worst, error);
    }
    println!("hard-magnetic elastica: {worst:e}");
}

#[test]
fn a_dipole_at_the_tip_bends_the_core_to_an_arc() {
    for row in rows_of("tip_dipole") {
        let mut chain = Chain::new(1);
        let angle = row.parameter("phi_deg");
        let got = if row.quantity == "Lam_critical" {
            let straight = vec![0.0; chain.equilibrium.freedoms()];
            last_true(0.5 * row.value, 2.0 * row.value, |lam| {
                is_stable(&mut chain.equilibrium, &field(1, lam * chain.unit_field, angle), &straight)
            })
        } else {
            let inputs = field(1, row.parameter("Lam") * chain.unit_field, angle);
            let report = chain.equilibrium.solve(&inputs).expect("finite inputs");
            assert!(report.solved() && report.margin > 0.0 && report.snaps == 0, "{row:?}: {report:?}");
            let axis = chain.equilibrium.tip().axis();
            axis.y.atan2(axis.z)
        };
        let error = (got / row.value - 1.0).abs();
        assert!(error <= ELASTICA, "{row:?}: got {got}: {error:e}");
        println!("tip dipole {}: {error:e}", row.parameters);
    }
}

#[test]
fn a_chain_of_dipoles_buckles_in_an_antiparallel_field() {
    for row in rows_of("chain_buckling") {
        let mut chain = Chain::new(row.parameter("N") as usize);
        let straight = vec![0.0; chain.equilibrium.freedoms()];
        let found = last_true(0.5 * row.value, 2.0 * row.value, |lam| {
            let inputs = field(chain.rings, lam * chain.unit_field, 180.0);
            is_stable(&mut chain.equilibrium, &inputs, &straight)
        });
        let error = (found / row.value - 1.0).abs();
        assert!(error <= CRITICAL_WITHOUT_PAIRS, "{row:?}: got {found}: {error:e}");
        println!("chain {}: {error:e}", row.parameters);
    }
}

/// The fold of the plane problem: an equilibrium whose Hessian loses one direction.
///
/// In space the arc is left earlier: past 180 degrees it turns about the base's axis.
#[test]
fn the_tip_dipole_folds_in_the_plane_and_leaves_it_before() {
    let rows = rows_of("tip_dipole_snap");
    let value = |quantity: &str| {
        let row = rows.iter().find(|row| row.quantity == quantity);
        row.unwrap_or_else(|| panic!("{quantity} is not in the table"))
    };
    let (theta, phi) = (value("theta_fold"), value("phi_fold").value);
    let mut chain = Chain::new(1);
    let size = theta.parameter("Lam") * chain.unit_field;
    let inputs = field(1, size, phi);
    // A pure moment bends to an arc: one mode, towards +y about -x.
    let arc = |angle: f64| {
        let mut unknowns = vec![0.0; chain.equilibrium.freedoms()];
        unknowns[0] = -angle;
        unknowns
    };
    let (at_fold, step) = (arc(theta.value), 1e-4);
    let (before, after) = (arc(theta.value - step), arc(theta.value + step));
    let metric = chain.equilibrium.metric().to_vec();
    let mut gradient = |x: &[f64]| {
        let (_, gradient) = chain.equilibrium.gradient(&inputs, x).expect("apart");
        gradient.iter().zip(&metric).map(|(g, k)| g / (k * metric[0]).sqrt()).collect::<Vec<f64>>()
    };
    let residual = gradient(&at_fold);
    assert!(residual.iter().all(|g| g.abs() <= ELASTICA), "no equilibrium at the fold: {residual:?}");
    let stiffness: Vec<f64> =
        gradient(&after).iter().zip(gradient(&before)).map(|(a, b)| (a - b) / (2.0 * step)).collect();
    assert!(
        stiffness.iter().all(|k| k.abs() <= NEUTRAL),
        "the arc is not neutral at the fold: {stiffness:?}"
    );
    // Turned in the plane from +z, the branch is stable to 180 degrees and lost right after.
    for angle in 0..180 {
        let report = chain.equilibrium.solve(&field(1, size, f64::from(angle))).expect("finite inputs");
        assert!(report.solved() && report.snaps == 0 && report.margin > 0.0, "{angle} deg: {report:?}");
    }
    let report = chain.equilibrium.solve(&field(1, size, 181.0)).expect("finite inputs");
    assert!(!report.solved() || report.snaps > 0, "no snap past 180 deg: {report:?}");
}

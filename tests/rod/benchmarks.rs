//! Elastic rods: tip load, tip moment, own weight.

use core::f64::consts::PI;

use mcm::equilibrium::{Inputs, Solution};
use nalgebra::Vector3;

use super::table::{Rod, rows_of};
use crate::equilibrium::critical::{is_stable, last_true};
use crate::tolerance::{CRITICAL_WITHOUT_PAIRS, ELASTICA};

#[test]
fn elastica_with_a_tip_load() {
    let mut worst = 0.0;
    for row in rows_of("elastica_tip_load") {
        let mut rod = Rod::slender();
        let force = row.parameter("K") * rod.bending / rod.length.powi(2);
        let report = rod.solve(&Inputs { tip_force: Vector3::new(0.0, force, 0.0), ..Inputs::unloaded(0) });
        assert!(report.margin > 0.0 && report.snaps == 0, "{row:?}: {report:?}");
        let tip = rod.equilibrium.tip();
        let got = match row.quantity.as_str() {
            "w/L" => tip.position.y / rod.length,
            "u/L" => 1.0 - tip.position.z / rod.length,
            "theta" => tip.axis().y.atan2(tip.axis().z),
            other => panic!("an unknown quantity: {other}"),
        };
        let error = (got / row.value - 1.0).abs();
        assert!(error <= ELASTICA, "{row:?}: got {got}: {error:e}");
        worst = f64::max(worst, error);
    }
    println!("elastica: {worst:e}");
}

/// A moment that is dead in space has no potential: beyond half a circle the symmetric part of the stiffness is indefinite, but
/// all eigenvalues of the whole have positive real parts.
#[test]
fn a_tip_moment_rolls_the_rod_up() {
    for row in rows_of("rollup") {
        let mut rod = Rod::slender();
        let full = 2.0 * PI * rod.bending / rod.length;
        let moment =
            |part: f64| Inputs { tip_moment: Vector3::new(-part * full, 0.0, 0.0), ..Inputs::unloaded(0) };
        for part in [0.25, 0.49, 0.75, 1.0] {
            let report = rod.equilibrium.solve(&moment(part)).expect("finite inputs");
            assert!(report.solved(), "{part} of a circle: {report:?}");
            assert!(report.stable == Some(true) && report.snaps == 0, "{part} of a circle: {report:?}");
            let tip = rod.equilibrium.tip().position / rod.length;
            let angle = 2.0 * PI * part;
            let expected = [0.0, (1.0 - angle.cos()) / angle, angle.sin() / angle];
            for (got, expected) in tip.iter().zip(expected) {
                assert!((got - expected).abs() <= ELASTICA, "{part} of a circle: {tip:?}");
            }
        }
        let distance = rod.equilibrium.tip().position.norm() / rod.length;
        println!("rollup: gap {distance:e}");
        assert!((distance - row.value).abs() <= ELASTICA, "{row:?}: got {distance:e}");
    }
}

#[test]
fn a_column_buckles_under_its_own_weight() {
    for row in rows_of("greenhill") {
        let mut rod = Rod::slender();
        let straight = vec![0.0; rod.equilibrium.freedoms()];
        // q L^3/EI with q = line mass times gravity.
        let unit = rod.bending / (rod.line_mass * rod.length.powi(3));
        let found = last_true(0.5 * row.value, 2.0 * row.value, |load| {
            let gravity = Vector3::new(0.0, 0.0, -load * unit);
            is_stable(&mut rod.equilibrium, &Inputs { gravity, ..Inputs::unloaded(0) }, &straight)
        });
        let error = (found / row.value - 1.0).abs();
        assert!(error <= CRITICAL_WITHOUT_PAIRS, "{row:?}: got {found}: {error:e}");
        println!("greenhill: {error:e}");
    }
}

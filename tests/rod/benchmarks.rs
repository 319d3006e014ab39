//! Elastic rods: tip load, tip moment, own weight.

use core::f64::consts::PI;

use mcm::design::{Cylinder, CylinderMaterial, Design, Specification};
use mcm::equilibrium::Inputs;
use mcm::geometry::Pose;
use mcm::numerics::trust_region::dual_norm;
use mcm::rod::{Configuration, Element, Piece};
use nalgebra::Vector3;

use super::table::{Rod, rows_of};
use crate::equilibrium::critical::{is_stable, last_true};
use crate::tolerance::{CRITICAL_WITHOUT_PAIRS, ELASTICA, assert_close};

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

/// A moment that is dead in space has no potential in space. Past half a circle the symmetric part of its stiffness is
/// indefinite and the solver refuses the arc; that the full circle is an equilibrium is seen without solving.
#[test]
fn a_tip_moment_rolls_the_rod_up() {
    for row in rows_of("rollup") {
        let mut rod = Rod::slender();
        let full = 2.0 * PI * rod.bending / rod.length;
        let moment =
            |part: f64| Inputs { tip_moment: Vector3::new(-part * full, 0.0, 0.0), ..Inputs::unloaded(0) };
        // The full circle: sixteen equal arcs.
        let elements = 16;
        let per_element = rod.equilibrium.freedoms() / elements;
        let mut circle = vec![0.0; rod.equilibrium.freedoms()];
        circle.iter_mut().step_by(per_element).for_each(|angle| *angle = -2.0 * PI / elements as f64);
        let (_, gradient) = rod.equilibrium.gradient(&moment(1.0), &circle).expect("nothing touches");
        let metric = rod.equilibrium.metric();
        let residual = dual_norm(metric, &gradient) / metric[0].sqrt();
        assert!(residual <= ELASTICA, "{row:?}: the circle is no equilibrium: {residual:e}");
        let distance = circle_gap(rod.length, elements);
        assert!((distance - row.value).abs() <= ELASTICA, "{row:?}: got {distance:e}");
        println!("rollup: residual {residual:e}, gap {distance:e}");
        // What is solved: up to just below half a circle.
        let part = 0.49;
        rod.solve(&moment(part));
        let tip = rod.equilibrium.tip().position / rod.length;
        let angle = 2.0 * PI * part;
        let expected = [0.0, (1.0 - angle.cos()) / angle, angle.sin() / angle];
        assert_close("arc", tip.as_slice(), &expected, ELASTICA);
        let report = rod.equilibrium.solve(&moment(0.55)).expect("finite inputs");
        assert!(!report.solved, "past half a circle: now that it is solved, solve the full one: {report:?}");
    }
}

/// Distance from base to tip of equal arcs that make a full circle, over the length, by the kinematics alone.
fn circle_gap(length: f64, elements: usize) -> f64 {
    let design = Design::new(Specification::Cylinder(Cylinder {
        length,
        radius: 1e-5,
        inner_radius: 0.0,
        material: CylinderMaterial::Bulk { elastic_modulus: 1e9, poisson: 0.0, remanence: 0.0 },
        density: None,
    }))
    .expect("allowed");
    let span = &design.segments()[0].spans[0];
    let element = Element::new(0.0, &[Piece { span, length: length / elements as f64 }], 4);
    let mut amplitudes = vec![0.0; element.freedoms()];
    amplitudes[0] = -2.0 * PI / elements as f64;
    let mut arc = Configuration::straight(&element);
    arc.update(&element, &amplitudes);
    let mut tip = Pose::identity();
    for _ in 0..elements {
        tip = Pose { position: tip.transform(&arc.end.position), rotation: tip.rotation * arc.end.rotation };
    }
    tip.position.norm() / length
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

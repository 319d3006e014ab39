//! The rules of ring pairs, against adaptive integrals over the charged faces and against the reference.

use core::f64::consts::TAU;

use mcm::constants::VACUUM_PERMEABILITY;
use mcm::geometry::Pose;
use mcm::magnetics::{AxialSource, PairRule, PairTable, Wrench};
use nalgebra::{Rotation3, Vector3};
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};

use super::face_integral::by_faces;
use super::reference::{Row, ring, table};
use crate::tolerance::{
    DIFFERENCE, OTHER_PAIR, PAIR_DEFAULT, PAIRS, RING_PAIR, RING_PAIR_TIGHT, WRENCH_ACCURACY,
};

/// Accuracies that are asked for: the default, and the best.
const ACCURACIES: [f64; 2] = [PAIR_DEFAULT, PAIRS];

/// Gaps between two rings, mm.
const GAPS: [f64; 17] =
    [0.1, 0.2, 0.5, 1.0, 2.0, 3.0, 3.5, 3.8, 4.0, 4.5, 5.0, 6.0, 7.0, 9.0, 14.0, 20.0, 40.0];

fn rules(accuracy: f64) -> PairTable {
    PairTable::new(ring().inner_radius(), ring().outer_radius(), ring().length(), accuracy)
}

fn pose(position: [f64; 3], turn: [f64; 3]) -> Pose {
    Pose { position: position.into(), rotation: Rotation3::new(Vector3::from(turn)).into_inner() }
}

/// Energy and wrench on one ring in the field of another one by a rule.
fn by_rule(source: &AxialSource, pose: &Pose, rule: PairRule<'_>) -> (f64, Wrench) {
    let magnetisation = source.remanence() / VACUUM_PERMEABILITY;
    let mut wrench = Wrench { force: Vector3::zeros(), torque: Vector3::zeros() };
    let mut energy = 0.0;
    match rule {
        PairRule::Axis(rule, _) => {
            for (height, volume) in rule.points() {
                let arm = pose.axis() * height;
                let (field, gradient) = source.field_gradient(&(pose.position + arm)).expect("outside");
                let moment = pose.axis() * (magnetisation * volume);
                let force = gradient * moment;
                energy -= moment.dot(&field);
                wrench.force += force;
                wrench.torque += arm.cross(&force) + moment.cross(&field);
            }
        }
        PairRule::Faces(rules) | PairRule::Surface(rules, _) => {
            for (rule, side) in rules.iter().zip([-1.0, 1.0]) {
                for (position, area) in rule.points() {
                    let height = side * 0.5 * source.length();
                    let arm = pose.rotation * Vector3::new(position.x, position.y, height);
                    let (potential, field) = source.potential_field(&(pose.position + arm)).expect("outside");
                    let force = field * (side * magnetisation * area);
                    energy += side * magnetisation * area * potential;
                    wrench.force += force;
                    wrench.torque += arm.cross(&force);
                }
            }
        }
    }
    (energy, wrench)
}

/// Error of force and torque, relative to `|F| + |T|/a` and `|F| a + |T|`.
fn error(body: &AxialSource, got: &Wrench, expected: &Wrench) -> f64 {
    let radius = body.outer_radius();
    let scale = expected.force.norm() + expected.torque.norm() / radius;
    let (force, torque) = (got.force - expected.force, got.torque - expected.torque);
    force.norm().max(torque.norm() / radius) / scale
}

/// What the rules must hold at an accuracy that is asked for.
fn allowed(accuracy: f64) -> f64 {
    if accuracy < PAIR_DEFAULT { RING_PAIR_TIGHT } else { RING_PAIR }
}

/// Two rings with that gap between the one's face and what of the other one is nearest to it: in line, turned, shifted,
/// both, steep, and beside one another.
fn poses(gap: f64) -> Vec<Pose> {
    let (outer, length) = (ring().outer_radius(), ring().length());
    let at = |aside: f64, turn: f64, around: f64| {
        let depth = 0.5 * length * turn.cos() + outer * turn.sin();
        pose([aside, 0.0, 0.5 * length + gap + depth], [turn * around.cos(), turn * around.sin(), 0.0])
    };
    vec![
        at(0.0, 0.0, 0.0),
        at(0.0, 0.05, 0.3),
        at(0.8e-3, 0.0, 0.0),
        at(0.6e-3, 0.35, 1.1),
        at(1.7e-3, 0.9, 2.0),
        at(2.5e-3, 1.5, -0.7),
        pose([2.0 * outer + gap, 0.0, 0.3e-3], [0.0; 3]),
    ]
}

#[test]
fn every_gap_from_a_tenth_of_a_millimetre_holds_the_accuracy() {
    let source = ring();
    for accuracy in ACCURACIES {
        let rules = rules(accuracy);
        for gap in GAPS {
            let gap = 1e-3 * gap;
            let (mut worst, mut worst_energy) = (0.0_f64, 0.0_f64);
            for (case, pose) in poses(gap).iter().enumerate() {
                let (energy, expected) = by_faces(&source, &source, pose);
                let rule = rules.rule(rules.choose(&source, pose));
                let (got_energy, got) = by_rule(&source, pose, rule);
                let (error, off) = (error(&source, &got, &expected), (got_energy / energy - 1.0).abs());
                let most = error.max(off);
                assert!(most <= allowed(accuracy), "{gap} m, case {case}, {accuracy:e}: {most:e}, {rule:?}");
                (worst, worst_energy) = (worst.max(error), worst_energy.max(off));
            }
            println!("{accuracy:e}, {gap} m: wrench {worst:.1e}, energy {worst_energy:.1e}");
        }
    }
}

#[test]
fn the_rules_match_the_reference() {
    let source = ring();
    let rows: Vec<Row<10>> = table("ring_pair_wrench_dev.csv");
    for accuracy in ACCURACIES {
        let rules = rules(accuracy);
        let (mut worst, mut faces) = (0.0_f64, 0);
        for Row { point, values } in &rows {
            let pose = Pose::new((*point).into(), core::array::from_fn(|i| values[i])).expect("a unit");
            let expected = Wrench {
                force: Vector3::from_row_slice(&values[4..7]),
                torque: Vector3::from_row_slice(&values[7..10]),
            };
            let rule = rules.rule(rules.choose(&source, &pose));
            let error = error(&source, &by_rule(&source, &pose, rule).1, &expected);
            assert!(error <= allowed(accuracy), "{point:?}, {accuracy:e}: {error:e}");
            worst = worst.max(error);
            faces += usize::from(matches!(rule, PairRule::Faces(_)));
        }
        println!("{accuracy:e}: {worst:.1e}, {faces} of {} by faces", rows.len());
        assert!(faces > 0);
    }
}

#[test]
fn rings_of_other_shapes_do_nearly_as_well() {
    let mut rng = StdRng::seed_from_u64(7);
    // Disc, thin wall, tube, washer, wire: inner radius, outer radius, length, mm.
    for shape in [[0.0, 2.0, 1.0], [1.5, 2.0, 1.0], [0.75, 2.0, 4.0], [0.75, 2.0, 0.5], [0.3, 0.5, 3.0]] {
        let [inner, outer, length] = shape.map(|size| 1e-3 * size);
        let source = AxialSource::new(inner, outer, length, 1.35).expect("valid");
        let rules = PairTable::new(inner, outer, length, PAIR_DEFAULT);
        let (mut worst, mut on_axis) = (0.0_f64, 0);
        for _ in 0..150 {
            let gap = outer * rng.random_range(-1.0..1.6_f64).exp();
            let (turn, around) = (rng.random_range(0.0..0.8_f64), rng.random_range(0.0..TAU));
            let depth = 0.5 * length * turn.cos() + outer * turn.sin();
            let at = [rng.random_range(0.0..outer), 0.0, 0.5 * length + gap + depth];
            let pose = pose(at, [turn * around.cos(), turn * around.sin(), 0.0]);
            let expected = source.wrench_on(&source, &pose, WRENCH_ACCURACY).expect("apart");
            let rule = rules.rule(rules.choose(&source, &pose));
            worst = worst.max(error(&source, &by_rule(&source, &pose, rule).1, &expected));
            on_axis += usize::from(matches!(rule, PairRule::Axis(..)));
        }
        println!("{shape:?} mm: {worst:.1e}, {on_axis} on the axis");
        assert!(worst <= OTHER_PAIR && (10..150).contains(&on_axis), "{shape:?}: {worst:e}, {on_axis}");
    }
}

#[test]
fn rules_meet_within_the_accuracy() {
    let source = ring();
    let rules = rules(PAIR_DEFAULT);
    for (aside, turn) in [(0.0, 0.0), (0.3e-3, 0.2), (0.9e-3, 0.6)] {
        let at = |gap: f64| {
            let depth = 0.5 * source.length() + source.outer_radius() * f64::sin(turn);
            pose([aside, 0.0, 0.5 * source.length() + gap + depth], [0.0, turn, 0.0])
        };
        let (mut gap, mut changes, mut worst) = (20e-3, 0, 0.0_f64);
        let mut number = rules.choose(&source, &at(gap));
        while gap > 0.1e-3 {
            gap -= 5e-6;
            let next = rules.choose(&source, &at(gap));
            if next != number {
                let [old, new] = [number, next].map(|number| by_rule(&source, &at(gap), rules.rule(number)));
                let jump = error(&source, &old.1, &new.1).max((old.0 / new.0 - 1.0).abs());
                assert!(jump <= 2.0 * RING_PAIR, "{aside} m, {turn} rad, gap {gap} m: {jump:e}");
                (number, changes, worst) = (next, changes + 1, worst.max(jump));
            }
        }
        println!("{aside} m, {turn} rad: {changes} changes, at most {worst:.1e}");
        assert!(changes > 10, "the walk passes all kinds of rules");
    }
}

#[test]
fn the_field_is_minus_the_slope_of_the_potential() {
    let source = ring();
    for at in [
        [1e-4, 0.0, 0.2e-3],
        [0.3e-3, -0.5e-3, 0.45e-3],
        [1.9e-3, 0.3e-3, 0.61e-3],
        [-2.2e-3, 0.1e-3, 0.1e-3],
        [1.0e-3, 1.0e-3, -0.7e-3],
        [2.0e-3, 0.0, 2.0e-3],
        [5.0e-3, 3.0e-3, 7.0e-3],
        [20e-3, -10e-3, 15e-3],
    ] {
        let at = Vector3::from(at);
        let (_, field) = source.potential_field(&at).expect("outside");
        assert_eq!(field, source.field(&at).expect("outside"));
        let (_, same, gradient) = source.potential_field_gradient(&at).expect("outside");
        assert_eq!((same, gradient), source.field_gradient(&at).expect("outside"));
        let step = 1e-4 * source.distance(&at);
        let slope = Vector3::from_fn(|axis, _| {
            let [ahead, back] = [step, -step].map(|by| {
                let there = at + Vector3::ith(axis, by);
                source.potential_field(&there).expect("outside").0
            });
            (back - ahead) / (2.0 * step)
        });
        let error = (slope - field).norm() / field.norm();
        assert!(error <= DIFFERENCE, "{at:?}: {error:e}");
    }
}

#[test]
fn inside_the_material_the_potential_is_that_of_h() {
    let source = ring();
    let at = Vector3::new(1.2e-3, 0.4e-3, 0.1e-3);
    let h = source.field(&at).expect("no edge") - Vector3::z() * source.remanence();
    let step = 1e-7;
    let [ahead, back] =
        [step, -step].map(|by| source.potential_field(&(at + Vector3::z() * by)).expect("no edge").0);
    assert!(((back - ahead) / (2.0 * step) / h.z - 1.0).abs() <= DIFFERENCE);
}

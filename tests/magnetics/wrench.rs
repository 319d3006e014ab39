//! The wrench between two rings, against the reference and against itself.

use core::f64::consts::PI;

use mcm::constants::VACUUM_PERMEABILITY;
use mcm::error::Error;
use mcm::geometry::Pose;
use mcm::magnetics::{AxialSource, Wrench};
use nalgebra::{Rotation3, Vector3};

use super::reference::{Row, ring, table};
use crate::given::pair;
use crate::tolerance::{WRENCH, WRENCH_ACCURACY, assert_close};

/// Pose with the rotation vector `turn` (rad).
fn pose(position: [f64; 3], turn: [f64; 3]) -> Pose {
    Pose { position: position.into(), rotation: Rotation3::new(Vector3::from(turn)).into_inner() }
}

/// Largest error of force and torque, relative to `|F| + |T|/a` and `|F| a + |T|`.
fn error(got: &Wrench, expected: &Wrench) -> f64 {
    let radius = 2.0e-3;
    let scale = expected.force.norm() + expected.torque.norm() / radius;
    let (force, torque) = (got.force - expected.force, got.torque - expected.torque);
    force.norm().max(torque.norm() / radius) / scale
}

#[test]
fn ring_on_ring_matches_the_reference() {
    let source = ring();
    let rows: Vec<Row<10>> = table("ring_pair_wrench_dev.csv");
    for Row { point, values } in &rows {
        let at = Pose::new((*point).into(), core::array::from_fn(|i| values[i])).expect("unit quaternion");
        let expected = Wrench {
            force: Vector3::from_row_slice(&values[4..7]),
            torque: Vector3::from_row_slice(&values[7..10]),
        };
        for (accuracy, tolerance) in [(WRENCH_ACCURACY, WRENCH), (1e-6, 1e-6), (1e-3, 1e-3)] {
            let got = source.wrench_on(&source, &at, accuracy).expect("apart");
            let error = error(&got, &expected);
            assert!(error <= tolerance, "{point:?} at {accuracy:e}: error {error:e}: {got:?}, {expected:?}");
        }
    }
}

#[test]
fn action_is_reaction() {
    let (small, large) = (ring(), AxialSource::new(0.0, 3.0e-3, 2.0e-3, -1.0).expect("allowed"));
    let at = pose([3.0e-3, 1.0e-3, 5.5e-3], [0.4, -0.3, 0.2]);
    let on_large = small.wrench_on(&large, &at, 1e-10).expect("apart");
    let back = at.rotation.transpose();
    let inverse = Pose { position: -(back * at.position), rotation: back };
    let on_small = large.wrench_on(&small, &inverse, 1e-10).expect("apart");
    let reaction = on_large.reaction(&at.position);
    assert_close("force", (at.rotation * on_small.force).as_slice(), reaction.force.as_slice(), 1e-9);
    assert_close("torque", (at.rotation * on_small.torque).as_slice(), reaction.torque.as_slice(), 1e-9);
}

#[test]
fn far_away_it_is_that_of_two_dipoles() {
    let source = ring();
    let moment = source.moment();
    let distance = 0.5;
    let wrench = source.wrench_on(&source, &pose([0.0, 0.0, distance], [0.0; 3]), 1e-9).expect("apart");
    let expected = -6.0 * VACUUM_PERMEABILITY * moment * moment / (4.0 * PI * distance.powi(4));
    assert_close("coaxial dipoles", wrench.force.as_slice(), &[0.0, 0.0, expected], 1e-3);
}

#[test]
fn a_ring_in_the_pairs_field_feels_its_gradient() {
    let (magnet, body) = (pair(), ring());
    let at = pose([0.01, 0.0625, 0.04], [0.3, 0.1, 0.0]);
    let wrench = magnet.wrench_on(&body, &at, 1e-9).expect("apart");
    let (field, gradient) = magnet.field_gradient(&at.position).expect("outside");
    let moment = at.axis() * body.moment();
    // As a point: the next order is (s/d)^2 = 1e-3.
    assert_close("force", wrench.force.as_slice(), (gradient * moment).as_slice(), 2e-3);
    assert_close("torque", wrench.torque.as_slice(), moment.cross(&field).as_slice(), 2e-3);
}

#[test]
fn bodies_that_overlap_are_refused() {
    let source = ring();
    for (position, turn) in [
        ([0.0, 0.0, 0.0], [0.0; 3]),
        ([0.0, 0.0, 0.9e-3], [0.0; 3]),
        ([1.0e-3, 0.0, 0.5e-3], [0.0; 3]),
        ([0.0, 0.0, 1.5e-3], [0.8, 0.0, 0.0]),
        ([2.0e-3, 0.0, 0.0], [0.0, 1.57, 0.0]),
    ] {
        let refused = source.wrench_on(&source, &pose(position, turn), 1e-3);
        assert!(matches!(refused, Err(Error::Unsupported(_))), "{position:?}: {refused:?}");
    }
    let magnet = pair();
    assert!(magnet.wrench_on(&source, &pose([0.0, 0.0, -20e-3], [0.0; 3]), 1e-3).is_err());
    assert!(magnet.wrench_on(&source, &pose([0.0; 3], [0.0; 3]), 1e-3).is_ok(), "in the gap");
}

#[test]
fn an_accuracy_that_cannot_be_held_is_refused() {
    let source = ring();
    let touching = pose([0.0, 0.0, 1.0e-3 + 1e-7], [0.0; 3]);
    assert!(source.wrench_on(&source, &touching, 1e-11).is_err());
    let apart = pose([0.0, 0.0, 5.0e-3], [0.0; 3]);
    for accuracy in [f64::NAN, 0.0, -1.0, 1e-15, 0.5] {
        assert!(source.wrench_on(&source, &apart, accuracy).is_err(), "{accuracy}");
    }
}

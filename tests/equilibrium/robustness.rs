//! Whatever the field: an answer that is a stable equilibrium, or a plain no; and the way back is the way there.

use std::cell::Cell;

use mcm::design::{Design, Specification};
use mcm::equilibrium::{Equilibrium, Inputs, Interaction, Settings, Solution};
use nalgebra::Vector3;
use proptest::prelude::*;
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};

use super::critical::is_stable;
use crate::tolerance::{RESIDUAL, RETURN};

const CASES: u32 = 60;

/// Parts of the way from no field to the field and back.
const PARTS: u32 = 8;

/// A runner with a seed of its own; a failing case is printed with its values, shrunk.
fn runner(seed: u8) -> TestRunner {
    let config = Config { cases: CASES, failure_persistence: None, ..Config::default() };
    println!("seed {seed}");
    TestRunner::new_with_rng(config, TestRng::from_seed(RngAlgorithm::ChaCha, &[seed; 32]))
}

/// A field of up to 50 mT in any direction, on 1 to 4 segments, at either level.
fn scenes() -> impl Strategy<Value = (usize, bool, f64, f64, f64)> {
    (1_usize..=4, any::<bool>(), 0.0..0.05, -1.0..1.0, 0.0..core::f64::consts::TAU)
}

fn build(segments: usize, rings: bool, size: f64, cosine: f64, azimuth: f64) -> (Equilibrium, Inputs) {
    let design = Design::new(Specification::paper(segments)).expect("allowed");
    let interaction = if rings { Interaction::Rings } else { Interaction::None };
    let settings = Settings { interaction, ..Settings::default() };
    let equilibrium = Equilibrium::new(&design, None, settings, 5).expect("allowed");
    let sine = (1.0 - cosine * cosine).sqrt();
    let direction = Vector3::new(sine * azimuth.cos(), sine * azimuth.sin(), cosine);
    (equilibrium, Inputs { uniform_field: direction * size, ..Inputs::unloaded(segments + 1) })
}

fn is_finite(equilibrium: &Equilibrium) -> bool {
    let (magnetic, base) = (equilibrium.magnetic_wrench(), equilibrium.base_reaction());
    let poses = equilibrium.rings().chain([equilibrium.tip()]);
    poses
        .flat_map(|pose| pose.position.iter().chain(pose.rotation.iter()).copied().collect::<Vec<_>>())
        .chain(equilibrium.shape().flat_map(|(_, point)| point.iter().copied().collect::<Vec<_>>()))
        .chain(equilibrium.core_angles())
        .chain(
            [magnetic.force, magnetic.torque, base.force, base.torque]
                .iter()
                .flat_map(|v| v.iter().copied().collect::<Vec<_>>()),
        )
        .all(f64::is_finite)
}

#[test]
fn a_solved_shape_is_a_stable_equilibrium() {
    let solved = Cell::new(0);
    runner(1)
        .run(&scenes(), |(segments, rings, size, cosine, azimuth)| {
            let (mut equilibrium, inputs) = build(segments, rings, size, cosine, azimuth);
            let report = equilibrium.solve(&inputs).expect("finite inputs");
            prop_assert!(is_finite(&equilibrium), "{report:?}");
            if report.solved() {
                solved.set(solved.get() + 1);
                prop_assert!(report.residual <= RESIDUAL, "{report:?}");
                prop_assert!(report.margin > 0.0, "{report:?}");
                let shape = equilibrium.unknowns().to_vec();
                prop_assert!(
                    is_stable(&mut equilibrium, &inputs, &shape),
                    "the Hessian is not positive definite: {report:?}"
                );
            }
            Ok(())
        })
        .unwrap();
    println!("{} of {CASES} solved", solved.get());
    assert!(2 * solved.get() > CASES, "only {} of {CASES} solved", solved.get());
}

#[test]
fn without_a_snap_the_way_back_is_the_way_there() {
    let returned = Cell::new(0);
    runner(2)
        .run(&scenes(), |(segments, rings, size, cosine, azimuth)| {
            let (mut equilibrium, inputs) = build(segments, rings, size, cosine, azimuth);
            let at = |part: u32| Inputs {
                uniform_field: inputs.uniform_field * (f64::from(part) / f64::from(PARTS)),
                ..inputs.clone()
            };
            let mut positions = Vec::new();
            for part in (0..=PARTS).chain((0..PARTS).rev()) {
                let report = equilibrium.solve(&at(part)).expect("finite inputs");
                if !report.solved() || report.snaps > 0 {
                    return Ok(());
                }
                positions.push(equilibrium.tip());
            }
            returned.set(returned.get() + 1);
            for (there, back) in positions.iter().zip(positions.iter().rev()) {
                let error =
                    (there.position - back.position).norm() / 0.05 + (there.rotation - back.rotation).norm();
                prop_assert!(error <= RETURN, "another shape on the way back: {error:e}");
            }
            Ok(())
        })
        .unwrap();
    println!("{} of {CASES} returned", returned.get());
    assert!(2 * returned.get() > CASES, "only {} of {CASES} without a snap", returned.get());
}

#[test]
fn inputs_that_are_no_numbers_are_refused_and_change_nothing() {
    let (mut equilibrium, inputs) = build(2, true, 0.02, 0.3, 1.0);
    equilibrium.solve(&inputs).expect("finite inputs");
    let before = equilibrium.unknowns().to_vec();
    for bad in [f64::NAN, f64::INFINITY] {
        let mut broken = vec![inputs.clone(); 7];
        broken[0].uniform_field.y = bad;
        broken[1].field_gradient[3] = bad;
        broken[2].base.position.x = bad;
        broken[3].insertion = bad;
        broken[4].tip_moment.z = bad;
        broken[5].ring_forces[2].z = bad;
        broken[6].tip_force.x = bad;
        for (number, inputs) in broken.iter().enumerate() {
            assert!(equilibrium.solve(inputs).is_err(), "broken inputs {number} with {bad} were accepted");
            assert_eq!(equilibrium.unknowns(), before, "broken inputs {number} moved the shape");
        }
    }
    let short = Inputs { ring_forces: vec![Vector3::zeros(); 2], ..inputs };
    assert!(equilibrium.solve(&short).is_err(), "a missing ring force was accepted");
}

#[test]
fn a_shape_that_may_turn_about_the_field_is_not_called_stable() {
    for segments in [1, 3, 9] {
        for size in [0.035, 0.045, 0.06] {
            let (mut equilibrium, against) = build(segments, false, size, -1.0, 0.0);
            let mut across = against.clone();
            across.uniform_field.y = 0.02;
            assert!(equilibrium.solve(&across).expect("valid").solved());
            let report = equilibrium.solve(&against).expect("valid");
            let bent = equilibrium.tip().axis().angle(&Vector3::z()).to_degrees();
            // Any turn about the axis is as good: nothing holds it.
            assert!(report.solved() && bent > 10.0, "S = {segments}, {size} T: {bent} deg");
            assert_eq!((report.stable, report.margin), (Some(false), 0.0), "S = {segments}, {size} T");
        }
    }
}

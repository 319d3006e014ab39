//! Snaps are told where they are, and only there.

mod levels;
pub(crate) mod ramps;
pub(crate) mod ways;

use core::f64::consts::PI;

use mcm::manipulator::{Branch, Inputs, Manipulator, Outcome, Scene};
use nalgebra::Vector3;

use crate::tolerance::{FOLD_OF_A_STEP, NO_FOLD_BEFORE_T};
use ramps::{Ramp, Verdict};
use ways::{Comparison, Way};

const SEED: u64 = 1;

/// Ramps of the recorded run that are followed here.
const RAMPS: u64 = 8;

/// A ramp whose snap has a hysteresis as narrow as the smallest part of a step.
const NARROW: u64 = 345;

/// Coarse steps of a way.
const STEPS: usize = 40;

#[test]
fn coarse_walks_snap_where_fine_ones_do() {
    let (mut alike, mut snapped) = (0, 0);
    for index in 0..12 {
        let way = Way::random(SEED, index);
        match way.compare(STEPS) {
            Comparison::Unfit | Comparison::End => {}
            Comparison::Alike(snaps) => (alike, snapped) = (alike + 1, snapped + snaps),
            Comparison::Differs(how) => panic!("seed {SEED}, way {index}: {how}; {way:?}"),
        }
    }
    println!("{alike} of 12 alike, {snapped} snaps");
    assert!(alike > 6, "{alike}");
}

#[test]
fn snaps_and_ends_do_not_depend_on_the_steps() {
    let (mut alike, mut folds) = (0, 0);
    for index in (0..RAMPS).chain([NARROW]) {
        let ramp = Ramp::random(SEED, index);
        match ramp.compare() {
            Verdict::Unfit => {}
            Verdict::Alike(count, _) => (alike, folds) = (alike + 1, folds + count),
            Verdict::Differs(how) => panic!("seed {SEED}, ramp {index}: {how}; {ramp:?}"),
        }
    }
    println!("{alike} of {RAMPS} alike, {folds} folds");
    assert!(2 * alike > RAMPS, "{alike}");
}

/// Nine segments above the paper's pair of magnets.
fn above() -> Scene {
    let text = "[design]\nsegments = 9\n[magnet]\nposition_mm = [0, -50, 3]\n[model]\ninteraction = \"none\"";
    Scene::parse(text, "above").expect("a scene")
}

fn of_strength(scene: &Scene, strength: f64) -> Inputs {
    let mut inputs = scene.inputs.clone();
    inputs.sources[0].strength = strength;
    inputs
}

/// Solves at each; the values in whose steps a snap was told.
fn snaps(manipulator: &mut Manipulator, scene: &Scene, strengths: impl Iterator<Item = u32>) -> Vec<u32> {
    let mut out = Vec::new();
    for strength in strengths {
        let before = manipulator.outputs().snaps;
        let inputs = of_strength(scene, f64::from(strength) * 1e-5);
        let report = manipulator.solve(&inputs).expect("finite inputs");
        assert!(report.outcome.is_solved(), "{strength}: {report:?}");
        out.extend((before..report.snaps).map(|_| strength));
    }
    out
}

#[test]
fn a_stronger_magnet_snaps_at_one_strength_and_back_at_another() {
    let scene = above();
    let mut manipulator = scene.manipulator(2).expect("allowed");
    assert_eq!(snaps(&mut manipulator, &scene, (180..=260).step_by(2)), [252]);
    assert_eq!(snaps(&mut manipulator, &scene, (180..=260).rev().step_by(2)), [188]);
    let path = |strength: f64| Ok(of_strength(&scene, strength));
    let mut branch = Branch::new(scene.manipulator(2).expect("allowed"), path, 8e-4, 2e-5).expect("a path");
    for strength in [1.8e-3, 2.6e-3, 1.8e-3] {
        branch.to(strength).expect("finite inputs");
    }
    let folds: Vec<(f64, bool)> = branch.folds().iter().map(|fold| (fold.value, fold.upwards)).collect();
    println!("{folds:?}");
    let [(up, true), (down, false)] = folds[..] else { panic!("folds at {folds:?}") };
    assert!((up - 2.51e-3).abs() < FOLD_OF_A_STEP && (down - 1.89e-3).abs() < FOLD_OF_A_STEP, "{folds:?}");
}

/// Beyond 29.25 mT the straight shape is no longer stable, and the bent ones leave it continuously.
#[test]
fn at_a_pitchfork_there_is_no_snap() {
    let text = "[design]\nsegments = 1\nspiral = \"axisymmetric\"\n[model]\ninteraction = \"rings\"";
    let scene = Scene::parse(text, "against").expect("a scene");
    let against = |size: f64| Inputs { uniform_field: Vector3::new(0.0, 0.0, -size), ..scene.inputs.clone() };
    let mut manipulator = scene.manipulator(2).expect("allowed");
    for step in 0..=40 {
        let size = 0.028 + 5e-5 * f64::from(step);
        let out = manipulator.solve(&against(size)).expect("finite inputs");
        let expected = if size < NO_FOLD_BEFORE_T { Outcome::Solved } else { Outcome::Neutral };
        assert_eq!((out.outcome, out.snaps), (expected, 0), "{size} T: {out:?}");
        assert!(out.tip_angle < PI / 2.0, "{size} T: {out:?}");
    }
    let mut branch =
        Branch::new(scene.manipulator(2).expect("allowed"), |size| Ok(against(size)), 0.002, 5e-5)
            .expect("a path");
    for size in [0.028, 0.03, 0.028] {
        branch.to(size).expect("finite inputs");
    }
    assert!(branch.folds().is_empty(), "{:?}", branch.folds());
}

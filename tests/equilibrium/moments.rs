//! A dead moment on the tip, however small: its limit is the answer without it, and what is called stable is stable.

use mcm::design::{Design, Specification};
use mcm::equilibrium::{Equilibrium, Inputs, Interaction, Outcome, Settings};
use mcm::manipulator::Scene;
use nalgebra::Vector3;
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};

use crate::hostile::judge::Judge;
use crate::tolerance::{LIMIT_OF_MOMENT, LIMIT_ROUNDING, NOISE_OF_EIGENVALUES, RESIDUAL, TURNED_OVER_DEG};

const SEED: u64 = 20;

/// Random fields.
const FIELDS: u64 = 120;

/// Strongest field, T.
const STRONGEST: f64 = 0.03;

/// Moments, N m.
const MOMENTS: [f64; 3] = [1e-12, 1e-9, 1e-6];

/// Margin from which on the shape is a smooth function of a moment of the largest of these.
const HELD: f64 = 0.1;

fn direction(random: &mut StdRng) -> Vector3<f64> {
    let height: f64 = random.random_range(-1.0..=1.0);
    let azimuth = random.random_range(0.0..core::f64::consts::TAU);
    let across = (1.0 - height * height).sqrt();
    Vector3::new(across * azimuth.cos(), across * azimuth.sin(), height)
}

fn model(segments: usize, interaction: Interaction) -> Equilibrium {
    let design = Design::new(Specification::paper(segments)).expect("allowed");
    let settings = Settings { interaction, ..Settings::default() };
    Equilibrium::new(&design, None, settings, 2).expect("allowed")
}

/// Smallest real part of the eigenvalues at the answer, of which Newton's method with the whole matrix says that it is one.
fn smallest(equilibrium: &Equilibrium, inputs: &Inputs) -> f64 {
    let (mut copy, shape) = (equilibrium.clone(), equilibrium.unknowns().to_vec());
    let mut judge = Judge::new(&mut copy, inputs, false);
    let residual = judge.residual(&shape).expect("a gradient");
    assert!(residual <= RESIDUAL, "residual {residual}");
    let polished = judge.polished(&shape).expect("an equilibrium");
    judge.smallest_real_part(&polished).expect("eigenvalues")
}

#[test]
fn a_vanishing_moment_leaves_the_answer_without_it() {
    let mut random = StdRng::seed_from_u64(SEED);
    let (mut kept, mut held, mut worst) = (0, 0, 0.0_f64);
    for case in 0..FIELDS {
        let segments = [1, 3, 9][random.random_range(0..3)];
        let interaction = [Interaction::None, Interaction::Rings][random.random_range(0..2)];
        let uniform_field = direction(&mut random) * random.random_range(0.0..STRONGEST);
        let turned = direction(&mut random);
        let free = Inputs { uniform_field, ..Inputs::unloaded(segments + 1) };
        let name = format!("seed {SEED}, case {case}: S = {segments}, {interaction:?}, {uniform_field:?} T");
        let solve = |moment: f64| {
            let mut equilibrium = model(segments, interaction);
            let inputs = Inputs { tip_moment: turned * moment, ..free.clone() };
            let report = equilibrium.solve(&inputs).expect("finite inputs");
            (equilibrium, inputs, report)
        };
        let (without, _, expected) = solve(0.0);
        let (again, _, _) = solve(-0.0);
        assert_eq!(again.unknowns(), without.unknowns(), "{name}: no moment is no moment");
        if expected.outcome != Outcome::Solved {
            continue;
        }
        kept += 1;
        for moment in MOMENTS {
            let (with, inputs, report) = solve(moment);
            let told = format!("{name}, {moment} N m: {report:?}, without {expected:?}");
            if expected.margin < HELD && moment > MOMENTS[1] {
                assert!(report.outcome != Outcome::Solved || smallest(&with, &inputs) > 0.0, "{told}");
                continue;
            }
            assert_eq!((report.outcome, report.stable), (Outcome::Solved, Some(true)), "{told}");
            let way = (with.tip().position - without.tip().position).norm() / 0.005;
            let expected =
                LIMIT_ROUNDING + LIMIT_OF_MOMENT * (segments * segments) as f64 * moment / expected.margin;
            assert!(way <= expected, "{told}: tip moved by {way:e} segments, at most {expected:e}");
            worst = worst.max(way / expected);
            if case % 4 == 0 && segments < 9 {
                let smallest = smallest(&with, &inputs);
                assert!(smallest > 0.0, "{told}: eigenvalue {smallest}");
                held += 1;
            }
        }
    }
    println!("{kept} of {FIELDS} solved, {held} confirmed; tip within {worst:.2} of what is allowed");
    assert!(kept > FIELDS / 2 && held > 20, "{kept} solved, {held} confirmed");
}

#[test]
fn one_sided_forces_are_called_stable_where_the_eigenvalues_say_so() {
    let mut random = StdRng::seed_from_u64(SEED);
    let mut confirmed = 0;
    for case in 0..24 {
        let mut equilibrium = model(3, Interaction::Preceding);
        let uniform_field = direction(&mut random) * random.random_range(0.0..STRONGEST);
        let inputs = Inputs { uniform_field, ..Inputs::unloaded(4) };
        let report = equilibrium.solve(&inputs).expect("finite inputs");
        if !report.solved() {
            continue;
        }
        let smallest = smallest(&equilibrium, &inputs);
        let name =
            format!("seed {SEED}, case {case}: {uniform_field:?} T, {report:?}, eigenvalue {smallest}");
        assert!(smallest > -NOISE_OF_EIGENVALUES, "{name}");
        assert_eq!(report.stable == Some(true), smallest > NOISE_OF_EIGENVALUES, "{name}");
        confirmed += 1;
    }
    println!("{confirmed} of 24 solved and confirmed");
    assert!(confirmed > 8, "{confirmed}");
}

#[test]
fn a_moment_of_a_piconewtonmetre_does_not_choose_the_branch() {
    // Without the moment: 140.32 deg, and 126.71 deg with the windings' contact of `auto`.
    for (level, expected) in [("none", 140.32_f64), ("auto", 126.71)] {
        for moment in ["0", "1e-12"] {
            let text = format!(
                "[design]\nsegments = 3\n[field]\nuniform_mt = [0, 5.17638, -19.31852]\n\
                 [load]\ntip_moment_nm = [0, 0, {moment}]\n[model]\ninteraction = \"{level}\""
            );
            let scene = Scene::parse(&text, level).expect("a scene");
            let mut manipulator = scene.manipulator(2).expect("allowed");
            let out = manipulator.solve(&scene.inputs).expect("finite inputs");
            let angle = out.tip_angle.to_degrees();
            assert_eq!(
                (out.outcome, out.stable),
                (Outcome::Solved, Some(true)),
                "{level}, {moment}: {angle}"
            );
            assert!(
                (angle - expected).abs() < TURNED_OVER_DEG,
                "{level}, {moment}: {angle}, expected {expected}"
            );
        }
    }
}

//! A moment that is fixed in space has no potential, and does not choose the branch.

use mcm::design::{Design, Specification};
use mcm::equilibrium::{Equilibrium, Inputs, Interaction, Outcome, Settings, Solution, Verifier};
use mcm::manipulator::{Outputs, Scene};
use nalgebra::Vector3;
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};

use crate::given::direction;
use crate::tolerance::{MOVED_BY_A_MOMENT, RESIDUAL, SAME_TIP_MM, VANISHING_MOMENT_DEG};

/// N m, and the bending stiffness of the paper's core, N m2.
const VANISHING_MOMENT: f64 = 1e-12;
const BENDING_STIFFNESS: f64 = 1.3e-6;

/// Three segments in a field that turns them far over.
fn turned_over(interaction: &str, moment: f64) -> Outputs {
    let text = format!(
        "[design]\nsegments = 3\n[field]\nuniform_mt = [0, 5.17638, -19.31852]\n[load]\n\
         tip_moment_nm = [0, 0, {moment:e}]\n[model]\ninteraction = \"{interaction}\""
    );
    let mut scene = Scene::parse(&text, "turned over").expect("a scene");
    scene.settings.time_budget = 60.0;
    let mut manipulator = scene.manipulator(2).expect("allowed");
    manipulator.solve(&scene.inputs).expect("finite inputs").clone()
}

#[test]
fn a_vanishing_moment_leaves_the_answer_without_it() {
    for (interaction, expected) in [("none", 140.316), ("auto", 126.712)] {
        let without = turned_over(interaction, 0.0);
        assert!((without.tip_angle.to_degrees() - expected).abs() < 1e-2, "{interaction}: {without:?}");
        for moment in [1e-12, -1e-11] {
            let with = turned_over(interaction, moment);
            let apart = (with.tip_angle - without.tip_angle).to_degrees().abs();
            assert!(with.stable == Some(true) && apart <= VANISHING_MOMENT_DEG, "{interaction}: {apart}");
        }
    }
}

/// Of one to nine segments on the levels that have a potential without a moment, in a field of any direction.
fn in_a_field(random: &mut StdRng) -> (Equilibrium, Inputs) {
    let segments = [1, 3, 9][random.random_range(0..3)];
    let interaction = [Interaction::None, Interaction::Rings][random.random_range(0..2)];
    let mut inputs = Inputs::unloaded(segments + 1);
    inputs.uniform_field = direction(random) * random.random_range(0.0..0.06 / segments as f64);
    (model(segments, interaction), inputs)
}

fn model(segments: usize, interaction: Interaction) -> Equilibrium {
    let design = Design::new(Specification::paper(segments)).expect("the paper's");
    let settings = Settings { interaction, time_budget: 30.0, ..Settings::default() };
    Equilibrium::new(&design, None, settings, 2).expect("allowed")
}

/// A moment `m` moves the tip by about `m L^2 / (E I)` over the margin.
#[test]
fn in_any_field_a_vanishing_moment_changes_nothing() {
    let (mut solved, mut refused) = (0, 0);
    for number in 0..120 {
        let mut random = StdRng::seed_from_u64(number);
        let (mut without, mut inputs) = in_a_field(&mut random);
        let mut with = without.clone();
        let expected = without.solve(&inputs).expect("finite inputs");
        inputs.tip_moment = direction(&mut random) * VANISHING_MOMENT;
        let got = with.solve(&inputs).expect("finite inputs");
        assert_eq!(got.solved(), expected.solved(), "field {number}: {got:?}, {expected:?}");
        if !expected.solved() {
            refused += 1;
            continue;
        }
        solved += 1;
        assert_eq!((got.stable, got.snaps), (expected.stable, expected.snaps), "field {number}: {got:?}");
        let length = 0.005 * without.rings().count() as f64;
        let apart = (with.tip().position - without.tip().position).norm() / length;
        let moved = VANISHING_MOMENT * length / BENDING_STIFFNESS / expected.margin;
        assert!(apart <= MOVED_BY_A_MOMENT * moved, "field {number}: {apart:e}, by the moment {moved:e}");
        // At zero to the last bit.
        let mut back = without.clone();
        back.reset();
        back.solve(&Inputs { tip_moment: Vector3::zeros(), ..inputs }).expect("finite inputs");
        assert_eq!(back.tip(), without.tip(), "field {number}");
    }
    println!("{solved} solved, {refused} without a shape");
    assert!(solved > 60, "{solved}");
}

/// Cold, the shape is that of slow loading, and without the moment the one before.
#[test]
fn a_moment_is_loaded_slowly() {
    let text = "[design]\nsegments = 3\n[magnet]\nposition_mm = [0, -60, 5]\norientation_wxyz = [0.70711, 0.70711, 0, 0]\n\
                [model]\ninteraction = \"none\"";
    let scene = Scene::parse(text, "beside").expect("a scene");
    for about in [Vector3::x(), -Vector3::x(), Vector3::y(), Vector3::z()] {
        let of_moment = |part: f64| Inputs { tip_moment: about * (3e-6 * part), ..scene.inputs.clone() };
        let mut slow = scene.manipulator(2).expect("allowed");
        let start = slow.solve(&of_moment(0.0)).expect("finite inputs").clone();
        for step in 1..=50 {
            slow.solve(&of_moment(f64::from(step) / 50.0)).expect("finite inputs");
        }
        let loaded = slow.outputs().clone();
        assert!(start.outcome.is_solved() && loaded.outcome.is_solved() && loaded.snaps == 0, "{loaded:?}");
        let cold =
            scene.manipulator(2).expect("allowed").solve(&of_moment(1.0)).expect("finite inputs").clone();
        let apart = |a: &Outputs, b: &Outputs| (a.tip.position - b.tip.position).norm();
        assert!(apart(&cold, &loaded) <= SAME_TIP_MM / 1e3, "{about:?}: {:e} m", apart(&cold, &loaded));
        for step in (0..50).rev() {
            slow.solve(&of_moment(f64::from(step) / 50.0)).expect("finite inputs");
        }
        assert!(apart(slow.outputs(), &start) <= SAME_TIP_MM / 1e3, "{about:?}");
        assert_eq!(slow.outputs().snaps, 0);
    }
}

/// By the eigenvalues of the whole matrix of differences, which is not symmetric.
#[test]
fn forces_without_a_potential_leave_no_unstable_shape() {
    let (mut verified, mut least) = (0, f64::INFINITY);
    for number in 0..60 {
        let mut random = StdRng::seed_from_u64(1000 + number);
        let segments = random.random_range(2..=4);
        let preceding = random.random_bool(0.5);
        let interaction = if preceding { Interaction::Preceding } else { Interaction::None };
        let mut model = model(segments, interaction);
        let mut inputs = Inputs::unloaded(segments + 1);
        inputs.uniform_field = direction(&mut random) * random.random_range(0.0..0.06 / segments as f64);
        if !preceding {
            inputs.tip_moment = direction(&mut random) * random.random_range(0.0..2e-5);
        }
        let report = model.solve(&inputs).expect("finite inputs");
        if report.outcome != Outcome::Solved {
            continue;
        }
        verified += 1;
        let shape = model.unknowns().to_vec();
        let mut verifier = Verifier::new(&mut model, &inputs, false);
        let smallest = verifier.smallest_real_part(&shape).expect("eigenvalues");
        least = least.min(smallest);
        assert!(smallest > 0.0, "number {number}: {smallest}, {report:?}");
        assert!(verifier.residual(&shape).expect("apart") <= RESIDUAL, "number {number}");
    }
    println!("{verified} of 60 verified, smallest real part {least}");
    assert!(verified > 30, "{verified}");
}

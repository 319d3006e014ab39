//! Derivatives: where there are none, what they do not disturb, and the symmetries of a potential.

use mcm::design::{Design, Specification};
use mcm::equilibrium::{Equilibrium, Input, Inputs, Interaction, Jacobian, Output, PlacedSource, Settings};
use mcm::geometry::Pose;
use nalgebra::{DMatrix, Vector3};

use super::critical::{is_stable, last_true};
use crate::given::{pair, unloaded_beside_pair};
use crate::tolerance::{NEUTRAL, SYMMETRY, assert_close};

fn equilibrium(segments: usize, interaction: Interaction) -> Equilibrium {
    let design = Design::new(Specification::paper(segments)).expect("allowed");
    let settings = Settings { interaction, ..Settings::default() };
    Equilibrium::new(&design, Some(&pair()), settings, 3).expect("allowed")
}

/// A bent shape in every field, under its weight.
fn loaded(segments: usize) -> Inputs {
    let mut inputs = Inputs::unloaded(segments + 1);
    inputs.base = Pose::new([0.003, -0.002, 0.005], [0.8, 0.36, -0.48, 0.0]).expect("a pose");
    let pose = Pose::new([0.01, -0.09, 0.02], [0.36, 0.8, 0.0, 0.48]).expect("a pose");
    inputs.sources = vec![PlacedSource { pose, strength: 1.0 }];
    inputs.uniform_field = Vector3::new(0.002, 0.004, -0.001);
    inputs.field_gradient = [0.1, -0.05, 0.07, 0.03, -0.04];
    inputs.tip_force = Vector3::new(0.002, -0.001, 0.003);
    inputs.gravity = Vector3::new(1.0, -2.0, 9.0);
    inputs
}

fn block(jacobian: &Jacobian, output: Output, input: Input) -> DMatrix<f64> {
    jacobian.block(output, input).expect("of this design").into_owned()
}

#[test]
fn what_a_force_does_there_another_does_here() {
    // Maxwell and Betti: with a potential, displacements by forces are symmetric, and every wrench on the magnet or
    // the clamp moves with a load as the loaded point does with the magnet or the base.
    for interaction in [Interaction::None, Interaction::Rings, Interaction::Full] {
        let mut equilibrium = equilibrium(3, interaction);
        assert!(equilibrium.solve(&loaded(3)).expect("finite inputs").solved());
        let jacobian = equilibrium.jacobian().expect("no fold");
        let pairs = [
            (Output::TipPosition, Input::TipForce, Output::TipPosition, Input::TipForce, 1.0),
            (Output::TipRotation, Input::TipForce, Output::TipPosition, Input::TipMoment, 1.0),
            (Output::RingPosition(1), Input::RingForce(2), Output::RingPosition(2), Input::RingForce(1), 1.0),
            (
                Output::SourceReactionForce(0),
                Input::TipForce,
                Output::TipPosition,
                Input::SourcePosition(0),
                1.0,
            ),
            (
                Output::SourceReactionTorque(0),
                Input::TipForce,
                Output::TipPosition,
                Input::SourceRotation(0),
                1.0,
            ),
            (
                Output::BaseReactionForce,
                Input::RingForce(1),
                Output::RingPosition(1),
                Input::BasePosition,
                -1.0,
            ),
            (
                Output::BaseReactionMoment,
                Input::RingForce(1),
                Output::RingPosition(1),
                Input::BaseRotation,
                -1.0,
            ),
            (
                Output::SourceReactionForce(0),
                Input::BasePosition,
                Output::BaseReactionForce,
                Input::SourcePosition(0),
                -1.0,
            ),
        ];
        for (output, input, mirrored, by, sign) in pairs {
            let (one, two) =
                (block(&jacobian, output, input), block(&jacobian, mirrored, by).transpose() * sign);
            assert!(one.norm() > 0.0, "{output:?} by {input:?} is no test");
            let case = format!("{interaction:?}: {output:?} by {input:?}");
            assert_close(case, one.as_slice(), two.as_slice(), SYMMETRY);
        }
    }
}

#[test]
fn without_reactions_nothing_is_symmetric() {
    let mut equilibrium = equilibrium(3, Interaction::Preceding);
    assert!(equilibrium.solve(&loaded(3)).expect("finite inputs").solved());
    let compliance = block(&equilibrium.jacobian().expect("no fold"), Output::TipPosition, Input::TipForce);
    let skew = (&compliance - compliance.transpose()).norm() / compliance.norm();
    assert!(skew > 1e-3, "{skew}");
}

#[test]
fn there_are_none_before_a_solve_and_at_a_fold() {
    // Straight in an antiparallel field, up to where it turns over: there the compliance grows without bound.
    let mut start = equilibrium(3, Interaction::None);
    assert!(start.jacobian().expect_err("not solved").to_string().contains("nothing is solved"));
    let inputs =
        |size: f64| Inputs { uniform_field: Vector3::new(0.0, 0.0, -size), ..unloaded_beside_pair(4) };
    let straight = vec![0.0; start.freedoms()];
    let critical = last_true(1e-3, 0.1, |size| is_stable(&mut start, &inputs(size), &straight));
    let at = |part: f64| {
        let mut equilibrium = equilibrium(3, Interaction::None);
        assert!(equilibrium.solve(&inputs(part * critical)).expect("finite inputs").solved());
        equilibrium.jacobian()
    };
    let compliance = |part: f64| {
        let jacobian = at(part).expect("below the fold");
        block(&jacobian, Output::TipRotation, Input::TipMoment)[(0, 0)]
    };
    let growth = compliance(1.0 - 1e-4) / compliance(1.0 - 1e-3);
    assert!((growth / 10.0 - 1.0).abs() < 0.01, "ten times closer, ten times softer, not {growth}");
    let message = at(1.0 - 1e-6).expect_err("at the fold").to_string();
    assert!(message.contains("no derivatives: the shape is at a fold"), "{message}");
}

#[test]
fn asking_for_derivatives_changes_nothing() {
    let mut asked = equilibrium(2, Interaction::Rings);
    asked.solve(&loaded(2)).expect("finite inputs");
    let mut left = asked.clone();
    asked.jacobian().expect("no fold");
    let mut next = loaded(2);
    next.uniform_field.y += 1e-5;
    assert_eq!(asked.solve(&next).expect("finite inputs"), left.solve(&next).expect("finite inputs"));
    assert_eq!(asked.unknowns(), left.unknowns());
}

#[test]
fn the_whole_scene_may_move_as_one() {
    // Base, magnet and nothing else in the world: together they carry the shape along.
    let mut equilibrium = equilibrium(2, Interaction::Rings);
    let mut inputs = Inputs::unloaded(3);
    let pose = loaded(2).sources[0].pose;
    inputs.sources = vec![PlacedSource { pose, strength: 1.0 }];
    assert!(equilibrium.solve(&inputs).expect("finite inputs").solved());
    let jacobian = equilibrium.jacobian().expect("no fold");
    let both = block(&jacobian, Output::TipPosition, Input::BasePosition)
        + block(&jacobian, Output::TipPosition, Input::SourcePosition(0));
    assert_close("displacement", both.as_slice(), DMatrix::identity(3, 3).as_slice(), NEUTRAL);
}

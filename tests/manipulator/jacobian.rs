//! Exact derivatives of all outputs by all inputs against differences of whole solves.

use core::cell::Cell;

use mcm::design::{Backbone, Cylinder, CylinderMaterial, Design, Specification};
use mcm::equilibrium::{Interaction, Settings};
use mcm::geometry::{Pose, RotationVector, rotation_log};
use mcm::magnetics::{Coil, Solenoid, Sources};
use mcm::manipulator::{Input, Inputs, Jacobian, Manipulator, Output, Outputs, PlacedSource, Status};
use nalgebra::{DVector, Vector3};
use proptest::prelude::*;
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};

use super::changes::{changed, inputs_and_sizes};
use crate::differences::{Compared, worst};
use crate::given::{pair, unloaded_beside_pair};
use crate::tolerance::{DIFFERENCE, JACOBIAN, JACOBIAN_CURVATURE, PAIRS, assert_close};

/// Centreline points.
const POINTS: usize = 5;

/// Step of the differences in parts of each input's usual size; their error is of fourth order in it.
const STEP: f64 = 1e-3;

/// Processor time that a solve may take, s: no difference may end with the budget.
const PATIENCE: f64 = 60.0;

/// Random scenes.
const CASES: u32 = 30;

/// Everything acts, on a base that stands askew.
fn everything(rings: usize) -> Inputs {
    let mut inputs = Inputs::unloaded(rings);
    inputs.base = Pose::new([0.003, -0.002, 0.005], [0.8, 0.36, -0.48, 0.0]).unwrap();
    let pose = Pose::new([0.01, -0.09, 0.02], [0.36, 0.8, 0.0, 0.48]).unwrap();
    inputs.sources = vec![PlacedSource { pose, strength: 0.8 }];
    inputs.uniform_field = Vector3::new(0.002, 0.004, -0.001);
    inputs.field_gradient = [0.1, -0.05, 0.07, 0.03, -0.04];
    inputs.tip_force = Vector3::new(0.002, -0.001, 0.003);
    inputs.tip_moment = Vector3::new(2e-6, -3e-6, 1e-6);
    inputs.gravity = Vector3::new(1.0, -2.0, 9.0);
    for (ring, force) in inputs.ring_forces.iter_mut().enumerate() {
        *force = Vector3::new(1e-3, 0.5e-3 * ring as f64, -1e-3);
    }
    inputs
}

/// All outputs of two solves as differences.
pub(super) fn differences(plus: &Outputs, minus: &Outputs) -> Vec<(Output, Vec<f64>)> {
    let vector = |a: &Vector3<f64>, b: &Vector3<f64>| (a - b).as_slice().to_vec();
    let turn = |a: &Pose, b: &Pose| rotation_log(&(a.rotation * b.rotation.transpose())).as_slice().to_vec();
    let mut out = vec![
        (Output::TipAngle, vec![plus.tip_angle - minus.tip_angle]),
        (Output::TipPosition, vector(&plus.tip.position, &minus.tip.position)),
        (Output::TipRotation, turn(&plus.tip, &minus.tip)),
        (Output::MagneticForce, vector(&plus.magnetic_force, &minus.magnetic_force)),
        (Output::MagneticTorque, vector(&plus.magnetic_torque, &minus.magnetic_torque)),
        (Output::BaseReactionForce, vector(&plus.base_reaction_force, &minus.base_reaction_force)),
        (Output::BaseReactionMoment, vector(&plus.base_reaction_moment, &minus.base_reaction_moment)),
        (Output::TipField, vector(&plus.tip_field, &minus.tip_field)),
    ];
    let number = |(a, b): (f64, f64)| vec![a - b];
    let length = plus.feed_length.zip(minus.feed_length).map(number);
    let push = plus.feed_reaction.zip(minus.feed_reaction).map(number);
    out.extend(length.map(|length| (Output::FeedLength, length)));
    out.extend(push.map(|push| (Output::FeedReaction, push)));
    for (index, (a, b)) in plus.shape.iter().zip(&minus.shape).enumerate() {
        out.push((Output::ShapePoint(index), vector(a, b)));
    }
    for (index, (a, b)) in plus.rings.iter().zip(&minus.rings).enumerate() {
        out.push((Output::RingPosition(index), vector(&a.position, &b.position)));
        out.push((Output::RingRotation(index), turn(a, b)));
        out.push((Output::RingAxis(index), vector(&a.axis(), &b.axis())));
    }
    for (index, (a, b)) in plus.core_angles.iter().zip(&minus.core_angles).enumerate() {
        out.push((Output::CoreAngle(index), vec![a - b]));
    }
    for (index, (a, b)) in plus.reactions.iter().zip(&minus.reactions).enumerate() {
        out.push((Output::SourceReactionForce(index), vector(&a.force, &b.force)));
        out.push((Output::SourceReactionTorque(index), vector(&a.torque, &b.torque)));
    }
    for (index, (a, b)) in plus.shape_tangents.iter().zip(&minus.shape_tangents).enumerate() {
        out.push((Output::ShapeTangent(index), vector(a, b)));
    }
    for (index, (a, b)) in plus.shape_curvatures.iter().zip(&minus.shape_curvatures).enumerate() {
        out.push((Output::ShapeCurvature(index), vector(a, b)));
    }
    out
}

fn solved(mut manipulator: Manipulator, inputs: &Inputs) -> Outputs {
    let outputs = manipulator.solve(inputs).expect("finite inputs");
    assert!(matches!(outputs.status, Status::Solved | Status::NearFold), "{:?}", outputs.status);
    manipulator.measure_strains().clone()
}

/// Central differences of fourth order of all outputs over this step.
pub(super) fn rates(step: f64, at: impl Fn(f64) -> Outputs) -> Vec<(Output, Vec<f64>)> {
    let spread = |h: f64| differences(&at(h), &at(-h));
    let (near, far) = (spread(step), spread(2.0 * step));
    near.into_iter()
        .zip(far)
        .map(|((output, near), (_, far))| {
            (output, near.iter().zip(far).map(|(n, f)| (8.0 * n - f) / (12.0 * step)).collect())
        })
        .collect()
}

/// Central differences of fourth order by one number of the inputs.
fn by_differences(
    manipulator: &Manipulator,
    inputs: &Inputs,
    input: Input,
    axis: usize,
    step: f64,
) -> Vec<(Output, Vec<f64>)> {
    rates(step, |by| solved(manipulator.clone(), &changed(inputs, input, axis, by)))
}

/// Every output by every input, in effects of an input of usual size.
fn compared(manipulator: &Manipulator, jacobian: &Jacobian, inputs: &Inputs) -> Vec<Compared<Output>> {
    let mut out: Vec<Compared<Output>> = Vec::new();
    let mut all = inputs_and_sizes(inputs.ring_forces.len(), inputs.sources.len());
    if manipulator.outputs().feed_length.is_some() {
        all.push(if inputs.feed_force.is_some() {
            (Input::FeedForce, 0.005)
        } else {
            (Input::Insertion, 0.02)
        });
    }
    // Displacement and rotation of a vessel are columns, but no inputs; length and push of a shaft are never both; there is no guidewire.
    let others = 7 + if manipulator.outputs().feed_length.is_some() { 1 } else { 2 };
    for (input, size) in all {
        for axis in 0..jacobian.columns(input).expect("of this design").len() {
            for (output, expected) in by_differences(manipulator, inputs, input, axis, STEP * size) {
                let got = jacobian.block(output, input).expect("of this design").column(axis).into_owned();
                assert_eq!(got.len(), expected.len(), "{output:?}");
                let expected = DVector::from_vec(expected);
                assert!(got.iter().all(|entry| entry.is_finite()), "{output:?} by {input:?}");
                let name = format!("{output:?} by {input:?} {axis}");
                let [error, effect] = [&got - &expected, expected].map(|rate| rate.norm() * size);
                out.push(Compared { kind: output, name, error, effect });
            }
        }
    }
    assert_eq!(out.len(), (jacobian.matrix().ncols() - others) * differences_of(manipulator));
    out
}

/// Largest error of the derivatives of an output, relative to the largest effect of any input.
fn allowed(output: Output) -> f64 {
    if matches!(output, Output::ShapeCurvature(_)) { JACOBIAN_CURVATURE } else { JACOBIAN }
}

fn differences_of(manipulator: &Manipulator) -> usize {
    let outputs = manipulator.clone().measure_strains().clone();
    differences(&outputs, &outputs).len()
}

fn designs() -> Vec<(String, Design)> {
    let mut out: Vec<(String, Design)> = [1, 3]
        .map(|segments| (format!("S = {segments}"), Design::new(Specification::paper(segments)).unwrap()))
        .into();
    let Specification::Segmented(mut bare) = Specification::paper(2) else { unreachable!() };
    (bare.base_magnet, bare.tip_magnet) = (false, false);
    out.push(("S = 2 without its ends' rings".into(), Design::new(Specification::Segmented(bare)).unwrap()));
    out
}

fn rod() -> Design {
    let material = CylinderMaterial::Bulk { elastic_modulus: 1.5e6, poisson: 0.45, remanence: 0.1 };
    let rod = Cylinder { length: 0.03, radius: 0.001, inner_radius: 0.0, material, density: Some(3000.0) };
    Design::new(Specification::Cylinder(rod)).unwrap()
}

fn settings(interaction: Interaction) -> Settings {
    Settings {
        interaction,
        pair_accuracy: PAIRS,
        tolerance: 1e-13,
        time_budget: PATIENCE,
        ..Settings::default()
    }
}

fn ready(design: &Design, interaction: Interaction, inputs: &Inputs) -> Manipulator {
    let mut out = Manipulator::new(design, Some(&pair()), settings(interaction), POINTS).unwrap();
    out.solve(inputs).expect("finite inputs");
    out
}

fn check(name: &str, manipulator: &Manipulator, inputs: &Inputs) {
    let jacobian = manipulator.jacobian().unwrap();
    let (error, place) = worst(&compared(manipulator, &jacobian, inputs), allowed);
    println!("{name}: {error:.1e} of what is allowed ({place})");
    assert!(error <= 1.0, "{name}: {place} is off by {error:e} times what is allowed");
}

#[test]
fn every_output_by_every_input_at_every_level() {
    for (name, design) in designs() {
        let inputs = everything(design.rings().count());
        for &(interaction, level, _) in Interaction::ALL {
            check(&format!("{name}, {level}"), &ready(&design, interaction, &inputs), &inputs);
        }
    }
}

#[test]
fn every_output_by_every_input_of_a_plain_rod() {
    let (design, inputs) = (rod(), everything(0));
    check("rod", &ready(&design, Interaction::None, &inputs), &inputs);
}

/// Everything acts on a device at the end of 20 mm of shaft, gently.
fn gently() -> Inputs {
    let mut inputs = Inputs { insertion: 0.02, ..everything(3) };
    inputs.sources[0].strength = 0.1;
    inputs.tip_force *= 0.3;
    inputs.gravity *= 0.3;
    inputs.ring_forces.iter_mut().for_each(|force| *force *= 0.3);
    inputs
}

/// On a silicone tube.
fn on_a_shaft(interaction: Interaction, inputs: &Inputs) -> Manipulator {
    let design = Design::new(Specification::paper(2)).unwrap().with_shaft(&Backbone::silicone()).unwrap();
    ready(&design, interaction, inputs)
}

#[test]
fn every_output_by_every_input_of_a_device_on_a_shaft() {
    let inputs = gently();
    for &(interaction, level, _) in Interaction::ALL {
        // Forces without their reactions bend so long and soft a tube without end.
        if interaction != Interaction::Preceding {
            check(&format!("on a shaft, {level}"), &on_a_shaft(interaction, &inputs), &inputs);
        }
    }
}

#[test]
fn every_output_by_every_input_of_a_device_that_is_pushed() {
    let inputs = gently();
    let push = on_a_shaft(Interaction::Rings, &inputs).outputs().feed_reaction;
    let pushed = Inputs { feed_force: push, insertion: 0.021, ..inputs.clone() };
    let manipulator = on_a_shaft(Interaction::Rings, &pushed);
    let length = manipulator.outputs().feed_length.expect("a shaft");
    assert!((length - inputs.insertion).abs() < 1e-8, "{length}");
    check("pushed", &manipulator, &pushed);
}

#[test]
fn a_magnet_that_is_switched_off_or_absent() {
    let design = Design::new(Specification::paper(1)).unwrap();
    let mut inputs = everything(2);
    inputs.sources[0].strength = 0.0;
    let off = ready(&design, Interaction::Rings, &inputs);
    check("switched off", &off, &inputs);
    let mut absent = Manipulator::new(&design, None, settings(Interaction::Rings), POINTS).unwrap();
    let without = Inputs { sources: Vec::new(), ..inputs.clone() };
    absent.solve(&without).unwrap();
    check("absent", &absent, &without);
    inputs.sources[0].pose = inputs.base; // where any strength would be refused
    let (inside, absent) =
        (ready(&design, Interaction::Rings, &inputs).jacobian().unwrap(), absent.jacobian().unwrap());
    for output in [Output::TipPosition, Output::MagneticForce, Output::TipField, Output::RingRotation(1)] {
        for (input, _) in inputs_and_sizes(2, 0) {
            assert_eq!(inside.block(output, input), absent.block(output, input), "{output:?} {input:?}");
        }
        assert_eq!(inside.block(output, Input::SourceStrength(0)).unwrap().norm().to_bits(), 0);
        assert_eq!(absent.block(output, Input::SourceStrength(0)), None);
    }
}

#[test]
fn every_output_by_a_second_magnet_and_a_coil() {
    let coil = Coil { inner_radius: 0.02, outer_radius: 0.04, length: 0.06, turns: 600.0 };
    let sources = Sources::new(vec![pair(), pair(), Solenoid::new(coil).unwrap().into()]).unwrap();
    let placed = |position, strength| PlacedSource {
        pose: Pose::new(position, [0.36, 0.8, 0.0, 0.48]).unwrap(),
        strength,
    };
    let mut inputs = everything(2);
    inputs.sources.extend([placed([-0.09, 0.07, 0.03], 0.5), placed([0.1, 0.02, -0.05], 6.0)]);
    let design = Design::new(Specification::paper(1)).unwrap();
    let mut manipulator = Manipulator::new(&design, sources, settings(Interaction::Rings), POINTS).unwrap();
    manipulator.solve(&inputs).expect("finite inputs");
    check("three sources", &manipulator, &inputs);
}

#[test]
fn windings_that_touch() {
    let design = Design::new(Specification::paper(2)).unwrap();
    let mut inputs = Inputs { uniform_field: Vector3::new(0.01, 0.04, -0.01), ..everything(3) };
    inputs.base.rotation = RotationVector::new(Vector3::new(0.1, 0.2, 0.3)).matrix();
    let settings = Settings { bending_stop: Some(true), ..settings(Interaction::Rings) };
    let mut manipulator = Manipulator::new(&design, Some(&pair()), settings, POINTS).unwrap();
    let largest = manipulator.solve(&inputs).unwrap().core_angles.iter().copied().fold(0.0, f64::max);
    assert!(largest.to_degrees() > 40.0, "open at {} deg", largest.to_degrees());
    check("touching", &manipulator, &inputs);
}

#[test]
fn there_are_none_of_what_is_not_solved() {
    let design = Design::new(Specification::paper(1)).unwrap();
    let mut manipulator = ready(&design, Interaction::Full, &unloaded_beside_pair(2));
    assert!(manipulator.jacobian().is_ok());
    // The attraction pulls one segment shut at 35.83 mT.
    let shut = Inputs { uniform_field: Vector3::new(0.0, 0.06, 0.0), ..unloaded_beside_pair(2) };
    assert_eq!(manipulator.solve(&shut).unwrap().status, Status::NotSolved);
    let message = manipulator.jacobian().unwrap_err().to_string();
    assert_eq!(message, "no derivatives: the last inputs are not solved");
    let jacobian = ready(&design, Interaction::None, &unloaded_beside_pair(2)).jacobian().unwrap();
    assert!(jacobian.block(Output::RingAxis(2), Input::TipForce).is_none());
    assert!(jacobian.block(Output::TipAngle, Input::RingForce(2)).is_none());
    assert!(jacobian.along(&[0.0]).is_err());
}

/// Directions, fields and loads of any size up to the usual ones, at every level.
fn scenes() -> impl Strategy<Value = (usize, [f64; 16], usize)> {
    (1_usize..=2, proptest::array::uniform16(-1.0..1.0), 0..Interaction::ALL.len())
}

#[test]
fn a_direction_of_all_inputs_at_once_in_random_scenes() {
    let (checked, worst) = (Cell::new(0), Cell::new(0.0_f64));
    let config = Config { cases: CASES, failure_persistence: None, ..Config::default() };
    let mut runner = TestRunner::new_with_rng(config, TestRng::from_seed(RngAlgorithm::ChaCha, &[7; 32]));
    runner
        .run(&scenes(), |(segments, x, level)| {
            let design = Design::new(Specification::paper(segments)).unwrap();
            let mut inputs = everything(segments + 1);
            inputs.sources[0].pose.position += Vector3::new(x[0], 0.3 * x[1], x[2]) * 0.03;
            inputs.sources[0].pose.rotation = RotationVector::new(Vector3::new(x[3], x[4], x[5])).matrix();
            inputs.base.rotation = RotationVector::new(Vector3::new(x[6], x[7], x[8]) * 2.0).matrix();
            inputs.uniform_field = Vector3::new(x[9], x[10], x[11]) * 0.01;
            inputs.tip_force *= x[12];
            inputs.tip_moment *= x[13];
            inputs.gravity *= x[14];
            let manipulator = ready(&design, Interaction::ALL[level].0, &inputs);
            if manipulator.outputs().status != Status::Solved {
                return Ok(()); // close to a fold, differences are no measure
            }
            let jacobian = manipulator.jacobian().unwrap();
            let mut direction = vec![0.0; jacobian.matrix().ncols()];
            let mut by_output: Vec<(Output, DVector<f64>, f64)> = Vec::new();
            // One number of every input, in turn.
            for (number, (input, size)) in inputs_and_sizes(segments + 1, 0).into_iter().enumerate() {
                let columns = jacobian.columns(input).unwrap();
                let axis = number % columns.len();
                direction[columns.start + axis] = size;
                let rates = by_differences(&manipulator, &inputs, input, axis, STEP * size);
                for (index, (output, rate)) in rates.into_iter().enumerate() {
                    let part = DVector::from_vec(rate) * size;
                    match by_output.get_mut(index) {
                        Some((_, sum, scale)) => (*sum, *scale) = (&*sum + &part, *scale + part.norm()),
                        None => by_output.push((output, part.clone(), part.norm())),
                    }
                }
            }
            let got = jacobian.along(&direction).unwrap();
            for (output, expected, scale) in by_output {
                let rows = jacobian.rows(output).unwrap();
                let off = (got.rows(rows.start, rows.len()) - expected).norm();
                prop_assert!(off <= JACOBIAN * scale, "{output:?}: off by {off:e} of {scale:e}");
                // Nothing changes the curvature in a ring.
                let error = if scale > 0.0 { off / scale } else { 0.0 };
                worst.set(error.max(worst.get()));
            }
            checked.set(checked.get() + 1);
            Ok(())
        })
        .unwrap();
    println!("{} scenes, worst {:.1e}", checked.get(), worst.get());
    assert!(2 * checked.get() > CASES, "only {} of {CASES} scenes", checked.get());
}

#[test]
fn quaternions_turn_as_their_components_change() {
    let pose = Pose::new([0.0; 3], [0.5, -0.5, 0.1, 0.7]).unwrap();
    let (q, rate) = (pose.quaternion(), [0.3, -0.2, 0.5, 0.1]);
    let at = |h: f64| {
        let moved: [f64; 4] = core::array::from_fn(|i| q[i] + h * rate[i]);
        Pose::new([0.0; 3], moved).unwrap()
    };
    let (plus, minus) = (at(1e-4), at(-1e-4));
    let spin = rotation_log(&(plus.rotation * minus.rotation.transpose())) / 2e-4;
    assert_close("spin", Pose::rotation_rate(q, rate).as_slice(), spin.as_slice(), DIFFERENCE);
    let back: [f64; 4] = core::array::from_fn(|i| (plus.quaternion()[i] - minus.quaternion()[i]) / 2e-4);
    assert_close("back", &pose.quaternion_rate(&spin), &back, DIFFERENCE);
    assert_eq!(Pose::rotation_rate(q, q), Vector3::zeros(), "its length turns nothing");
}

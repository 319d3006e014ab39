//! The other methods beside the potential one: the same equilibria, to the accuracy that each states, or none.

use mcm::design::Design;
use mcm::equilibrium::{self, Inputs, Interaction};
use mcm::manipulator::{Followed, Outputs, Scene, Status};
use mcm::methods::{Compared, Device, Method, Settings};
use nalgebra::{Rotation3, Vector3};

use crate::tolerance::{
    METHOD_ARCS, METHOD_ARCS_STOPPED, METHOD_BALANCE, METHOD_COARSE, METHOD_FINE, METHOD_ORDER,
    METHOD_RESIDUAL, PAIRS, assert_close,
};

/// Fields and loads in which shapes are compared, all in the plane of y and z.
const SCENES: [(&str, &str); 3] = [
    ("uniform", "[field]\nuniform_mt = [0, 20, 0]"),
    ("pair", "[magnet]"),
    (
        "loads",
        "[field]\nuniform_mt = [0, 5, 0]\ngradient_t_per_m = [0.1, 0, 0, 0.2, 0.1]\n[gravity]\nacceleration_m_s2 = [0, -9.81, 0]\n\
         [load]\ntip_force_n = [0, 0.005, -0.01]",
    ),
];

/// Every method but the potential one.
fn others() -> impl Iterator<Item = (Method, &'static str)> {
    Method::ALL.iter().map(|row| (row.0, row.1)).filter(|row| row.0 != Method::Potential)
}

fn scene(table: &str, segments: usize, interaction: Interaction) -> Scene {
    // The planar reduction spreads the spiral around the core.
    let design = format!("[design]\nsegments = {segments}\nspiral = \"axisymmetric\"");
    let text = format!("{table}\n{design}\n[model]\ninteraction = \"{}\"", interaction.name());
    let mut scene = Scene::parse(&text, "a scene").expect("a valid scene");
    scene.settings.pair_accuracy = PAIRS;
    scene
}

fn device(scene: &Scene, solver: Settings) -> Device {
    Device::new(scene, solver, 21).expect("supported")
}

fn by(method: Method) -> Settings {
    Settings { method, ..Settings::default() }
}

fn solved(scene: &Scene, solver: Settings) -> Outputs {
    let mut manipulator = device(scene, solver);
    let outputs = manipulator.solve(&scene.inputs).expect("valid inputs");
    assert!(outputs.status != Status::NotSolved, "{solver:?}: {outputs:?}");
    outputs.clone()
}

/// By the potential method.
fn reference(scene: &Scene, settings: equilibrium::Settings) -> Outputs {
    solved(&Scene { settings, ..scene.clone() }, Settings::default())
}

/// Errors beside a reference: positions over the length, and wrenches.
struct Errors {
    positions: f64,
    wrenches: f64,
    energy: f64,
}

fn errors(length: f64, a: &Outputs, b: &Outputs) -> Errors {
    let of = |a: &[Vector3<f64>], b: &[Vector3<f64>]| {
        a.iter().zip(b).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max)
    };
    let places = |out: &Outputs| out.rings.iter().map(|ring| ring.position).collect::<Vec<_>>();
    let (shape, rings) = (of(&a.shape, &b.shape), of(&places(a), &places(b)));
    let angles = a.core_angles.iter().zip(&b.core_angles).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    let turn = (a.tip.rotation - b.tip.rotation).norm();
    let tip = (a.tip.position - b.tip.position).norm();
    let wrenches = |out: &Outputs| {
        let own =
            [(out.magnetic_force, out.magnetic_torque), (out.base_reaction_force, out.base_reaction_moment)];
        let reactions = out.reactions.iter().map(|reaction| (reaction.force, reaction.torque));
        own.into_iter()
            .chain(reactions)
            .flat_map(|(force, torque)| [force, torque / length])
            .collect::<Vec<_>>()
    };
    let size = wrenches(b).iter().map(Vector3::norm).fold(0.0, f64::max);
    let wrong = of(&wrenches(a), &wrenches(b));
    Errors {
        positions: [shape / length, rings / length, tip / length, angles, turn]
            .into_iter()
            .fold(0.0, f64::max),
        wrenches: wrong / size,
        energy: (a.energy - b.energy).abs() / b.energy.abs(),
    }
}

#[test]
fn every_method_agrees_with_the_potential_one() {
    println!("largest error of positions over the length and angles, of wrenches, of the energy");
    for (name, table) in SCENES {
        for segments in [1, 3] {
            for interaction in [Interaction::None, Interaction::Rings] {
                let scene = scene(table, segments, interaction);
                let length = scene.design().expect("a design").length();
                let reference = reference(&scene, equilibrium::Settings { degree: 8, ..scene.settings });
                for (method, label) in others() {
                    let got = solved(&scene, by(method));
                    let error = errors(length, &got, &reference);
                    let Errors { positions, wrenches, energy } = error;
                    let case = format!("{label}, {name}, S = {segments}, {}", interaction.name());
                    println!("{case}: {positions:.1e} {wrenches:.1e} {energy:.1e}");
                    if method == Method::ConstantCurvature {
                        assert!(positions.max(wrenches) <= METHOD_ARCS, "{case}: above {METHOD_ARCS:e}");
                    } else {
                        let worst = positions.max(wrenches).max(energy);
                        assert!(worst <= METHOD_COARSE, "{case}: above {METHOD_COARSE:e}");
                    }
                }
            }
        }
    }
}

#[test]
fn every_method_has_the_same_bending_stop() {
    // Closed, in transition and open: field (mT, towards y and z) in which three segments bend.
    for (interaction, field) in [
        (Interaction::None, [20.0, -10.0]),
        (Interaction::Rings, [15.0, 2.0]),
        (Interaction::Rings, [9.0, -3.0]),
    ] {
        let [y, z] = field;
        let mut scene = scene(&format!("[field]\nuniform_mt = [0, {y}, {z}]"), 3, interaction);
        scene.settings.bending_stop = Some(true);
        let design = scene.design().expect("a design");
        let length = design.length();
        let reference = reference(&scene, equilibrium::Settings { degree: 8, ..scene.settings });
        let free = equilibrium::Settings { bending_stop: Some(false), ..scene.settings };
        let open = device(&Scene { settings: free, ..scene.clone() }, Settings::default())
            .solve(&scene.inputs)
            .map(|out| (out.status == Status::Solved, out.tip_angle));
        println!(
            "{interaction:?} {field:?}: cores {:.1?} deg, tip {:.1} deg, without stop {:.1?}",
            reference.core_angles.iter().map(|angle| angle.to_degrees()).collect::<Vec<_>>(),
            reference.tip_angle.to_degrees(),
            open.map(|(solved, angle)| (solved, angle.to_degrees())),
        );
        for (method, label) in others() {
            let got = solved(&scene, by(method));
            let Errors { positions, wrenches, energy } = errors(length, &got, &reference);
            println!("{label}: {positions:.1e} {wrenches:.1e} {energy:.1e}");
            let case = format!("{label}, {}, {field:?} mT", interaction.name());
            if method == Method::ConstantCurvature {
                assert!(
                    positions.max(wrenches) <= METHOD_ARCS_STOPPED,
                    "{case}: above {METHOD_ARCS_STOPPED:e}"
                );
            } else {
                let worst = positions.max(wrenches).max(energy);
                assert!(worst <= METHOD_COARSE, "{case}: above {METHOD_COARSE:e}");
            }
        }
    }
}

#[test]
fn each_converges_with_its_order() {
    for interaction in [Interaction::None, Interaction::Rings] {
        let scene = scene(SCENES[1].1, 3, interaction);
        let length = scene.design().expect("a design").length();
        let reference = reference(&scene, equilibrium::Settings { degree: 8, ..scene.settings });
        let exact = reference.tip.position / length;
        for (method, label) in others().filter(|row| row.0 != Method::ConstantCurvature) {
            let at = |fineness: usize| {
                let solver = Settings {
                    method,
                    steps: 4 * fineness,
                    stages: 1,
                    intervals: 4 * fineness,
                    mesh_tolerance: 1e9, // as it is
                    tolerance: METHOD_RESIDUAL,
                    ..Settings::default()
                };
                let got = solved(&scene, solver);
                got.tip.position / length
            };
            let [coarse, fine, finest] = [2, 4, 16].map(at);
            let reached = ((coarse - finest).norm() / (fine - finest).norm()).log2();
            let order = if method == Method::Collocation { 2.0 } else { 4.0 };
            let error = (finest - exact).norm();
            let case = format!("{label}, {}: order {reached:.2}, error {error:.1e}", interaction.name());
            println!("{case}");
            assert!((reached - order).abs() <= METHOD_ORDER, "{case}, not {order}");
            assert!(method == Method::Collocation || error <= METHOD_FINE, "{case}");
        }
        // A tolerance instead of a mesh, and three Gauss points.
        let solver = Settings { mesh_tolerance: 1e-6, tolerance: METHOD_RESIDUAL, ..by(Method::Collocation) };
        let got = solved(&scene, solver);
        let error = (got.tip.position / length - exact).norm();
        assert!(error <= METHOD_FINE, "collocation to a residual of 1e-6: {error:e}");
    }
}

/// Force and torque about the base of all that acts from outside.
fn outside(out: &Outputs, inputs: &Inputs) -> [Vector3<f64>; 2] {
    let force = out.magnetic_force + out.base_reaction_force;
    let torque = out.magnetic_torque + out.base_reaction_moment;
    let arm = out.tip.position - inputs.base.position;
    [force + inputs.tip_force, torque + arm.cross(&inputs.tip_force) + inputs.tip_moment]
}

#[test]
fn a_method_solves_or_says_that_it_has_not() {
    let (mut refused, mut held, mut worst) = (0, 0, 0.0_f64);
    for (field, angle) in [(20.0, 90.0), (60.0, 150.0), (200.0, 90.0), (200.0, 170.0), (500.0, 175.0)] {
        for segments in [1, 3, 9] {
            for interaction in [Interaction::None, Interaction::Rings] {
                let scene = scene("", segments, interaction);
                let turn = Rotation3::from_axis_angle(&-Vector3::x_axis(), f64::to_radians(angle));
                let uniform_field = turn * Vector3::z() * (1e-3 * field);
                let inputs = Inputs { uniform_field, ..scene.inputs.clone() };
                for (method, label) in others() {
                    let solver = Settings { iterations: 30, smallest_part: 1.0, ..by(method) };
                    let mut manipulator = device(&scene, solver);
                    let straight = manipulator.outputs().tip;
                    let outputs = manipulator.solve(&inputs).expect("valid inputs");
                    let case =
                        format!("{label}, {field} mT at {angle} deg, S = {segments}, {}", interaction.name());
                    if outputs.status == Status::NotSolved {
                        refused += 1;
                        assert_eq!(outputs.tip, straight, "{case}: the last solution is kept");
                    } else {
                        held += 1;
                        assert!(outputs.stable.is_none(), "{case}: no verdict");
                        let [force, torque] = outside(outputs, &inputs);
                        let size = outputs.base_reaction_moment.norm().max(1e-6);
                        let length = scene.design().expect("a design").length();
                        let lack = (force.norm() * length).max(torque.norm()) / size;
                        worst = worst.max(lack);
                        assert!(lack <= METHOD_BALANCE, "{case}: solved, yet out of balance by {lack:e}");
                    }
                }
            }
        }
    }
    println!("{held} solved (out of balance by {worst:.1e} at most), {refused} said that they are not");
    assert!(held > 0 && refused > 0, "the scenes are too easy or too hard: {held} solved, {refused} not");
}

#[test]
fn warm_is_as_cold() {
    for (method, label) in others() {
        let scene = scene(SCENES[1].1, 3, Interaction::Rings);
        let mut warm = device(&scene, by(method));
        assert_eq!(warm.solve(&scene.inputs).expect("valid").status, Status::Solved, "{label}");
        let mut moved = scene.clone();
        moved.inputs.sources[0].pose.position.z += 5e-3;
        assert_eq!(warm.solve(&moved.inputs).expect("valid").status, Status::Solved, "{label}");
        let cold = solved(&moved, by(method));
        let length = scene.design().expect("a design").length();
        let tips = [warm.outputs().tip.position, cold.tip.position].map(|p| p / length);
        assert_close(label, tips[0].as_slice(), tips[1].as_slice(), METHOD_COARSE);
        warm.reset();
        assert_eq!(warm.outputs().tip.position, Vector3::new(0.0, 0.0, length), "{label}: straight again");
    }
}

#[test]
fn what_a_method_cannot_is_refused() {
    let model = |interaction| equilibrium::Settings { interaction, ..Default::default() };
    let new = |model, settings| Compared::new(&design(), None, model, settings, 2);
    for (method, label) in others() {
        for interaction in [Interaction::Preceding, Interaction::Full, Interaction::Auto] {
            let error = new(model(interaction), by(method)).expect_err(label).to_string();
            let level = interaction.name();
            let expected =
                format!("method \"{label}\" has no interaction \"{level}\": choose \"none\" or \"rings\"");
            assert!(error.contains(&expected), "{error}");
        }
        let mut manipulator = new(model(Interaction::None), by(method)).expect("supported");
        let mut inputs = Inputs::unloaded(2);
        inputs.uniform_field.y = 0.02;
        let outputs = manipulator.solve(&inputs).expect("valid inputs");
        assert_eq!((outputs.status, outputs.stable), (Status::Solved, None));
        let scene = Scene { method: label.into(), ..scene("", 1, Interaction::None) };
        let device = Device::of(&scene, 2).expect("supported");
        assert_eq!(device.method(), method);
        for error in [device.jacobian().map(drop), scene.manipulator(2).map(drop)] {
            assert!(error.expect_err(label).to_string().contains(label));
        }
    }
    let mut planar = new(model(Interaction::None), by(Method::Planar)).expect("supported");
    let mut inputs = Inputs { uniform_field: Vector3::new(0.01, 0.01, 0.0), ..Inputs::unloaded(2) };
    assert!(planar.solve(&inputs).expect("a plane").status == Status::Solved);
    inputs.tip_force.x = 0.01;
    assert!(planar.solve(&inputs).expect_err("no plane").to_string().contains("does not lie in one plane"));
    assert!(new(model(Interaction::None), Settings { steps: 0, ..by(Method::Planar) }).is_err());
    assert!(new(model(Interaction::None), by(Method::Potential)).is_err(), "it is none of the others");
}

fn design() -> Design {
    Design::new(mcm::design::Specification::paper(1)).expect("the paper's design")
}

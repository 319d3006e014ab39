//! Guidewires: closed forms, a rod of the sum of stiffnesses, nothing that jumps, derivatives, refusals.

use core::f64::consts::PI;

use mcm::equilibrium::{Equilibrium, Input, Inputs, Interaction, Output, Settings, Solution};
use mcm::manipulator::{Manipulator, Outputs, Scene};
use mcm::methods::Device;
use nalgebra::{Matrix3, Vector3};

use crate::differences::{Direction, assert_derivatives, derivative};
use crate::tolerance::{
    SUM_OF_STIFFNESSES, TWO_STIFFNESSES, WIRE_DIFFERENCE, WIRE_PUSH, WIRE_RATES, assert_close,
};

/// Radii of rod and wire (m), length of the rod (m), Young's modulus (Pa) of both.
const OUTER: f64 = 0.5e-3;
const INNER: f64 = 0.25e-3;
const WIRE: f64 = 0.2e-3;
const LENGTH: f64 = 0.1;
const MODULUS: f64 = 1e7;
const WIRE_MODULUS: f64 = 2e9;

/// Multiple of the elastic stiffness that makes the Hessian away from equilibrium definite.
const SHIFT: f64 = 2.0;

/// Bending stiffness of rod and wire, N m2.
fn stiffnesses() -> [f64; 2] {
    let fourth = PI / 4.0;
    [MODULUS * fourth * (OUTER.powi(4) - INNER.powi(4)), WIRE_MODULUS * fourth * WIRE.powi(4)]
}

fn tube(modulus: f64) -> String {
    format!(
        "outer_radius_mm = 0.5\ninner_radius_mm = 0.25\nelastic_modulus_mpa = {}\npoisson = 0.45\n",
        modulus / 1e6
    )
}

/// A rod of `LENGTH` of which 80 mm are a shaft, with a force (N) across its tip.
fn rod(force: f64, modulus: f64, more: &str) -> Scene {
    let text = format!(
        "[design]\nkind = \"cylinder\"\nlength_mm = 20.0\nradius_mm = 0.5\ninner_radius_mm = 0.25\n\
         elastic_modulus_mpa = {}\npoisson = 0.45\nremanence_t = 0.0\n[load]\ntip_force_n = [{force}, 0.0, 0.0]\n\
         [model]\ninteraction = \"none\"\n[feed]\nmode = \"insertion\"\ninsertion_mm = 80.0\n[feed.shaft]\n{}{more}",
        modulus / 1e6,
        tube(modulus)
    );
    Scene::parse(&text, "rod").expect("a scene")
}

fn wire(reach: f64) -> String {
    format!(
        "[guidewire]\nradius_mm = 0.2\nelastic_modulus_mpa = {}\ninsertion_mm = {}\n",
        WIRE_MODULUS / 1e6,
        reach * 1e3
    )
}

fn solve<'a>(manipulator: &'a mut Manipulator, inputs: &Inputs) -> &'a Outputs {
    let outputs = manipulator.solve(inputs).expect("finite");
    assert!(outputs.stable == Some(true), "{outputs:?}");
    outputs
}

/// A cantilever, stiffer as far as the wire reaches, with the shear of the rod:
/// `w = F (l^3/3 (1/K - 1/(K + K_w)) + L^3/(3 (K + K_w)) + L/(G A))`, `l` without the wire.
#[test]
fn a_wire_that_reaches_part_of_the_way_makes_a_cantilever_of_two_stiffnesses() {
    let [bare, wire_only] = stiffnesses();
    let stiff = bare + wire_only;
    let shear = MODULUS / 2.9 * PI * (OUTER * OUTER - INNER * INNER);
    let force = 1e-3 * 3.0 * bare / LENGTH.powi(2);
    let scene = rod(force, MODULUS, &wire(0.0));
    let mut manipulator = scene.manipulator(2).expect("allowed");
    let mut error_at = |reach: f64| {
        let inputs = Inputs { guidewire_insertion: reach, ..scene.inputs.clone() };
        let tip = solve(&mut manipulator, &inputs).tip.position.x;
        let rest = (LENGTH - reach).max(0.0);
        let bending = rest.powi(3) * (1.0 / bare - 1.0 / stiff) + LENGTH.powi(3) / stiff;
        let error = tip / (force * (bending / 3.0 + LENGTH / shear)) - 1.0;
        println!("reach {reach}: {error:.1e}");
        error.abs()
    };
    // Between elements of the shaft, of 5 mm, where it ends, at the tip and beyond; then within elements.
    for reach in [0.0, 0.02, 0.05, 0.07, 0.08, 0.1, 0.15] {
        assert!(error_at(reach) < TWO_STIFFNESSES[0], "{reach}");
    }
    for reach in [0.0012, 0.0225, 0.0525, 0.0537, 0.0775] {
        assert!(error_at(reach) < TWO_STIFFNESSES[1], "{reach}");
    }
}

/// A wire 17 times as stiff as the rod: both bend as one rod of all that, whose shear hardly matters.
#[test]
fn a_wire_through_everything_adds_its_stiffness() {
    let [bare, wire_only] = stiffnesses();
    let force = 1.5 * (bare + wire_only) / LENGTH.powi(2);
    let with = rod(force, MODULUS, &wire(0.1));
    let sum = rod(force, MODULUS * (1.0 + wire_only / bare), "");
    let [first, second] = [&with, &sum].map(|scene| {
        let mut manipulator = scene.manipulator(2).expect("allowed");
        solve(&mut manipulator, &scene.inputs).tip.position
    });
    println!("{:e} of {}", (first - second).norm(), second.norm());
    assert!((first - second).norm() < SUM_OF_STIFFNESSES * LENGTH);
}

const DEVICE: &str = "[design]\nsegments = 3\n[design.backbone]\nouter_radius_mm = 0.74\ninner_radius_mm = 0.5\n\
    elastic_modulus_mpa = 2.0\npoisson = 0.46\n[field]\nuniform_mt = [0.0, 4.0, 1.0]\n\
    [gravity]\nacceleration_m_s2 = [0.0, -9.81, 0.0]\n[load]\ntip_force_n = [0.0003, 0.0, -0.0005]\n\
    [model]\ninteraction = \"rings\"\ntime_budget_s = 60.0\n\
    [feed]\nmode = \"insertion\"\ninsertion_mm = 12.0\n[guidewire]\nradius_mm = 0.3\nelastic_modulus_mpa = 500.0\n\
    insertion_mm = 15.0\n";

fn device() -> Scene {
    Scene::parse(DEVICE, "device").expect("a scene")
}

/// The tip moves steadily as the wire passes shaft, rings and cores, and with continuous velocity even where its end enters a ring,
/// beyond which the wire changes nothing for the length of the ring: half the steps have a quarter of the second differences.
#[test]
fn nothing_jumps_as_the_wire_goes_through() {
    let scene = device();
    let whole = scene.inputs.insertion + scene.design().expect("allowed").length();
    let tips = |from: f64, to: f64, steps: u32| -> Vec<Vector3<f64>> {
        let mut manipulator = scene.manipulator(2).expect("allowed");
        let reach = |step: u32| from + (to - from) * f64::from(step) / f64::from(steps);
        let inputs = |step| Inputs { guidewire_insertion: reach(step), ..scene.inputs.clone() };
        (0..=steps).map(|step| solve(&mut manipulator, &inputs(step)).tip.position).collect()
    };
    let moved = |tips: &[Vector3<f64>]| -> Vec<f64> {
        tips.windows(2).map(|pair| (pair[1] - pair[0]).norm()).collect()
    };
    let steps = moved(&tips(0.0, 1.02 * whole, 300));
    let (path, largest) = (steps.iter().sum::<f64>(), steps.iter().copied().fold(0.0, f64::max));
    println!("path {path:e}, largest step {largest:e}");
    assert!(path > 5e-3 && largest < 0.03 * path, "{path:e} {largest:e}");
    let ring = scene.inputs.insertion;
    for from in [ring - 1e-4, ring + 0.95e-3, ring + 3e-3] {
        let bent = |steps| {
            let tips = tips(from, from + 2e-4, steps);
            tips.windows(3).map(|all| (all[2] - all[1] * 2.0 + all[0]).norm()).fold(0.0, f64::max)
        };
        let (coarse, fine) = (bent(100), bent(200));
        println!("from {from}: second differences {coarse:e}, {fine:e}");
        assert!(fine < 0.3 * coarse + 1e-9, "{from}: {coarse:e}, {fine:e}");
    }
}

/// Rings do not act on each other: pairs that change their quadrature would move the energy by some 1e-9 of itself.
fn exactly(scene: &Scene) -> Settings {
    Settings { interaction: Interaction::None, tolerance: 1e-12, ..scene.settings }
}

/// A model without levels, and its inputs.
fn model(reach: f64) -> (Equilibrium, Inputs) {
    let scene = device();
    let settings = exactly(&scene);
    let model = Equilibrium::new(&scene.design().expect("allowed"), None, settings, 3).expect("allowed");
    (model, Inputs { guidewire_insertion: reach, ..scene.inputs })
}

/// The wire's end in the shaft, a disc, a core and a ring.
const PLACES: [f64; 5] = [0.0071, 0.01173, 0.0132, 0.0155, 0.0182];

#[test]
fn gradient_and_hessian_are_of_one_energy() {
    for reach in PLACES {
        let (mut model, inputs) = model(reach);
        assert!(model.solve(&inputs).expect("finite").solved());
        let metric = model.metric().to_vec();
        let shape: Vec<f64> =
            (0..).zip(model.unknowns()).map(|(i, x)| x * (1.0 + 0.2 * f64::from(i).sin())).collect();
        let along: Vec<f64> = (0..).zip(&metric).map(|(i, k)| f64::from(i).cos() / k.sqrt()).collect();
        let step = 1e-5 * metric.iter().copied().fold(f64::INFINITY, f64::min).sqrt();
        let allowed = [WIRE_DIFFERENCE; 2];
        let direction = Direction { shape, along, steps: [step; 2], shift: SHIFT, allowed };
        assert_derivatives(reach, &mut model, &inputs, &direction);
    }
}

/// The energy along equilibria changes by the push per length of shaft; also where that moves under the wire's end.
#[test]
fn the_push_is_the_derivative_of_the_energy() {
    for reach in PLACES.into_iter().chain([0.0, 0.1]) {
        let (mut model, inputs) = model(reach);
        assert!(model.solve(&inputs).expect("finite").solved());
        let push = model.feed_reaction(&inputs).expect("a shaft");
        let energy_at = |by: f64| {
            let inputs = Inputs { insertion: inputs.insertion + by, ..inputs.clone() };
            assert!(model.solve(&inputs).expect("finite").solved());
            let unknowns = model.unknowns().to_vec();
            model.gradient(&inputs, &unknowns).expect("apart").0
        };
        let difference = derivative(5e-6, energy_at);
        println!("{reach}: {push:e}, {:e}", difference - push);
        assert!((difference - push).abs() < WIRE_PUSH, "{reach}: {push:e} {difference:e}");
    }
}

/// Tip, push and moment at the port by the reach of the wire and by the inserted length, beside differences of solves.
#[test]
fn derivatives_by_the_reach_agree_with_differences() {
    let scene = device();
    let settings = exactly(&scene);
    for reach in PLACES {
        let inputs = Inputs { guidewire_insertion: reach, ..scene.inputs.clone() };
        let ready = |inputs: &Inputs| {
            let design = scene.design().expect("allowed");
            let mut made = Manipulator::new(&design, None, settings, 2).expect("allowed");
            solve(&mut made, inputs);
            made
        };
        let jacobian = ready(&inputs).jacobian().expect("no fold");
        for input in [Input::GuidewireInsertion, Input::Insertion] {
            let at = |by: f64| {
                let mut moved = inputs.clone();
                match input {
                    Input::Insertion => moved.insertion += by,
                    _ => moved.guidewire_insertion += by,
                }
                let made = ready(&moved);
                let out = made.outputs();
                let push = Vector3::x() * out.feed_reaction.expect("a shaft");
                Matrix3::from_columns(&[out.tip.position, push, out.base_reaction_moment])
            };
            let differences = derivative(1e-6, at);
            let outputs = [Output::TipPosition, Output::FeedReaction, Output::BaseReactionMoment];
            for (index, output) in outputs.into_iter().enumerate() {
                let told: Vec<f64> = jacobian.block(output, input).expect("there").iter().copied().collect();
                let difference = differences.column(index);
                assert_close((reach, input, output), &told, &difference.as_slice()[..told.len()], WIRE_RATES);
            }
        }
    }
}

/// A wire that reaches nothing, and a reach without a wire, change no bit; nor does a snapshot between two steps.
#[test]
fn without_a_wire_all_is_as_it_was() {
    let (text, _) = DEVICE.split_once("[guidewire]").expect("a table");
    let bare = Scene::parse(text, "bare").expect("a scene");
    let [with, without] = [&device(), &bare].map(|scene| {
        let mut manipulator = scene.manipulator(5).expect("allowed");
        let reach = if scene.guidewire.is_some() { 0.0 } else { 0.015 };
        let inputs = Inputs { guidewire_insertion: reach, ..scene.inputs.clone() };
        let first = solve(&mut manipulator, &inputs).clone();
        (first, solve(&mut manipulator, &Inputs { insertion: 0.0121, ..inputs }).clone())
    });
    assert_eq!(with, without);
    let scene = device();
    let at = |reach: f64| Inputs { guidewire_insertion: reach, ..scene.inputs.clone() };
    let mut first = scene.manipulator(5).expect("allowed");
    solve(&mut first, &at(0.015));
    solve(&mut first, &at(0.0151));
    let mut second = scene.manipulator(5).expect("allowed");
    second.restore(&first.snapshot()).expect("of this design");
    for reach in [0.0152, 0.0153, 0.014] {
        assert_eq!(solve(&mut first, &at(reach)), solve(&mut second, &at(reach)));
    }
    assert!(bare.manipulator(5).expect("allowed").restore(&first.snapshot()).is_err());
}

#[test]
fn wrong_guidewires_are_refused_by_name() {
    let shaft = format!("[feed]\nmode = \"insertion\"\n[feed.shaft]\n{}", tube(1e6));
    let solid = "[design]\nkind = \"cylinder\"\nlength_mm = 20.0\nradius_mm = 0.5\n";
    for (before, table, said) in [
        (
            "",
            "radius_mm = 0.8\nelastic_modulus_mpa = 1.0",
            "radius_mm = 0.8 is not allowed: it must be > 0 and < 0.75 (inner",
        ),
        ("", "radius_mm = 0.0\nelastic_modulus_mpa = 1.0", "guidewire.radius_mm = 0 is not allowed"),
        (&shaft, "radius_mm = 0.3\nelastic_modulus_mpa = 1.0", "< 0.25 (inner radius of the shaft)"),
        (solid, "radius_mm = 0.3\nelastic_modulus_mpa = 1.0", "guidewire: the cylinder has no lumen"),
        (
            "",
            "radius_mm = 0.3\nelastic_modulus_mpa = -1.0",
            "guidewire.elastic_modulus_mpa = -1 is not allowed: it must be > 0",
        ),
        (
            "",
            "radius_mm = 0.3\nelastic_modulus_mpa = 1.0\ninsertion_mm = -1",
            "guidewire.insertion_mm = -1 is not",
        ),
        ("", "radius_mm = 0.3", "elastic_modulus_mpa"),
    ] {
        let error =
            Scene::parse(&format!("{before}[guidewire]\n{table}"), "text").expect_err(table).to_string();
        assert!(error.contains(said), "{error}");
    }
    let text = "[design]\nsegments = 1\n[guidewire]\nradius_mm = 0.3\nelastic_modulus_mpa = 1.0\n[model]\nmethod = \"shooting\"";
    let Err(error) = Device::of(&Scene::parse(text, "text").expect("a scene"), 2) else {
        panic!("a comparison method takes a guidewire")
    };
    let error = error.to_string();
    assert!(error.contains("method \"shooting\" has no guidewire: choose method \"potential\""), "{error}");
    let unsolved = device();
    let inputs = Inputs { guidewire_insertion: 2.1, ..unsolved.inputs.clone() };
    let error = unsolved.manipulator(2).expect("allowed").solve(&inputs).expect_err("too far").to_string();
    assert!(error.contains("guidewire insertion (m) = 2.1"), "{error}");
}

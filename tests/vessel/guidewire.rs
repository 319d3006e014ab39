//! Guidewires: closed forms, a rod of the sum of stiffnesses, nothing that jumps, derivatives, refusals.

use core::f64::consts::PI;

use mcm::equilibrium::{Equilibrium, Input, Inputs, Interaction, Output, Settings};
use mcm::manipulator::{Manipulator, Outputs, Scene};

use crate::tolerance::{TWO_STIFFNESSES, assert_close};

/// Radii of rod and wire (m), length of the rod (m), Young's modulus (Pa) of both.
const OUTER: f64 = 0.5e-3;
const INNER: f64 = 0.25e-3;
const WIRE: f64 = 0.2e-3;
const LENGTH: f64 = 0.1;
const MODULUS: f64 = 1e7;
const WIRE_MODULUS: f64 = 2e9;

/// Bending stiffness of rod and wire, N m2.
fn stiffnesses() -> [f64; 2] {
    let fourth = PI / 4.0;
    [
        MODULUS * fourth * (OUTER.powi(4) - INNER.powi(4)),
        WIRE_MODULUS * fourth * WIRE.powi(4),
    ]
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

/// A cantilever, stiffer as far as the wire reaches: `w = F (l^3/3 (1/K - 1/(K + K_w)) + L^3/(3 (K + K_w)))`, `l` without the wire.
#[test]
fn a_wire_that_reaches_part_of_the_way_makes_a_cantilever_of_two_stiffnesses() {
    let [bare, wire_only] = stiffnesses();
    let stiff = bare + wire_only;
    let force = 1e-3 * 3.0 * bare / LENGTH.powi(2);
    let scene = rod(force, MODULUS, &wire(0.0));
    let mut manipulator = scene.manipulator(2).expect("allowed");
    for reach in [0.0, 0.02, 0.04, 0.05, 0.0525, 0.07, 0.08, 0.09, 0.1, 0.15_f64] {
        let inputs = Inputs { guidewire_insertion: reach, ..scene.inputs.clone() };
        let tip = solve(&mut manipulator, &inputs).tip.position.x;
        let rest = (LENGTH - reach).max(0.0);
        let closed = force / 3.0 * (rest.powi(3) * (1.0 / bare - 1.0 / stiff) + LENGTH.powi(3) / stiff);
        println!("reach {reach}: {tip:e}, {closed:e}, {:.1e}", tip / closed - 1.0);
        assert_close(reach, &[tip], &[closed], TWO_STIFFNESSES);
    }
}

/// Stiffness of the wire relative to the rod is 17: both bend as a rod of all of it, whose shear does not matter.
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
    println!("{first:?} {second:?} {:e}", (first - second).norm());
    assert!((first - second).norm() < 5e-4 * second.norm());
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

/// The tip's steps, as the wire passes shaft, rings and cores, change by little from one to the next.
#[test]
fn nothing_jumps_as_the_wire_goes_through() {
    let scene = device();
    let whole = scene.inputs.insertion + scene.design().expect("allowed").length();
    let mut manipulator = scene.manipulator(2).expect("allowed");
    let steps = 300;
    let tips: Vec<_> = (0..=steps)
        .map(|step| {
            let guidewire_insertion = 1.02 * whole * f64::from(step) / f64::from(steps);
            solve(&mut manipulator, &Inputs { guidewire_insertion, ..scene.inputs.clone() }).tip.position
        })
        .collect();
    let path: f64 = tips.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum();
    let largest = tips.windows(2).map(|pair| (pair[1] - pair[0]).norm()).fold(0.0, f64::max);
    let bent = tips.windows(3).map(|all| (all[2] - all[1] * 2.0 + all[0]).norm()).fold(0.0, f64::max);
    println!("path {path:e}, largest step {largest:e}, second difference {bent:e}");
    assert!(path > 1e-3);
    assert!(largest < 0.03 * path && bent < 0.01 * path, "{largest:e} {bent:e}");
}

/// A model without levels, and its inputs, somewhere with the wire's end in the shaft, a core, a ring.
fn model(reach: f64) -> (Equilibrium, Inputs) {
    let scene = device();
    let settings = Settings { interaction: Interaction::Rings, tolerance: 1e-12, ..scene.settings };
    let model = Equilibrium::new(&scene.design().expect("allowed"), None, settings, 3).expect("allowed");
    (model, Inputs { guidewire_insertion: reach, ..scene.inputs })
}

#[test]
fn gradient_and_hessian_are_of_one_energy() {
    for reach in [0.007, 0.0155, 0.0182] {
        let (mut model, inputs) = model(reach);
        assert!(model.solve(&inputs).expect("finite").solved());
        let here: Vec<f64> =
            model.unknowns().iter().enumerate().map(|(i, x)| x + 1e-3 * (i as f64 * 1.3).sin() * x.abs()).collect();
        let way: Vec<f64> = model.metric().iter().enumerate().map(|(i, k)| (i as f64).cos() / k.sqrt()).collect();
        let scale = 1e-5 * model.metric().iter().copied().fold(f64::INFINITY, f64::min).sqrt();
        let at = |step: f64| -> Vec<f64> { here.iter().zip(&way).map(|(x, w)| x + step * scale * w).collect() };
        let (_, gradient) = model.gradient(&inputs, &here).expect("apart");
        let [before, after] = [-1.0, 1.0].map(|step| model.gradient(&inputs, &at(step)).expect("apart"));
        let slope: f64 = gradient.iter().zip(&way).map(|(g, w)| g * w).sum();
        let difference = (after.0 - before.0) / (2.0 * scale);
        println!("{reach}: {slope:e} {difference:e}");
        let change: Vec<f64> =
            after.1.iter().zip(&before.1).map(|(a, b)| (a - b) / (2.0 * scale)).collect();
        let shifted: Vec<f64> =
            change.iter().zip(&way).zip(model.metric()).map(|((c, w), k)| c + 2.0 * k * w).collect();
        let back = model.solve_at(&inputs, &here, 2.0, &shifted).expect("definite");
        assert_close((reach, "gradient"), &[difference], &[slope], 1e-6);
        assert_close((reach, "Hessian"), &back, &way, 1e-6);
    }
}

/// The energy along equilibria changes by the push per length of shaft; also where the wire's end is in the shaft.
#[test]
fn the_push_is_the_derivative_of_the_energy() {
    for reach in [0.0, 0.0071, 0.0118, 0.0125, 0.0155, 0.03, 0.1] {
        let (mut model, inputs) = model(reach);
        let mut energy_at = |insertion: f64| {
            let inputs = Inputs { insertion, ..inputs.clone() };
            assert!(model.solve(&inputs).expect("finite").solved());
            let unknowns = model.unknowns().to_vec();
            let energy = model.gradient(&inputs, &unknowns).expect("apart").0;
            (energy, model.clone())
        };
        let step = 5e-6;
        let [a, b, c, d] = [-2.0, -1.0, 1.0, 2.0].map(|i| energy_at(0.012 + i * step).0);
        let difference = (8.0 * (c - b) - (d - a)) / (12.0 * step);
        let scene = device();
        let mut manipulator = scene.manipulator(2).expect("allowed");
        let push = solve(&mut manipulator, &inputs).feed_reaction.expect("a shaft");
        println!("{reach}: {push:e} {difference:e}");
    }
}

/// Every output by the reach of the wire and by the inserted length, beside differences of solves.
#[test]
fn derivatives_by_the_reach_agree_with_differences() {
    for reach in [0.007, 0.0118, 0.0155, 0.0182] {
        let scene = device();
        let inputs = Inputs { guidewire_insertion: reach, ..scene.inputs.clone() };
        let ready = |inputs: &Inputs| {
            let settings = Settings { tolerance: 1e-12, ..scene.settings };
            let mut made =
                Manipulator::new(&scene.design().expect("allowed"), None, settings, 2).expect("allowed");
            solve(&mut made, inputs);
            made
        };
        let jacobian = ready(&inputs).jacobian().expect("no fold");
        for input in [Input::GuidewireInsertion, Input::Insertion] {
            let step = 2e-6;
            let at = |by: f64| {
                let mut moved = inputs.clone();
                match input {
                    Input::Insertion => moved.insertion += by,
                    _ => moved.guidewire_insertion += by,
                }
                let out = ready(&moved).outputs().clone();
                let [tip, force, moment] = [out.tip.position, out.base_reaction_force, out.base_reaction_moment];
                (tip, out.feed_reaction.expect("a shaft"), force, moment)
            };
            let (before, after) = (at(-step), at(step));
            let rate = |output| jacobian.block(output, input).expect("there").as_slice().to_vec();
            let tip: Vec<f64> = ((after.0 - before.0) / (2.0 * step)).as_slice().to_vec();
            let push = (after.1 - before.1) / (2.0 * step);
            println!("{reach} {input:?}: {:?} {tip:?}; {:?} {push}", rate(Output::TipPosition), rate(Output::FeedReaction));
            let moment: Vec<f64> = ((after.3 - before.3) / (2.0 * step)).as_slice().to_vec();
            println!("   {:?} {moment:?}", rate(Output::BaseReactionMoment));
        }
    }
}

//! Shafts that are pushed in: what insertion, roll and clamping have in common, and that nothing jumps.

use mcm::equilibrium::Inputs;
use mcm::manipulator::{Manipulator, Scene};

use crate::tolerance::CLAMPED;

const SHAFT: &str = "[feed]\nmode = \"insertion\"\n[feed.shaft]\nouter_radius_mm = 0.75\ninner_radius_mm = 0.25\n\
    shore_a = 40.0\npoisson = 0.45\n";

const DEVICE: &str = "[design]\nsegments = 3\n[field]\nuniform_mt = [0.0, 0.2, 0.3]\n\
    [gravity]\nacceleration_m_s2 = [0.0, -9.81, 0.0]\n[model]\ninteraction = \"rings\"\ntime_budget_s = 60.0\n";

fn scene(tables: &str) -> Scene {
    Scene::parse(&format!("{DEVICE}{tables}"), "fed").expect("a scene")
}

fn solve<'a>(manipulator: &'a mut Manipulator, inputs: &Inputs) -> &'a mcm::manipulator::Outputs {
    let outputs = manipulator.solve(inputs).expect("finite");
    assert!(outputs.stable == Some(true), "{outputs:?}");
    outputs
}

#[test]
fn at_insertion_0_the_device_is_clamped() {
    let (clamped, fed) = (scene(""), scene(SHAFT));
    let mut first = clamped.manipulator(21).expect("allowed");
    let mut second = fed.manipulator(21).expect("allowed");
    let first = solve(&mut first, &clamped.inputs);
    let second = solve(&mut second, &fed.inputs);
    assert!((first.tip.position - second.tip.position).norm() < CLAMPED);
    assert!((first.base_reaction_force - second.base_reaction_force).norm() < CLAMPED);
    assert!((first.base_reaction_moment - second.base_reaction_moment).norm() < CLAMPED);
    assert_eq!(first.rings.len(), second.rings.len());
    assert_eq!(first.core_angles.len(), second.core_angles.len());
    assert_eq!((first.feed_length, second.feed_length), (None, Some(0.0)));
}

/// The tip moves smoothly with the insertion: by no more than a little beyond the increments themselves.
#[test]
fn nothing_jumps_from_0_to_600_mm() {
    let fed = Scene { inputs: Inputs { gravity: [0.0; 3].into(), ..scene(SHAFT).inputs }, ..scene(SHAFT) };
    let mut manipulator = fed.manipulator(21).expect("allowed");
    let mut before = solve(&mut manipulator, &fed.inputs).clone();
    let mut last = 0.0;
    for insertion in
        [1e-7, 1e-6, 1e-4, 1e-3, 3e-3, 10e-3, 11e-3, 30e-3, 100e-3, 101e-3, 300e-3, 599e-3, 600e-3]
    {
        let outputs = solve(&mut manipulator, &Inputs { insertion, ..fed.inputs.clone() }).clone();
        let (moved, by) = ((outputs.tip.position - before.tip.position).norm(), insertion - last);
        assert!(moved < 2.0 * by + 1e-7, "{insertion}: {moved} by {by}");
        let length = outputs.shape_arc_length.last().copied().unwrap_or(0.0);
        assert!((length - insertion - fed.design().expect("allowed").length()).abs() < 2e-7, "{length}");
        (before, last) = (outputs, insertion);
    }
}

/// Pulled back to its port at once the device is that which is clamped, found in a few steps.
#[test]
fn a_shaft_is_pulled_back_to_its_port_at_once() {
    let fed = scene(SHAFT);
    let mut clamped = fed.manipulator(21).expect("allowed");
    let tip = solve(&mut clamped, &fed.inputs).tip.position;
    let margin = clamped.measure_margin().stability_margin;
    for from in [0.5e-3, 5e-3, 20e-3, 60e-3] {
        let mut manipulator = fed.manipulator(21).expect("allowed");
        solve(&mut manipulator, &Inputs { insertion: from, ..fed.inputs.clone() });
        let out = solve(&mut manipulator, &fed.inputs);
        println!("from {from}: {} iterations, margin {} {margin}", out.iterations, out.stability_margin);
        assert!((out.tip.position - tip).norm() < CLAMPED, "{from}");
        assert!(out.iterations < 200, "{from}: {}", out.iterations);
        assert!((out.stability_margin - margin).abs() < 0.02 * margin, "{from}: {}", out.stability_margin);
    }
}

/// A shaft of the same material as a rod at its end is one rod: however long each part is.
#[test]
fn shaft_and_rod_of_one_material_are_one_rod() {
    let cylinder = |length: f64| {
        format!(
            "[design]\nkind = \"cylinder\"\nlength_mm = {length}\nradius_mm = 0.75\nelastic_modulus_mpa = 2.0\npoisson = 0.45\n\
             remanence_t = 0.0\ndensity_kg_m3 = 1000.0\n[gravity]\nacceleration_m_s2 = [0.0, -9.81, 0.0]\n[load]\n\
             tip_force_n = [0.0002, 0.0, -0.0002]\n[model]\ninteraction = \"none\"\n"
        )
    };
    let shaft = "[feed.shaft]\nouter_radius_mm = 0.75\ninner_radius_mm = 0.0\nelastic_modulus_mpa = 2.0\npoisson = 0.45\n\
                 density_kg_m3 = 1000.0\n";
    let whole = Scene::parse(&cylinder(60.0), "whole").expect("a scene");
    let mut rod = whole.manipulator(2).expect("allowed");
    let tip = solve(&mut rod, &whole.inputs).tip.position;
    for inserted in [10.0, 30.0, 50.0] {
        let text = format!(
            "{}[feed]\nmode = \"insertion\"\ninsertion_mm = {inserted}\n{shaft}",
            cylinder(60.0 - inserted)
        );
        let parts = Scene::parse(&text, "parts").expect("a scene");
        let mut joined = parts.manipulator(2).expect("allowed");
        let apart = (solve(&mut joined, &parts.inputs).tip.position - tip).norm();
        assert!(apart < 2.0 * parts.settings.tolerance_position, "{inserted}: {apart}");
    }
}

#[test]
fn roll_turns_the_device_about_the_axis_of_its_base() {
    let fed = scene(SHAFT);
    let by = |roll: f64, turned: bool| {
        let mut inputs = Inputs { insertion: 0.04, ..fed.inputs.clone() };
        if turned {
            inputs.base.rotation *= mcm::geometry::RotationVector::new([0.0, 0.0, roll].into()).matrix();
        } else {
            inputs.roll = roll;
        }
        solve(&mut fed.manipulator(5).expect("allowed"), &inputs).tip
    };
    let (rolled, turned) = (by(0.7, false), by(0.7, true));
    assert!((rolled.position - turned.position).norm() < 1e-12);
    assert!((rolled.position - by(0.0, false).position).norm() > 1e-7);
}

#[test]
fn a_snapshot_goes_on_with_the_same_insertion() {
    let fed = scene(SHAFT);
    let mut first = fed.manipulator(9).expect("allowed");
    let at = |millimetres: f64| Inputs { insertion: 1e-3 * millimetres, ..fed.inputs.clone() };
    solve(&mut first, &at(20.0));
    solve(&mut first, &at(20.1));
    let mut second = fed.manipulator(9).expect("allowed");
    second.restore(&first.snapshot()).expect("of this design");
    for millimetres in [20.2, 20.3, 19.0] {
        assert_eq!(solve(&mut first, &at(millimetres)), solve(&mut second, &at(millimetres)));
    }
}

#[test]
fn wrong_feeds_are_refused_by_name() {
    for (tables, said) in [
        ("[feed]\ninsertion_mm = 5.0", "feed.insertion_mm = 5 is not allowed: it must be 0 unless feed.mode"),
        ("[feed]\nmode = \"insertion\"", "feed.shaft is missing"),
        (&SHAFT.replace("[feed.shaft]", "insertion_mm = -1.0\n[feed.shaft]"), "feed.insertion_mm = -1"),
        (&SHAFT.replace("0.75", "-0.75"), "feed.shaft.outer_radius_mm = -0.75"),
        ("[vessel]", "vessel"),
        (
            "[vessel]\nfriction = -0.1\n[[vessel.branch]]\nname = \"a\"\npoints_mm = [[0,0,-9],[0,0,90]]\nradius_mm = 9.0",
            "vessel.friction = -0.1",
        ),
        (
            "[vessel]\n[[vessel.branch]]\nname = \"a\"\npoints_mm = [[0,0,-9],[0,0,90]]\nradius_mm = 1.5",
            "does not fit",
        ),
        (
            "[vessel]\n[[vessel.branch]]\nname = \"a\"\npoints_mm = [[0,30,-9],[0,30,90]]\nradius_mm = 9.0",
            "does not fit",
        ),
    ] {
        let error = Scene::parse(&format!("{DEVICE}{tables}"), "text").expect_err(tables).to_string();
        assert!(error.contains(said), "{error}");
    }
}

//! Shafts under a given push: the length follows, and whether the device holds it.

use mcm::equilibrium::Inputs;
use mcm::manipulator::{Manipulator, Outcome, Outputs, Scene, Status};
use nalgebra::Vector3;

/// Largest part of the magnet's way by which the device's may differ: the shaft leaves its port above the wall and comes down to it
/// over the length that it has.
const SETTLES: f64 = 1e-3;

const SHAFT: &str = "[feed.shaft]\nouter_radius_mm = 0.75\ninner_radius_mm = 0.25\nelastic_modulus_mpa = 1.0\npoisson = 0.45\n";

/// Three segments in a straight tube along `z`; the magnet is 70 mm beneath the place `z` (mm) and its field there along `z`.
fn dragged(mode: &str, z: f64) -> Scene {
    let text = format!(
        "[design]\nsegments = 3\nspiral = \"axisymmetric\"\n[magnet]\nposition_mm = [0.0, -70.0, {z}]\n\
         orientation_wxyz = [0.0, 1.0, 0.0, 0.0]\n[feed]\n{mode}\n{SHAFT}[model]\ninteraction = \"rings\"\n\
         time_budget_s = 60.0\n[vessel]\n[[vessel.branch]]\nname = \"tube\"\n\
         points_mm = [[0, 0, -20], [0, 0, 100], [0, 0, 200], [0, 0, 300]]\nradius_mm = 4.0\n"
    );
    Scene::parse(&text, "dragged").expect("a scene")
}

fn solve<'a>(manipulator: &'a mut Manipulator, inputs: &Inputs) -> &'a Outputs {
    manipulator.solve(inputs).expect("finite")
}

/// A magnet beneath a straight tube takes the device along: as far as it moves itself.
#[test]
fn a_device_follows_its_magnet() {
    let scene = dragged("mode = \"force\"\ninsertion_mm = 30.0", 60.0);
    let mut manipulator = scene.manipulator(11).expect("allowed");
    let first = solve(&mut manipulator, &scene.inputs).clone();
    assert_eq!((first.stable, first.outcome), (Some(true), Outcome::Solved));
    assert!(first.feed_reaction.expect("a shaft").abs() < 1e-9);
    for step in 1..=8 {
        let along = 5e-3 * f64::from(step);
        let mut inputs = scene.inputs.clone();
        inputs.sources[0].pose.position.z += along;
        let next = solve(&mut manipulator, &inputs);
        assert!(next.stable == Some(true) && next.snaps == 0, "{next:?}");
        let moved = next.tip.position - first.tip.position - Vector3::z() * along;
        assert!(moved.norm() < SETTLES * along, "{along}: {moved}");
    }
}

/// The pull at which the magnet no longer holds the device is the largest of all lengths; beyond, the shaft comes out.
#[test]
fn a_pull_beyond_the_largest_that_the_magnet_holds_is_told() {
    let given = dragged("mode = \"insertion\"\ninsertion_mm = 80.0", 100.0);
    let mut model = given.manipulator(2).expect("allowed");
    let pulls = (0..120).map(|i| {
        let insertion = 0.08 - 0.5e-3 * f64::from(i);
        let outputs = solve(&mut model, &Inputs { insertion, ..given.inputs.clone() });
        -outputs.feed_reaction.expect("a shaft")
    });
    let largest = pulls.fold(0.0, f64::max);
    assert!(largest > 5e-3, "{largest}");
    let pulled = dragged("mode = \"force\"\ninsertion_mm = 80.0", 100.0);
    let mut model = pulled.manipulator(2).expect("allowed");
    let at = |pull: f64| Inputs { feed_force: Some(-pull), ..pulled.inputs.clone() };
    let held = solve(&mut model, &at(0.98 * largest)).clone();
    assert!(held.stable == Some(true) && held.snaps == 0, "{held:?}");
    assert!(held.feed_length > Some(0.02), "{held:?}");
    let lost = solve(&mut model, &at(1.02 * largest)).clone();
    assert_eq!((lost.status, lost.feed_length), (Status::Snapped, Some(0.0)), "{lost:?}");
}

/// A rod that leaves a smooth port by `l` under a force `P` across is pushed out by `P^2 l^2 / (2 K)` (Bigoni et al. 2015), the
/// more the longer it is: no push holds it, and the port holds what is pulled out.
#[test]
fn what_no_push_holds_comes_out_or_is_lost() {
    let text = format!(
        "[design]\nkind = \"cylinder\"\nlength_mm = 5.0\nradius_mm = 0.75\nelastic_modulus_mpa = 1.0\npoisson = 0.45\n\
         remanence_t = 0.0\ndensity_kg_m3 = 1000.0\n[load]\ntip_force_n = [0.0005, 0.0, 0.0]\n[feed]\nmode = \"force\"\n\
         insertion_mm = 15.0\nforce_n = 0.01\n{SHAFT}"
    );
    let scene = Scene::parse(&text, "sleeve").expect("a scene");
    let mut pushed = scene.manipulator(2).expect("allowed");
    assert_eq!(solve(&mut pushed, &scene.inputs).status, Status::NotSolved);
    let mut pulled = scene.manipulator(2).expect("allowed");
    let outputs = solve(&mut pulled, &Inputs { feed_force: Some(-0.01), ..scene.inputs.clone() });
    assert_eq!((outputs.feed_length, outputs.stable), (Some(0.0), Some(true)));
}

/// Without any load, every length is as good: the start is kept, and said to be neutral.
#[test]
fn a_free_shaft_stays_where_it_is() {
    let text = format!("[design]\nsegments = 1\n[feed]\nmode = \"force\"\ninsertion_mm = 25.0\n{SHAFT}");
    let scene = Scene::parse(&text, "free").expect("a scene");
    let mut model = scene.manipulator(2).expect("allowed");
    let outputs = solve(&mut model, &scene.inputs);
    assert_eq!((outputs.feed_length, outputs.outcome), (Some(0.025), Outcome::Neutral));
}

#[test]
fn a_push_without_its_mode_is_refused() {
    for (mode, told) in [
        (
            "mode = \"insertion\"\nforce_n = 0.1",
            "feed.force_n = 0.1 is not allowed: it must be 0 unless feed.mode = \"force\"",
        ),
        ("mode = \"force\"\nforce_n = nan", "force"),
    ] {
        let text = format!("[design]\nsegments = 1\n[feed]\n{mode}\n{SHAFT}");
        let message = Scene::parse(&text, "refused").expect_err("refused").to_string();
        assert!(message.contains(told), "{message}");
    }
}

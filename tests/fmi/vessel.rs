//! The FMU of a scene with a shaft in a vessel.

use mcm::fmi::state::Ending;
use mcm::manipulator::Scene;

use super::instance::{get, initialised, set};
use super::last;
use crate::tolerance::{SAME_SHAPE, assert_close};

/// Three segments on a shaft that a field presses against the wall of a tube.
const PUSHED: &str = "[design]\nsegments = 3\n[field]\nuniform_mt = [0.0, 3.0, 0.0]\n[model]\ninteraction = \"rings\"\n\
    time_budget_s = 20.0\n[feed]\nmode = \"insertion\"\ninsertion_mm = 2.0\n[feed.shaft]\nouter_radius_mm = 0.75\n\
    inner_radius_mm = 0.25\nelastic_modulus_mpa = 1.0\npoisson = 0.45\n[vessel]\n[[vessel.branch]]\nname = \"tube\"\n\
    points_mm = [[0, 0, -20], [0, 0, 40], [0, 0, 100]]\nradius_mm = 3.5\n";

#[test]
fn a_shaft_is_pushed_in_and_the_wall_pushes_back() {
    let (mut pushed, table, told) = initialised(PUSHED);
    for step in 1..=5 {
        let insertion = 2e-3 + 1e-3 * f64::from(step);
        assert_eq!(set(&mut pushed, &table, "feed.insertion", insertion), Ending::Ok);
        assert_eq!(pushed.do_step(0.1 * f64::from(step - 1), 0.1), Ending::Ok, "{}", last(&told));
    }
    let mut scene = Scene::parse(PUSHED, "test").unwrap();
    let mut manipulator = scene.manipulator(5).unwrap();
    manipulator.solve(&scene.inputs).unwrap();
    for step in 1..=5 {
        scene.inputs.insertion = 2e-3 + 1e-3 * f64::from(step);
        manipulator.solve(&scene.inputs).unwrap();
    }
    let outputs = manipulator.outputs();
    let wall = outputs.wall.as_ref().unwrap();
    assert!(wall.force.norm() > 1e-5, "{wall:?}");
    for axis in 0..3 {
        let mut read = |name: &str| get(&mut pushed, &table, &format!("{name}[{}]", axis + 1));
        assert_close("tip", &[read("tip.position")], &[outputs.tip.position[axis]], SAME_SHAPE);
        assert_close("wall", &[read("contact.force")], &[wall.force[axis]], SAME_SHAPE);
        let rings: f64 = (1..=4).map(|ring| read(&format!("ring[{ring}].contact_force"))).sum();
        assert_close("rings", &[rings], &[wall.rings.iter().map(|force| force[axis]).sum()], SAME_SHAPE);
    }
    assert_close("length", &[get(&mut pushed, &table, "feed.length")], &[7e-3], SAME_SHAPE);
    let push = get(&mut pushed, &table, "feed.reaction_force");
    assert_close("push", &[push], &[outputs.feed_reaction.unwrap()], SAME_SHAPE);
    assert!(get(&mut pushed, &table, "contact.largest_indentation") > 0.0);
    assert_eq!(set(&mut pushed, &table, "feed.insertion", -0.001), Ending::Ok);
    assert_ne!(pushed.do_step(0.5, 0.1), Ending::Ok, "a shaft that is pulled out of its port");
}

#[test]
fn other_scenes_have_no_such_variables() {
    let (_, table, _) = initialised(super::BENT);
    for name in ["feed.insertion", "feed.length", "contact.count", "vessel.wall_modulus"] {
        assert_eq!(table.reference(name), None, "{name}");
    }
}

/// The same in mode force, with a magnet that takes the device along.
#[test]
fn a_shaft_under_a_given_push_tells_its_length_and_derivatives() {
    let text = PUSHED.replace("\"insertion\"", "\"force\"").replace("uniform_mt = [0.0, 3.0, 0.0]", "");
    let magnet = "[magnet]\nposition_mm = [0.0, -70.0, 40.0]\norientation_wxyz = [0.0, 1.0, 0.0, 0.0]\n";
    let (mut pushed, table, told) = initialised(&format!("{text}{magnet}"));
    let mut at = |push: f64, time: f64| {
        assert_eq!(set(&mut pushed, &table, "feed.force", push), Ending::Ok);
        assert_eq!(pushed.do_step(time, 0.1), Ending::Ok, "{}", last(&told));
        let force = get(&mut pushed, &table, "feed.reaction_force");
        assert_close("push", &[force], &[push], SAME_SHAPE);
        let [length, given] = ["feed.length", "feed.force"].map(|name| table.reference(name).unwrap());
        let slope = pushed.directional_derivative(&[length], &[given], &[1.0]).unwrap()[0];
        (get(&mut pushed, &table, "feed.length"), slope)
    };
    let (first, slope) = at(0.0, 0.0);
    let (second, beyond) = at(1e-4, 0.1);
    assert!(first > 5e-3 && slope > 0.0, "{first}, {slope}");
    let mean = 0.5 * (slope + beyond);
    assert!(((second - first) / 1e-4 - mean).abs() < 1e-3 * mean, "{first} {second} {slope} {beyond}");
}

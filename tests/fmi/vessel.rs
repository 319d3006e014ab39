//! The FMU of a scene with a shaft in a vessel.

use mcm::fmi::Instance;
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
    for name in ["feed.insertion", "feed.length", "contact.count", "vessel.wall_modulus", "vessel.friction"] {
        assert_eq!(table.reference(name), None, "{name}");
    }
}

/// The wall holds on where its friction is switched on, on the way; saved and serialised states remember what it holds.
#[test]
fn friction_is_tunable_and_part_of_the_state() {
    let (mut first, table, told) = initialised(PUSHED);
    let go = |instance: &mut Instance, to: f64| {
        assert_eq!(set(instance, &table, "feed.insertion", to), Ending::Ok);
        let time = instance.time();
        assert_eq!(instance.do_step(time, 0.1), Ending::Ok, "{}", last(&told));
        get(instance, &table, "feed.reaction_force")
    };
    let free = go(&mut first, 4e-3);
    assert_eq!(set(&mut first, &table, "vessel.friction", 0.4), Ending::Ok);
    let pushed = go(&mut first, 5e-3);
    go(&mut first, 5.2e-3);
    let pulled = go(&mut first, 5e-3);
    println!("free {free:.2e}, pushed {pushed:.2e}, pulled {pulled:.2e}");
    assert!(pushed - pulled > 1e-3, "a loop: {pushed} {pulled}");
    assert_eq!(first.save(1), Ending::Ok);
    let bytes = first.serialised(1).unwrap();
    let ways = [4.999e-3, 4.9e-3, 5.2e-3];
    let wanted = ways.map(|to| go(&mut first, to).to_bits());
    assert_eq!(first.restore(1), Ending::Ok);
    assert_eq!(ways.map(|to| go(&mut first, to).to_bits()), wanted, "from the saved state");
    let (mut second, _, other) = super::instance(PUSHED);
    assert_eq!(second.deserialise(1, &bytes), Ending::Ok, "{}", last(&other));
    assert_eq!(second.restore(1), Ending::Ok);
    assert_eq!(ways.map(|to| go(&mut second, to).to_bits()), wanted, "from the bytes");
    assert_eq!(set(&mut first, &table, "vessel.friction", f64::NAN), Ending::Error);
    assert!(last(&told).contains("vessel.friction"), "{}", last(&told));
    for wrong in [-0.1, 11.0] {
        assert_eq!(set(&mut first, &table, "vessel.friction", wrong), Ending::Ok);
        let time = first.time();
        assert_eq!(first.do_step(time, 0.1), Ending::Error);
        let said = last(&told);
        assert!(said.contains("vessel.friction") && said.contains("from 0 to 10"), "{said}");
    }
    assert_eq!(set(&mut first, &table, "vessel.friction", 0.4), Ending::Ok);
    go(&mut first, 5.3e-3);
}

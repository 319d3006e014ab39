//! The FMU of a scene with a shaft in a vessel.

use std::fs;
use std::path::Path;

use mcm::equilibrium::{Input, Output};
use mcm::fmi::package::identify;
use mcm::fmi::state::Ending;
use mcm::fmi::variables::Table;
use mcm::fmi::{Instance, Package};
use mcm::manipulator::{Scene, SceneFile};
use nalgebra::Vector3;

use super::instance::{get, initialised, set, started};
use super::package::{directory, unpacked};
use super::{instance_of, last};
use crate::tolerance::{SAME_SHAPE, assert_close};
use crate::vessel::tube::{shifted, stl, straight, tube};

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
    for name in [
        "feed.insertion",
        "feed.length",
        "guidewire.insertion",
        "contact.count",
        "vessel.wall_modulus",
        "vessel.friction",
    ] {
        assert_eq!(table.reference(name), None, "{name}");
    }
}

/// A guidewire pushed ahead: steps are those of the scene, and the derivative is that of the tip.
#[test]
fn a_guidewire_is_pushed_ahead() {
    let wire = "[guidewire]\nradius_mm = 0.2\nelastic_modulus_mpa = 500.0\ninsertion_mm = 1.0\n";
    let text = format!("{PUSHED}{wire}");
    let (mut pushed, table, told) = initialised(&text);
    let mut scene = Scene::parse(&text, "test").unwrap();
    let mut manipulator = scene.manipulator(5).unwrap();
    manipulator.solve(&scene.inputs).unwrap();
    for step in 1..=5 {
        scene.inputs.guidewire_insertion = 2e-3 * f64::from(step);
        manipulator.solve(&scene.inputs).unwrap();
        assert_eq!(set(&mut pushed, &table, "guidewire.insertion", 2e-3 * f64::from(step)), Ending::Ok);
        assert_eq!(pushed.do_step(0.1 * f64::from(step - 1), 0.1), Ending::Ok, "{}", last(&told));
    }
    let tip = manipulator.outputs().tip.position.y;
    assert_close("tip", &[get(&mut pushed, &table, "tip.position[2]")], &[tip], SAME_SHAPE);
    let [of, by] = ["tip.position[2]", "guidewire.insertion"].map(|name| table.reference(name).unwrap());
    let slope = pushed.directional_derivative(&[of], &[by], &[1.0]).unwrap()[0];
    let block = manipulator.jacobian().unwrap();
    let block = block.block(Output::TipPosition, Input::GuidewireInsertion).unwrap();
    assert!(slope != 0.0);
    assert_close("slope", &[slope], &[block[(1, 0)]], SAME_SHAPE);
    assert_eq!(set(&mut pushed, &table, "guidewire.insertion", -0.001), Ending::Ok);
    assert_ne!(pushed.do_step(0.5, 0.1), Ending::Ok, "a wire pulled out of the port");
}

/// In mode force the push is given, and a magnet takes the device along.
#[test]
fn a_shaft_under_a_given_push_tells_its_length_and_derivatives() {
    let text = PUSHED.replace("\"insertion\"", "\"force\"").replace("uniform_mt = [0.0, 3.0, 0.0]", "");
    let magnet = "[magnet]\nposition_mm = [0.0, -70.0, 40.0]\norientation_wxyz = [0.0, 1.0, 0.0, 0.0]\n";
    let (mut pushed, table, told) = initialised(&format!("{text}{magnet}"));
    let mut at = |push: f64, time: f64| {
        assert_eq!(set(&mut pushed, &table, "feed.force", push), Ending::Ok);
        assert_eq!(pushed.do_step(time, 0.1), Ending::Ok, "{}", last(&told));
        let force = get(&mut pushed, &table, "feed.reaction_force");
        assert!((force - push).abs() < 1e-9, "{force} {push}");
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

/// The package of [`PUSHED`] in a tube of triangles in the folder `phantom`.
fn meshed(name: &str) -> Package {
    let folder = directory(name);
    fs::create_dir(folder.join("phantom")).unwrap();
    let triangles = shifted(tube(straight(0.12, 3.5e-3), 120, 48), Vector3::new(0.0, 0.0, -0.02));
    fs::write(folder.join("phantom/tube.stl"), stl(&triangles, "")).unwrap();
    let (text, _) = PUSHED.split_once("[[vessel.branch]]").unwrap();
    let text = format!("{text}mesh_stl = \"phantom/tube.stl\"\n");
    Package::of(&SceneFile::parse_in(&text, "meshed", &folder).unwrap(), 5).unwrap()
}

/// A step of 1 mm into the vessel, and what it answers bit for bit.
fn push(instance: &mut Instance, table: &Table, length: f64) -> Vec<u64> {
    assert_eq!(set(instance, table, "feed.insertion", length), Ending::Ok);
    let time = instance.time();
    assert_eq!(instance.do_step(time, 0.1), Ending::Ok);
    let names = ["tip.position[2]", "contact.force[2]", "feed.reaction_force"];
    names.iter().map(|name| get(instance, table, name).to_bits()).collect()
}

#[test]
fn a_mesh_travels_in_the_resources() {
    let package = meshed("fmi mesh");
    let names: Vec<&str> = package.resources().unwrap().iter().map(|(name, _)| *name).collect();
    assert_eq!(names, ["scene.toml", "package.toml", "vessel.grid"]);
    let [here, there] = ["fmi mesh (here)", "fmi mesh (there)"].map(|name| unpacked(name, &package));
    let scene = fs::read_to_string(here.join("scene.toml")).unwrap();
    assert!(scene.contains("mesh_stl = \"tube.stl\"\n"), "without the folder where it was packed: {scene}");
    let from = |path: &Path| started(instance_of(identify(package.guid(), &[path.to_owned()]).unwrap()));
    // Two at once, from two places, of which one is removed: they do not need it any more.
    let ((mut first, table, _), (mut second, ..)) = (from(&here), from(&there));
    fs::remove_dir_all(&there).unwrap();
    let (mut packed, ..) = started(instance_of(package.clone()));
    for step in 1..=3 {
        let length = 2e-3 + 1e-3 * f64::from(step);
        let [one, two, three] = [&mut first, &mut second, &mut packed].map(|own| push(own, &table, length));
        assert_eq!(one, two);
        assert_eq!(one, three);
    }
    assert!(get(&mut first, &table, "contact.force[2]").abs() > 1e-5);
    // A state as bytes goes on in an instance from elsewhere.
    assert_eq!(first.save(1), Ending::Ok);
    let bytes = first.serialised(1).unwrap();
    let (mut third, ..) = from(&here);
    assert_eq!(third.deserialise(1, &bytes), Ending::Ok);
    assert_eq!(third.restore(1), Ending::Ok);
    assert_eq!(push(&mut third, &table, 6e-3), push(&mut first, &table, 6e-3));
}

#[test]
fn a_mesh_that_is_missing_or_another_is_refused() {
    let package = meshed("fmi mesh refused");
    let folder = unpacked("fmi mesh spoiled", &package);
    let path = folder.join("vessel.grid");
    let whole = fs::read(&path).unwrap();
    let refused = |content: Option<&[u8]>| {
        content.map_or_else(|| fs::remove_file(&path).unwrap(), |content| fs::write(&path, content).unwrap());
        identify(package.guid(), std::slice::from_ref(&folder)).unwrap_err().to_string()
    };
    let missing = refused(None);
    assert!(missing.contains("vessel.grid: No such file"), "{missing}");
    let mut altered = whole.clone();
    altered[whole.len() / 2] ^= 1;
    for (case, content) in [("altered", &altered[..]), ("cut", &whole[..whole.len() - 9]), ("empty", &[])] {
        let told = refused(Some(content));
        assert!(told.contains("scene.toml, line") && told.contains("vessel.grid: "), "{case}: {told}");
    }
    let box_around = [Vector3::repeat(-0.05), Vector3::repeat(0.05)];
    let ball = mcm::vessel::DistanceGrid::new(box_around, 5e-3, |at| 0.05 - at.norm()).unwrap();
    let other = refused(Some(&ball.to_bytes().unwrap()));
    assert!(other.contains("that of the scene and vessel beside it"), "{other}");
    fs::write(&path, &whole).unwrap();
    assert!(identify(package.guid(), &[folder]).is_ok());
}

#[test]
fn a_state_with_another_wall_takes_its_wall_along() {
    let (mut soft, table, _) = initialised(PUSHED);
    push(&mut soft, &table, 5e-3);
    assert_eq!(soft.save(1), Ending::Ok);
    let bytes = soft.serialised(1).unwrap();
    let (mut stiff, _, told) = super::instance(PUSHED);
    assert_eq!(set(&mut stiff, &table, "vessel.wall_modulus", 5e6), Ending::Ok);
    let (mut stiff, ..) = started((stiff, Package::new(PUSHED, "test scene", 5).unwrap(), told));
    assert_ne!(push(&mut stiff, &table, 5e-3), push(&mut soft, &table, 5e-3));
    assert_eq!(stiff.deserialise(1, &bytes), Ending::Ok);
    assert_eq!(stiff.restore(1), Ending::Ok);
    assert_eq!(push(&mut stiff, &table, 6e-3), push(&mut soft, &table, 6e-3));
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

//! The way on which a device comes to its first inputs.

use mcm::fmi::value::Value;
use mcm::fmi::variable::Causality;
use mcm::fmi::{Instance, Package};
use mcm::manipulator::{Manipulator, Outputs, PlacedSource, Scene, SceneFile, Status};
use mcm::methods::Device;

use crate::tolerance::{SAME_SHAPE, assert_close};

/// Nine segments, and the paper's pair of magnets with its field against them: where it stands there are two shapes.
const PASSING: &str = "[design]\nsegments = 9\n[magnet]\nposition_mm = [0, -120, Z]\nturn_deg = 180\n\
                       [model]\ninteraction = \"none\"\ntime_budget_s = 30.0\n";

/// Everything that has inputs of its own.
const EVERYTHING: &str = "[design]\nsegments = 2\n[[magnet]]\nturn_deg = 30\n[[magnet]]\nposition_mm = [150.0, 0.0, 0.0]\nturn_deg = -20\n\
    [[coil]]\nposition_mm = [0.0, 90.0, 0.0]\ninner_radius_mm = 20.0\nouter_radius_mm = 40.0\nlength_mm = 60.0\nturns = 600\n\
    [field]\nuniform_mt = [0.0, 5.0, 0.0]\nturn_deg = 10\n[base]\nposition_mm = [1, 2, 3]\nturn_deg = 5\n[feed]\nmode = \"force\"\n\
    insertion_mm = 3.0\nforce_n = 0.001\n[feed.shaft]\nouter_radius_mm = 0.7\ninner_radius_mm = 0.3\nshore_a = 40.0\npoisson = 0.4\n\
    [guidewire]\nradius_mm = 0.2\nelastic_modulus_mpa = 1000.0\n";

/// From below the device to beyond it, and back.
const PLACES: [f64; 3] = [-80.0, -20.0, 70.0];

fn passing(at: f64, way: &[f64]) -> String {
    let rows = way.iter().map(|z| format!("[[start.way]]\n\"magnet.position[3]\" = {:?}\n", 1e-3 * z));
    PASSING.replace('Z', &format!("{at:?}")) + &rows.collect::<String>()
}

fn solved(text: &str) -> Outputs {
    let scene = Scene::parse(text, "test").unwrap();
    let mut manipulator = scene.manipulator(5).unwrap();
    manipulator.solve(&scene.inputs).unwrap().clone()
}

/// What is found at the last place by solves in turn, without a way.
fn followed(places: &[f64]) -> Outputs {
    let mut manipulator: Option<Manipulator> = None;
    for z in places {
        let scene = Scene::parse(&passing(*z, &[]), "test").unwrap();
        let manipulator = manipulator.get_or_insert_with(|| scene.manipulator(5).unwrap());
        manipulator.solve(&scene.inputs).unwrap();
    }
    manipulator.unwrap().outputs().clone()
}

#[test]
fn the_way_decides_which_of_two_shapes_a_device_has() {
    let [first, middle, last] = PLACES;
    let forth = solved(&passing(middle, &[first]));
    let back = solved(&passing(middle, &[first, last]));
    for (found, places) in [(&forth, &[first, middle][..]), (&back, &[first, last, middle])] {
        let expected = followed(places);
        assert_eq!(found.status, Status::Solved);
        assert_eq!(found.snaps, 0, "jumps before the beginning are none of the device");
        assert_close(places, found.tip.position.as_slice(), expected.tip.position.as_slice(), SAME_SHAPE);
    }
    let apart = (forth.tip.position - back.tip.position).norm();
    assert!(apart > 0.01, "two shapes: {apart} m");
    // An FMU of the scene begins there too, also after a reset, and whatever was read before.
    let package = Package::new(&passing(middle, &[first, last]), "test", 5).unwrap();
    let tip = package.table().reference("tip.position[3]").unwrap();
    let snaps = package.table().reference("stability.snaps").unwrap();
    let (mut instance, ..) = crate::fmi::instance_of(package);
    for _ in 0..2 {
        instance.enter_initialization();
        instance.exit_initialization();
        let found = instance.get(&[tip], "Real", Value::real).unwrap();
        assert_close("FMU", &found, &[back.tip.position.z], SAME_SHAPE);
        assert_eq!(instance.get(&[snaps], "Integer", Value::integer), Ok(vec![0]));
        instance.reset();
    }
    let _: &Instance = &instance;
}

#[test]
fn a_way_that_ends_is_told_and_leaves_no_shape() {
    let text = passing(-80.0, &[-80.0, 20.0]) + "\"magnet.position[2]\" = -0.01\n";
    let scene = Scene::parse(&text, "test").unwrap();
    let mut manipulator = scene.manipulator(5).unwrap();
    let outputs = manipulator.solve(&scene.inputs).unwrap();
    assert_eq!(outputs.status, Status::NotSolved);
    assert!((1.0 / 3.0..2.0 / 3.0).contains(&outputs.progress), "{}", outputs.progress);
    assert!(outputs.outcome.to_string().contains("bodies touch"), "{}", outputs.outcome);
    assert!(!manipulator.has_shape());
}

#[test]
fn names_and_numbers_are_those_of_the_fmu() {
    for text in
        [EVERYTHING, PASSING.replace('Z', "0").as_str(), "[design]\nsegments = 1\nbase_magnet = false"]
    {
        let package = Package::new(text, "test", 2).unwrap();
        let (table, own) = (package.table(), package.start().inputs().unwrap());
        let inputs: Vec<_> =
            table.variables().iter().filter(|variable| variable.causality == Causality::Input).collect();
        for variable in &inputs {
            // An orientation in whole, turned by a little.
            let body =
                variable.name.split_once(".orientation[").map(|(body, _)| format!("{body}.orientation["));
            let group = |other: &&&mcm::fmi::variable::Variable| {
                body.as_ref()
                    .map_or(other.name == variable.name, |body| other.name.starts_with(body.as_str()))
            };
            let mut values = package.start().clone();
            let mut row = String::from("[[start.way]]\n");
            for (number, set) in inputs.iter().filter(group).enumerate() {
                let value = if body.is_some() { [0.6, 0.0, 0.8, 0.0][number] } else { 0.0625 };
                set.set(&mut values, Value::Real(value)).unwrap();
                row += "\"";
                row += &set.name;
                row +=
                    &["\" = ", &value.to_string(), if value.fract() == 0.0 { ".0\n" } else { "\n" }].concat();
            }
            let scene =
                Scene::parse(&format!("{text}\n{row}"), "test").unwrap_or_else(|e| panic!("{row} {e}"));
            let expected = values.inputs().unwrap();
            let points = scene.way.points(&own).unwrap();
            assert_eq!(points, std::slice::from_ref(&expected), "{}", variable.name);
            let idle = variable.name == "feed.force" && own.feed_force.is_none();
            let without = variable.name.starts_with("magnet.") && scene.sources.magnet().is_none();
            assert!(expected != own || idle || without, "{} has an effect", variable.name);
        }
    }
}

#[test]
fn rows_that_are_none_are_refused_by_name_and_number() {
    let row = |text: &str| format!("[design]\nsegments = 1\n[[start.way]]\n[[start.way]]\n{text}\n");
    for (text, said) in [
        (
            row("\"field.unifrom[2]\" = 0.1"),
            "start.way[2]: `field.unifrom[2]` is no input of this device; did you mean `field.uniform[2]`?",
        ),
        (row("\"tip.angle\" = 0.1"), "`tip.angle` is no input of this device"),
        (row("\"ring[3].load_force[1]\" = 0.1"), "`ring[3].load_force[1]` is no input"),
        (row("\"feed.insertion\" = 0.1"), "`feed.insertion` is no input"),
        (row("\"base.orientation[1]\" = 0.9"), "start.way[2]: base.orientation needs all four components"),
        (
            row(
                "\"base.orientation[1]\" = 0.1\n\"base.orientation[2]\" = 0.1\n\"base.orientation[3]\" = 0.1\n\"base.orientation[4]\" = 0.1",
            ),
            "norm of an orientation of start.way = 0.2",
        ),
        (row("\"magnet.strength\" = nan"), "finite"),
        (row("\"magnet.strength\" = true"), "invalid type"),
        ("[start]\nwya = []".to_owned(), "did you mean `way`?"),
        (
            format!("[design]\nsegments = 1\n{}", "[[start.way]]\n".repeat(201)),
            "start.way has 201 entries, expected at most 200",
        ),
    ] {
        let refused = Scene::parse(&text, "test").unwrap_err().to_string();
        assert!(refused.contains(said), "{refused}");
    }
    let other =
        Scene::parse(&(row("\"field.uniform[2]\" = 0.01") + "[model]\nmethod = \"shooting\""), "test")
            .unwrap();
    assert!(Device::of(&other, 2).unwrap_err().to_string().contains("start.way needs method \"potential\""));
}

#[test]
fn a_scene_is_written_at_other_inputs_with_its_way() {
    let file = SceneFile::parse(EVERYTHING, "test").unwrap();
    let own = file.scene().unwrap().inputs;
    assert_eq!(file.at(&own, &[]).unwrap(), file, "what does not move stays as it is written");
    let mut moved = own.clone();
    moved.sources[0].pose = moved.sources[0].pose.advanced(0.01);
    moved.sources[0].strength = 0.75;
    moved.sources[1].pose = moved.sources[1].pose.advanced(0.02);
    moved.sources[2].strength = 2.0;
    moved.uniform_field.x = 1e-3;
    moved.field_gradient[2] = 0.1;
    moved.base = moved.base.advanced(0.003);
    (moved.insertion, moved.roll, moved.feed_force) = (0.004, 0.3, Some(0.002));
    moved.guidewire_insertion = 0.005;
    moved.tip_force.y = 1e-3;
    moved.tip_moment.z = 1e-6;
    moved.ring_forces[1].z = 2e-3;
    let row = [("field.uniform[2]".to_owned(), 0.01)].into_iter().collect();
    let written = file.at(&moved, &[row]).unwrap().to_toml().unwrap();
    let read = Scene::parse(&written, "written").unwrap();
    let numbers = |inputs: &mcm::manipulator::Inputs| format!("{inputs:?}");
    assert_eq!(read.way.rows().len(), 1);
    let (read, moved) = (read.inputs, moved);
    assert_eq!(read.sources.len(), 3, "{}", numbers(&read));
    for (a, b) in read.sources.iter().zip(&moved.sources) {
        assert!(
            (a.pose.position - b.pose.position).norm() < 1e-15
                && (a.pose.rotation - b.pose.rotation).norm() < 1e-14
        );
        assert_close("strength", &[a.strength], &[b.strength], SAME_SHAPE);
    }
    assert!((read.base.position - moved.base.position).norm() < 1e-15);
    assert!((read.uniform_field - moved.uniform_field).norm() < 1e-16);
    assert_eq!(
        (read.field_gradient, read.tip_force, read.tip_moment),
        (moved.field_gradient, moved.tip_force, moved.tip_moment)
    );
    assert_eq!(read.ring_forces, moved.ring_forces);
    assert_close(
        "feed",
        &[read.insertion, read.roll, read.feed_force.unwrap(), read.guidewire_insertion],
        &[moved.insertion, moved.roll, moved.feed_force.unwrap(), moved.guidewire_insertion],
        SAME_SHAPE,
    );
    // A magnet that is switched on where the scene has none becomes the usual one.
    let bare = SceneFile::parse("[design]\nsegments = 1", "test").unwrap();
    let mut inputs = bare.scene().unwrap().inputs;
    inputs.sources.push(PlacedSource { pose: own.sources[0].pose, strength: 0.5 });
    let scene = bare.at(&inputs, &[]).unwrap().scene().unwrap();
    assert_eq!(scene.sources.magnet().map(|magnet| magnet.parts().len()), Some(2));
}

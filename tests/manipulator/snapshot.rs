//! Another manipulator that takes up a snapshot answers bit for bit as the first one goes on to.

use mcm::magnetics::{AxialMagnet, Cylinders, Sources};
use mcm::manipulator::{Inputs, Manipulator, Outputs, Scene, Status};

use crate::given::cylinder;
use crate::tolerance::EFFECT;

/// Designs and levels, with loads that need every part of a snapshot: ring rules, the unsymmetric matrix of a dead
/// moment, forces without reaction.
const SCENES: [&str; 6] = [
    "[design]\nsegments = 3\n[magnet]\n[model]\ninteraction = \"none\"",
    "[design]\nsegments = 3\n[magnet]\n[model]\ninteraction = \"rings\"",
    "[design]\nsegments = 2\n[magnet]\n[model]\ninteraction = \"full\"",
    "[design]\nsegments = 2\n[magnet]\n[load]\ntip_moment_nm = [1e-6, 2e-6, 0.0]\n[model]\ninteraction = \"preceding\"",
    BENT,
    "[design]\nkind = \"cylinder\"\nlength_mm = 20.0\nradius_mm = 1.0\nshore_a = 33.0\n[magnet]",
];

/// Bent so much that a finer discretisation answers.
const BENT: &str = "[design]\nsegments = 2\n[design.helix]\nlength_mm = 5.5\n[magnet]\norientation_wxyz = [0, 1, 0, 0]\n\
                    position_mm = [0.0, -64.0, 9.0]\n[model]\ninteraction = \"rings\"";

fn started(text: &str) -> (Scene, Manipulator) {
    let scene = Scene::parse(text, "test scene").unwrap();
    let manipulator = scene.manipulator(5).unwrap();
    (scene, manipulator)
}

/// The magnet passes.
fn at(scene: &Scene, step: usize) -> Inputs {
    let mut inputs = scene.inputs.clone();
    inputs.sources[0].pose.position.x += 1e-3 * step as f64;
    inputs.sources[0].pose.position.z += 7e-4 * (step as f64).sin();
    inputs
}

#[test]
fn a_snapshot_goes_on_bit_for_bit() {
    for text in SCENES {
        let (scene, mut first) = started(text);
        let (_, mut second) = started(text);
        second.restore(&first.snapshot()).unwrap();
        for step in 0..12 {
            let inputs = at(&scene, step);
            let expected = first.solve(&inputs).unwrap().clone();
            assert_eq!(expected.status, Status::Solved, "{text}");
            assert_eq!(second.solve(&inputs).unwrap(), &expected, "{text}");
            if step % 3 == 2 {
                // What is read in between leaves no trace.
                first.measure_margin();
                first.jacobian().unwrap();
                let snapshot = first.snapshot();
                (_, second) = started(text);
                second.restore(&snapshot).unwrap();
                assert_eq!(second.snapshot(), snapshot, "{text}");
                assert_eq!(second.outputs(), first.outputs(), "{text}");
                assert_eq!(second.jacobian().unwrap(), first.jacobian().unwrap(), "{text}");
            }
        }
        assert!((first.outputs().tip_angle - started(text).1.outputs().tip_angle).abs() > EFFECT, "{text}");
    }
}

#[test]
fn a_snapshot_of_another_design_is_refused() {
    for (one, other) in [(0, 2), (0, 5), (5, 1)] {
        let (scene, mut first) = started(SCENES[one]);
        let (other_scene, mut second) = started(SCENES[other]);
        first.solve(&scene.inputs).unwrap();
        second.solve(&other_scene.inputs).unwrap();
        assert!(second.restore(&first.snapshot()).is_err());
        assert!(second.jacobian().is_err(), "reset");
        assert_eq!(second.outputs(), started(SCENES[other]).1.outputs());
        assert_eq!(second.solve(&other_scene.inputs).unwrap().status, Status::Solved);
    }
}

#[test]
fn a_snapshot_of_another_material_magnet_or_discretisation_is_refused() {
    let own = "[design]\nsegments = 1\n[magnet]\nposition_mm = [0, -90, 3]\n[model]\ninteraction = \"rings\"";
    let scene = Scene::parse(own, "own").unwrap();
    let mut first = scene.manipulator(3).unwrap();
    first.solve(&scene.inputs).unwrap();
    let mut same = scene.manipulator(3).unwrap();
    assert!(same.restore(&first.snapshot()).is_ok());
    for change in [
        "[design.helix]\nshore_a = 33.5",
        "[design.ring]\nremanence_t = 1.3",
        "[design.helix]\nradius_mm = 1.99",
    ] {
        let other = Scene::parse(&format!("{own}\n{change}"), change).unwrap();
        assert!(other.manipulator(3).unwrap().restore(&first.snapshot()).is_err(), "{change}");
    }
    let mut stronger = scene.clone();
    let cylinder = |offset| AxialMagnet { offset, remanence: 1.36, ..cylinder() };
    let magnet = Cylinders::new(vec![cylinder(-20e-3), cylinder(20e-3)]).unwrap();
    stronger.sources = Sources::new(vec![magnet.into()]).unwrap();
    assert_ne!(stronger.sources, scene.sources);
    assert!(stronger.manipulator(3).unwrap().restore(&first.snapshot()).is_err(), "another magnet");
    let mut finer = scene.clone();
    finer.settings.degree += 1;
    assert!(finer.manipulator(3).unwrap().restore(&first.snapshot()).is_err(), "another discretisation");
}

#[test]
fn a_snapshot_of_another_vessel_is_refused() {
    let own =
        "[design]\nsegments = 1\n[field]\nuniform_mt = [0.0, 12.0, 0.0]\n[model]\ninteraction = \"rings\"\n";
    let tube = |radius: f64, modulus: f64| {
        format!(
            "{own}[vessel]\nwall_modulus_mpa = {modulus}\n[[vessel.branch]]\nname = \"tube\"\n\
             points_mm = [[0, 0, -20], [0, 0, 40]]\nradius_mm = {radius}\n"
        )
    };
    let (scene, mut first) = started(&tube(2.5, 1.0));
    first.solve(&scene.inputs).unwrap();
    let snapshot = first.snapshot();
    let (_, mut same) = started(&tube(2.5, 1.0).replace("name = \"tube\"", "name = \"another name\""));
    same.restore(&snapshot).unwrap();
    assert_eq!(same.outputs(), first.outputs());
    for other in [own.to_owned(), tube(2.500_001, 1.0), tube(2.5, 1.001)] {
        let refused = started(&other).1.restore(&snapshot).unwrap_err().to_string();
        assert!(refused.contains("not of this design, magnet and vessel"), "{other}: {refused}");
    }
    let (_, mut free) = started(own);
    free.solve(&scene.inputs).unwrap();
    assert!(first.restore(&free.snapshot()).is_err());
}

#[test]
fn a_path_ends_where_its_points_lead() {
    let (scene, mut by_points) = started(SCENES[1]);
    let (_, mut by_path) = started(SCENES[1]);
    let path: Vec<Inputs> = (0..6).map(|step| at(&scene, step)).collect();
    let iterations: u32 = path.iter().map(|inputs| by_points.solve(inputs).unwrap().iterations).sum();
    let followed = by_path.follow(&path, 0).unwrap();
    assert_eq!(followed.iterations, iterations);
    assert_eq!(followed.tip, by_points.outputs().tip);
    // A path into the magnet is refused as a whole.
    let before = by_path.clone();
    let mut into = path[0].clone();
    into.sources[0].pose.position = nalgebra::Vector3::new(0.0, 0.0, 0.012);
    let failed = by_path.follow(&[path[2].clone(), into, path[3].clone()], 0).unwrap();
    assert_eq!(failed.status, Status::NotSolved);
    assert_eq!(failed.tip, before.outputs().tip);
    assert_eq!(by_path.snapshot(), by_path.snapshot());
    let mut again = before;
    assert_eq!(by_path.solve(&path[2]).unwrap(), again.solve(&path[2]).unwrap());
}

#[test]
fn many_inputs_at_once_are_answered_as_by_one_clone_after_the_other() {
    for (text, solved) in [(SCENES[1], false), (SCENES[2], true)] {
        let (scene, mut manipulator) = started(text);
        if solved {
            manipulator.solve(&scene.inputs).unwrap();
        }
        let before = manipulator.snapshot();
        let mut inputs: Vec<Inputs> = (0..12).map(|step| at(&scene, step)).collect();
        let one_by_one: Vec<Outputs> =
            inputs.iter().map(|inputs| manipulator.clone().solve(inputs).unwrap().clone()).collect();
        assert_eq!(manipulator.solve_many(&inputs).unwrap(), one_by_one);
        assert_eq!(manipulator.snapshot(), before);
        inputs[7].gravity.x = f64::NAN;
        let refused = manipulator.solve_many(&inputs).unwrap_err().to_string();
        assert!(refused.contains("gravity"), "{refused}");
    }
}

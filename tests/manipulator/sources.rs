//! Several magnets, and coils.

use mcm::design::{Design, Specification};
use mcm::equilibrium::{Interaction, Settings};
use mcm::geometry::Pose;
use mcm::magnetics::{AxialMagnet, Coil, Cylinders, Solenoid, Source, Sources};
use mcm::manipulator::{Inputs, Manipulator, Outcome, PlacedSource, SceneFile, Status};
use nalgebra::Vector3;

use crate::given::{cylinder, pair};
use crate::tolerance::PAIRS;

const COIL: Coil = Coil { inner_radius: 20e-3, outer_radius: 40e-3, length: 60e-3, turns: 600.0 };

fn coil(dimensions: Coil) -> Source {
    Solenoid::new(dimensions).unwrap().into()
}

fn beside() -> Inputs {
    let magnet = Pose::new([0.01, -0.09, 0.02], [0.36, 0.8, 0.0, 0.48]).unwrap();
    Inputs { sources: vec![PlacedSource { pose: magnet, strength: 0.8 }], ..Inputs::unloaded(4) }
}

fn device(sources: impl Into<Sources>) -> Manipulator {
    let design = Design::new(Specification::paper(3)).unwrap();
    let settings = Settings {
        interaction: Interaction::Rings,
        pair_accuracy: PAIRS,
        tolerance: 1e-13,
        ..Settings::default()
    };
    Manipulator::new(&design, sources, settings, 5).unwrap()
}

fn close(a: &Vector3<f64>, b: &Vector3<f64>, tolerance: f64) {
    assert!((a - b).norm() <= tolerance * b.norm(), "{a} {b}");
}

#[test]
fn two_magnets_act_as_the_pair_that_they_make() {
    let inputs = beside();
    let mut whole = device(Some(&pair()));
    let whole = whole.solve(&inputs).unwrap();
    let lone =
        |offset: f64| Source::from(Cylinders::new(vec![AxialMagnet { offset, ..cylinder() }]).unwrap());
    let sources = Sources::new(vec![lone(-20e-3), lone(0.0)]).unwrap();
    let pose = inputs.sources[0].pose.advanced(20e-3);
    let second = PlacedSource { pose, strength: 0.8 };
    let apart = Inputs { sources: vec![inputs.sources[0], second], ..inputs.clone() };
    let mut parts = device(&sources);
    let parts = parts.solve(&apart).unwrap();
    close(&parts.tip.position, &whole.tip.position, 1e-9);
    close(&parts.magnetic_force, &whole.magnetic_force, 1e-9);
    close(&parts.tip_field, &whole.tip_field, 1e-12);
    let second = &parts.reactions[1];
    close(&(parts.reactions[0].force + second.force), &whole.reactions[0].force, 1e-9);
    let arm = pose.position - inputs.sources[0].pose.position;
    let torque = parts.reactions[0].torque + second.torque + arm.cross(&second.force);
    close(&torque, &whole.reactions[0].torque, 1e-9);
    assert!(parts.tip_angle.to_degrees() > 5.0);
}

#[test]
fn action_is_reaction_for_every_source() {
    let sources = Sources::new(vec![pair(), pair(), coil(COIL)]).unwrap();
    let placed = |position, orientation, strength| PlacedSource {
        pose: Pose::new(position, orientation).unwrap(),
        strength,
    };
    let places = vec![
        beside().sources[0],
        placed([-0.1, 0.08, 0.02], [0.36, 0.8, 0.0, 0.48], -0.5),
        placed([0.02, 0.1, -0.04], [0.6, 0.8, 0.0, 0.0], 8.0),
    ];
    let inputs = Inputs { sources: places, ..beside() };
    let mut device = device(&sources);
    let out = device.solve(&inputs).unwrap();
    let base = inputs.base.position;
    let (mut force, mut torque) = (out.magnetic_force, out.magnetic_torque);
    let all = inputs.sources.iter().zip(&out.reactions);
    for (place, own_force, own_torque) in
        all.map(|(source, reaction)| (source.pose.position, reaction.force, reaction.torque))
    {
        assert!(own_force.norm() > 1e-5, "{own_force}");
        force += own_force;
        torque += own_torque + (place - base).cross(&own_force);
    }
    assert!(force.norm() < 1e-12 && torque.norm() < 1e-12, "{force} {torque}");
    close(&out.base_reaction_force, &-out.magnetic_force, 1e-6);
}

#[test]
fn the_state_of_several_sources_can_be_saved() {
    let sources = Sources::new(vec![coil(COIL)]).unwrap();
    let pose = Pose::new([0.0, 0.07, 0.01], [0.6, 0.8, 0.0, 0.0]).unwrap();
    let inputs = |strength| Inputs { sources: vec![PlacedSource { pose, strength }], ..Inputs::unloaded(4) };
    let mut first = device(&sources);
    first.solve(&inputs(3.0)).unwrap();
    let mut second = device(&sources);
    second.restore(&first.snapshot()).unwrap();
    assert_eq!(first.solve(&inputs(4.0)).unwrap(), second.solve(&inputs(4.0)).unwrap());
    let other = Sources::new(vec![coil(Coil { turns: 601.0, ..COIL })]).unwrap();
    assert!(device(&other).restore(&first.snapshot()).is_err());
}

#[test]
fn sources_that_overlap_are_refused_wherever_they_move() {
    let sources = Sources::new(vec![pair(), pair()]).unwrap();
    let mut device = device(&sources);
    let at = |x: f64| {
        let pose = Pose { position: Vector3::new(x, -0.09, 0.02), ..beside().sources[0].pose };
        Inputs { sources: vec![beside().sources[0], PlacedSource { pose, strength: 1.0 }], ..beside() }
    };
    assert_eq!(device.solve(&at(0.2)).unwrap().status, Status::Solved);
    let message = device.solve(&at(0.02)).unwrap_err().to_string();
    assert!(message.starts_with("the external magnet and magnet 2 overlap by "), "{message}");
    let mut off = at(0.02);
    off.sources[1].strength = 0.0;
    assert_eq!(device.solve(&off).unwrap().status, Status::Solved, "as if it were not there");
    assert!(device.solve(&at(0.02)).is_err(), "switched on");
    assert_eq!(device.solve(&at(0.2)).unwrap().status, Status::Solved);
    let message = device.solve(&beside()).unwrap_err().to_string();
    assert!(message.contains("one for each magnet and coil"), "{message}");
}

#[test]
fn a_device_passes_through_the_bore_of_a_coil_and_touches_its_winding() {
    let sources = Sources::new(vec![coil(COIL)]).unwrap();
    let mut device = device(&sources);
    let around = |x: f64, strength| {
        let pose = Pose { position: Vector3::new(x, 0.0, 0.01), ..Pose::identity() };
        Inputs { sources: vec![PlacedSource { pose, strength }], ..Inputs::unloaded(4) }
    };
    assert_eq!(device.solve(&around(0.0, 2.0)).unwrap().status, Status::Solved);
    device.reset();
    for current in [2.0, 0.0] {
        let out = device.solve(&around(0.03, current)).unwrap();
        let Outcome::Contact(contact) = out.outcome else { panic!("{:?}", out.outcome) };
        assert!(contact.to_string().ends_with("coil 1"), "{contact}");
    }
}

const SCENE: &str = "[design]
segments = 1
[[magnet]]
[[magnet]]
position_mm = [150.0, 0.0, 0.0]
cylinders = [{ radius_mm = 10.0, length_mm = 10.0, remanence_t = 1.2 }]
[[coil]]
position_mm = [0.0, 80.0, 0.0]
inner_radius_mm = 20.0
outer_radius_mm = 40.0
length_mm = 60.0
turns = 600
current_a = 1.5
";

fn same(got: f64, expected: f64) {
    assert_eq!(got.to_bits(), expected.to_bits(), "{got}");
}

#[test]
fn a_scene_names_them() {
    let file = SceneFile::parse(SCENE, "scene").unwrap();
    let scene = file.scene().unwrap();
    assert_eq!(scene.sources.list().len(), 3);
    same(scene.inputs.sources[2].strength, 1.5);
    let again = SceneFile::parse(&file.to_toml().unwrap(), "again").unwrap();
    assert_eq!(again, file);
    let at = |key: &str, value: f64| file.with(key, value).unwrap().scene().unwrap().inputs;
    same(at("coil[1].current_a", 2.0).sources[2].strength, 2.0);
    same(at("magnet[2].position_mm[2]", 30.0).sources[1].pose.position.y, 0.03);
    same(at("magnet.strength", 0.5).sources[0].strength, 0.5);
    same(at("magnet[1].position_mm[1]", 7.0).sources[0].pose.position.x, 0.007);
}

#[test]
fn faults_of_a_scene_are_told_where_they_are() {
    let told = |from: &str, to: &str| {
        assert!(SCENE.contains(from));
        SceneFile::parse(&SCENE.replace(from, to), "scene").unwrap_err().to_string()
    };
    assert_eq!(
        told("turns = 600", "turns = 0"),
        "scene, line 12: coil[1].turns = 0 is not allowed: it must be > 0 and <= 1e6"
    );
    assert_eq!(
        told("turns = 600", "turnes = 600\nturns = 600"),
        "scene, line 12: unknown key `coil[1].turnes`; did you mean `turns`?"
    );
    let message = told("radius_mm = 10.0, length", "radius_mm = -1.0, length");
    assert!(message.contains("line 6: magnet[2].cylinders[1].radius_mm = -1 "), "{message}");
    let message = told("position_mm = [150.0, 0.0, 0.0]\n", "");
    assert!(message.contains("magnet[2].position_mm is missing"), "{message}");
    let message = told("position_mm = [0.0, 80.0, 0.0]", "position_mm = [175.0, 0.0, 0.0]");
    assert!(message.contains("magnet 2 and coil 1 overlap by"), "{message}");
}

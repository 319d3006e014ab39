//! A manipulator that reaches into the external magnet, and how deep.

use core::f64::consts::TAU;

use mcm::design::{Design, Specification};
use mcm::equilibrium::{
    Body, Contact, Equilibrium, Inputs, Interaction, Outcome, PlacedSource, Settings, Solution,
};
use mcm::geometry::Pose;
use mcm::magnetics::{AxialMagnet, Cylinders, Outline, Part, Source};
use mcm::manipulator::{Followed, Manipulator, Scene, Status};
use mcm::methods::{self, Compared, Device, Method};
use nalgebra::{Rotation3, Vector3};

use crate::tolerance::{CONTACT_DEPTH, SAME_SHAPE};

/// Outer radius and length of a ring, m.
const RADIUS: f64 = 2e-3;
const RING: f64 = 1e-3;

/// Points around a section.
const AROUND: u32 = 2000;

/// How deep the deepest point of a circle lies below the surface of one of the cylinders, negative outside.
fn circle_in(parts: &[Part], at: &Pose, centre: &Pose) -> f64 {
    let depth = |point: Vector3<f64>| {
        let local = at.rotation.transpose() * (point - at.position);
        let rho = local.x.hypot(local.y);
        let in_one = |part: &Part| {
            let Outline::Cylinder(outline) = &part.outline else { panic!("a cylinder") };
            let inner = outline.inner_radius();
            let bore = if inner > 0.0 { rho - inner } else { f64::INFINITY };
            let along = 0.5 * outline.length() - (local.z - part.centre.z).abs();
            (outline.outer_radius() - rho).min(along).min(bore)
        };
        parts.iter().map(in_one).fold(f64::NEG_INFINITY, f64::max)
    };
    let point = |k: u32| {
        let (sine, cosine) = (TAU * f64::from(k) / f64::from(AROUND)).sin_cos();
        centre.transform(&(Vector3::new(cosine, sine, 0.0) * RADIUS))
    };
    (0..AROUND).map(point).map(depth).fold(f64::NEG_INFINITY, f64::max)
}

/// The deepest ring and its depth.
fn deepest_ring(parts: &[Part], at: &Pose, rings: impl Iterator<Item = Pose>) -> (usize, f64) {
    let height = |i: u32| RING * (f64::from(i) / 100.0 - 0.5);
    let depth = |centre: &Pose| {
        (0..=100).map(|i| circle_in(parts, at, &centre.advanced(height(i)))).fold(f64::NEG_INFINITY, f64::max)
    };
    let mut found: Vec<(usize, f64)> =
        rings.enumerate().map(|(number, centre)| (number, depth(&centre))).collect();
    found.sort_by(|a, b| a.1.total_cmp(&b.1));
    found[found.len() - 1]
}

fn beside(z: f64, strength: f64) -> Scene {
    let text = format!(
        "[design]\nsegments = 9\n[model]\ninteraction = \"none\"\n[magnet]\nposition_mm = [0.0, -40.0, {z:?}]\nstrength = {strength:?}"
    );
    Scene::parse(&text, "beside the magnet").unwrap()
}

/// Newton's method on the potential itself, which knows no bodies as long as no point of its quadrature is inside.
fn without_bodies(equilibrium: &mut Equilibrium, inputs: &Inputs, shape: &mut [f64]) {
    for _ in 0..60 {
        let (_, gradient) = equilibrium.gradient(inputs, shape).expect("no point inside");
        let downhill: Vec<f64> = gradient.iter().map(|g| -g).collect();
        let step = equilibrium.solve_at(inputs, shape, 0.0, &downhill).expect("stable");
        shape.iter_mut().zip(&step).for_each(|(x, s)| *x += s);
        if step.iter().all(|s| s.abs() < SAME_SHAPE) {
            return;
        }
    }
    panic!("no equilibrium");
}

#[test]
fn a_tip_that_is_pulled_into_the_magnet_is_told_with_its_depth() {
    let scene = beside(23.0, 1.0);
    let parts = scene.sources.list()[0].parts();
    let design = scene.design().unwrap();
    let mut equilibrium = Equilibrium::new(&design, scene.sources.magnet(), scene.settings, 2).unwrap();
    let pose = scene.inputs.sources[0].pose;
    let at = |strength| Inputs { sources: vec![PlacedSource { pose, strength }], ..scene.inputs.clone() };
    let (mut shape, mut told, mut deep) = (vec![0.0; equilibrium.freedoms()], 0, Vec::new());
    for step in 1..=215 {
        let strength = 1e-3 * f64::from(step);
        let inputs = at(strength);
        let before = equilibrium.unknowns().to_vec();
        let report = equilibrium.solve(&inputs).unwrap();
        if report.solved() {
            shape.copy_from_slice(equilibrium.unknowns());
        } else {
            assert_eq!(equilibrium.unknowns(), before, "the last good shape is kept");
            without_bodies(&mut equilibrium, &inputs, &mut shape);
        }
        if step % 5 != 0 || step < 100 {
            continue;
        }
        equilibrium.gradient(&inputs, &shape).unwrap(); // places the rings
        let (ring, depth) = deepest_ring(parts, &pose, equilibrium.rings());
        println!("strength {strength}: {:?}, ring {ring} {depth:e} m", report.outcome);
        match report.outcome {
            Outcome::Contact(Contact { first, second: Body::Source(..), depth: found }) => {
                assert!((found - depth).abs() <= CONTACT_DEPTH, "{strength}: {found} m, by points {depth} m");
                assert_eq!(first, Body::Ring(ring));
                told += 1;
                deep.push(depth);
            }
            outcome => assert!(
                outcome == Outcome::Solved && depth <= CONTACT_DEPTH,
                "{strength}: {outcome:?}, {depth}"
            ),
        }
    }
    assert!(told >= 13, "{told} contacts told: {deep:?}");
}

/// A magnet too weak to be felt, wherever it is.
fn unfelt(cylinder: AxialMagnet) -> Source {
    Cylinders::new(vec![cylinder]).unwrap().into()
}

fn manipulator(magnet: Option<&Source>, interaction: Interaction, points: usize) -> Manipulator {
    let design = Design::new(Specification::paper(3)).unwrap();
    Manipulator::new(&design, magnet, Settings { interaction, ..Settings::default() }, points).unwrap()
}

#[test]
fn a_bent_segment_beside_a_magnet_is_as_deep_as_its_points_say() {
    // In a uniform field nothing shears or stretches, so that sections are across the centreline.
    let bent = Inputs { uniform_field: Vector3::new(0.0, 0.03, 0.0), ..Inputs::unloaded(4) };
    let points = 8001;
    let mut free = manipulator(None, Interaction::None, points);
    let shape = free.solve(&bent).unwrap().clone();
    let axis = Vector3::new(1.0, 0.3, 0.2).normalize();
    let rod = AxialMagnet { radius: 1e-3, inner_radius: 0.0, length: 30e-3, offset: 0.0, remanence: 1.0 };
    for (middle, clearance) in [(0.5, 2.9e-3), (0.5, 2.5e-3), (0.82, 2.7e-3), (0.2, 2.95e-3)] {
        // Beside the middle of a segment, on its outer side, along a slanted axis.
        let near = (f64::from(points as u32 - 1) * middle) as usize;
        let tangent = (shape.shape[near + 1] - shape.shape[near - 1]).normalize();
        let side = Vector3::x().cross(&tangent);
        let rotation = Rotation3::rotation_between(&Vector3::z(), &axis).unwrap().into_inner();
        let magnet = Pose { position: shape.shape[near] - side * clearance, rotation };
        let mut manipulator = manipulator(Some(&unfelt(rod)), Interaction::None, 2);
        let inputs = Inputs { sources: vec![PlacedSource { pose: magnet, strength: 1e-12 }], ..bent.clone() };
        let outputs = manipulator.solve(&inputs).unwrap();
        let sections = (1..points - 1).map(|i| {
            let tangent = (shape.shape[i + 1] - shape.shape[i - 1]).normalize();
            let rotation = Rotation3::rotation_between(&Vector3::z(), &tangent).unwrap().into_inner();
            Pose { position: shape.shape[i], rotation }
        });
        let depth = sections
            .map(|pose| circle_in(unfelt(rod).parts(), &magnet, &pose))
            .fold(f64::NEG_INFINITY, f64::max);
        println!("{middle}, {clearance}: {:?}, by points {depth:e} m", outputs.outcome);
        let Outcome::Contact(contact) = outputs.outcome else { panic!("{middle}: {:?}", outputs.outcome) };
        assert_eq!(outputs.status, Status::NotSolved);
        assert!((contact.depth - depth).abs() <= CONTACT_DEPTH, "{contact:?}, by points {depth:e} m");
        let off = Inputs { sources: vec![PlacedSource { pose: magnet, strength: 0.0 }], ..inputs };
        assert_eq!(
            manipulator.solve(&off).unwrap().status,
            Status::Solved,
            "what is switched off is not there"
        );
    }
}

#[test]
fn a_bore_has_room_for_the_manipulator_and_its_wall_has_not() {
    let tube = AxialMagnet { radius: 20e-3, inner_radius: 3e-3, length: 60e-3, offset: 0.0, remanence: 1.0 };
    for (interaction, method) in [
        (Interaction::None, Method::Potential),
        (Interaction::Rings, Method::Potential),
        (Interaction::None, Method::ShootingExact),
    ] {
        let design = Design::new(Specification::paper(3)).unwrap();
        let (magnet, settings) = (unfelt(tube), Settings { interaction, ..Settings::default() });
        let mut manipulator = if method == Method::Potential {
            Device::Potential(Box::new(Manipulator::new(&design, Some(&magnet), settings, 2).unwrap()))
        } else {
            let solver = methods::Settings { method, ..Default::default() };
            Device::Compared(Box::new(Compared::new(&design, Some(&magnet), settings, solver, 2).unwrap()))
        };
        for (aside, expected) in [(0.0, 0.0), (0.9e-3, 0.0), (1.1e-3, 0.1e-3), (1.5e-3, 0.5e-3)] {
            let magnet = Pose { position: Vector3::new(aside, 0.0, 8e-3), ..Pose::identity() };
            let inputs = Inputs {
                sources: vec![PlacedSource { pose: magnet, strength: 1e-12 }],
                ..Inputs::unloaded(4)
            };
            let outcome = manipulator.solve(&inputs).unwrap().outcome;
            if let Outcome::Contact(contact) = outcome {
                assert!(
                    (contact.depth - expected).abs() <= CONTACT_DEPTH,
                    "{interaction:?}, {aside}: {contact:?}"
                );
            } else {
                assert!(
                    outcome == Outcome::Solved && expected == 0.0,
                    "{interaction:?}, {aside}: {outcome:?}"
                );
            }
        }
    }
}

#[test]
fn rings_that_are_pulled_shut_are_named() {
    // The attraction of rings and helix pulls one segment shut at 35.83 mT.
    let text = "[design]\nsegments = 1\n[model]\ninteraction = \"full\"\n[field]\nuniform_mt = [0, 60, 0]";
    let scene = Scene::parse(text, "shut").unwrap();
    let outcome = scene.manipulator(2).unwrap().solve(&scene.inputs).unwrap().outcome;
    println!("{outcome}");
    assert!(!outcome.is_solved());
}

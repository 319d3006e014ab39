//! Contact with the wall: laws, derivatives and symmetries.

use mcm::equilibrium::{Equilibrium, Inputs, Outcome, Solution};
use mcm::manipulator::{Input, Output, Scene};
use mcm::vessel::{Branch, Lumen, Vessel, Wall};
use nalgebra::{Matrix3, Vector3};

use super::into_the_wall;
use crate::differences::{Direction, assert_derivatives, derivative};
use crate::tolerance::{CONTACT_INSERTION, CONTACT_RATE, CONTACT_SLOPE, WALL_BALANCE, WALL_MOVED};

/// Hertz for a ball of 2 mm in a silicone of 1.7e6 Pa.
#[test]
fn a_ball_sinks_in_as_in_hertz() {
    let wall = Wall::new(1.7e6).expect("allowed");
    for (force, depth) in [(0.01, 18e-6), (0.09, 76e-6), (0.146, 105e-6)] {
        let [_, told, _] = wall.ball(2e-3, depth);
        assert!((told / force - 1.0).abs() < 0.04, "{told} {force}");
    }
    // An arc in line contact with a parabolic gap gives the same law.
    let (radius, deepest) = (0.03_f64, 20e-6);
    let half: f64 = (2.0 * radius * deepest).sqrt();
    let count = 20_000;
    let depth = |i: i32| {
        deepest
            - (half * (2.0 * f64::from(i) + 1.0 - f64::from(count)) / f64::from(count)).powi(2)
                / (2.0 * radius)
    };
    let sum: f64 = (0..count).map(|i| wall.line(depth(i))[1] * 2.0 * half / f64::from(count)).sum();
    let [_, ball, _] = wall.ball(radius, deepest);
    assert!((sum / ball - 1.0).abs() < 0.02, "{sum} {ball}");
}

/// Multiple of the elastic stiffness that makes the Hessian away from equilibrium definite.
const SHIFT: f64 = 100.0;

const SEGMENTS: &str = "[field]\nuniform_mt = [-3.0, 3.0, 0.0]\n\
    [gravity]\nacceleration_m_s2 = [0.0, -9.81, 0.0]\n[load]\ntip_force_n = [0.001, 0.0, -0.002]\n\
    [model]\ninteraction = \"rings\"\ntime_budget_s = 60.0\n[vessel]\n[[vessel.branch]]\nname = \"arc\"\n";

const SHAFT: &str = "[feed]\nmode = \"insertion\"\ninsertion_mm = 15.0\n[feed.shaft]\nouter_radius_mm = 0.75\n\
    inner_radius_mm = 0.25\nshore_a = 40.0\npoisson = 0.45\n";

/// Three segments in a bent vessel, in which they touch the wall with rings and windings.
fn segments() -> Scene {
    segments_with("")
}

/// Three segments in a bent vessel, with these entries of the design.
fn segments_with(entries: &str) -> Scene {
    segments_of(&format!("{entries}{SEGMENTS}"))
}

/// Three segments with these tables, of which the last begins with the branch.
fn segments_of(tables: &str) -> Scene {
    let points: Vec<String> = (-10..=40)
        .map(|i| {
            let angle = f64::from(i) * 0.02;
            format!(
                "[{:.9}, {:.9}, {:.9}]",
                50.0 * (1.0 - angle.cos()),
                -20.0 * (1.0 - angle.cos()),
                50.0 * angle.sin()
            )
        })
        .collect();
    let text =
        format!("[design]\nsegments = 3\n{tables}points_mm = [{}]\nradius_mm = 2.2\n", points.join(", "));
    Scene::parse(&text, "segments").expect("a scene")
}

fn solved(scene: &Scene) -> Equilibrium {
    first_shape(free(scene).in_vessel(scene.vessel.as_ref().expect("a vessel")), scene)
}

/// The unsolved device of a scene without its vessel.
fn free(scene: &Scene) -> Equilibrium {
    let settings = scene.settings.as_discretised();
    Equilibrium::new(&scene.design().expect("allowed"), None, settings, 11).expect("allowed")
}

fn first_shape(mut model: Equilibrium, scene: &Scene) -> Equilibrium {
    let report = model.solve(&scene.inputs).expect("finite");
    assert!(report.solved() && report.stable == Some(true), "{report:?}");
    model
}

#[test]
fn all_forces_balance() {
    let scene = segments();
    let model = solved(&scene);
    let wall = model.wall().expect("a vessel");
    assert!(wall.count >= 1 && wall.sum > 1e-3, "{wall:?}");
    let weight = scene.inputs.gravity * scene.design().expect("allowed").mass();
    let total = model.base_reaction().force
        + wall.force
        + model.magnetic_wrench().force
        + weight
        + scene.inputs.tip_force;
    assert!(total.norm() < WALL_BALANCE * wall.sum, "{total} of {}", wall.sum);
}

#[test]
fn gradient_and_hessian_agree_with_differences() {
    let scene = segments();
    let mut model = solved(&scene);
    let direction = into_the_wall(&model, 2e-4, [CONTACT_SLOPE, CONTACT_RATE]);
    let direction = Direction { shift: SHIFT, ..direction };
    assert_derivatives("in contact", &mut model, &scene.inputs, &direction);
}

#[test]
fn jacobian_in_contact_agrees_with_solves_beside() {
    let scene = segments();
    let model = solved(&scene);
    let jacobian = model.jacobian().expect("regular");
    for (input, axis, step) in [
        (Input::BasePosition, 0, 1e-6),
        (Input::BasePosition, 2, 1e-6),
        (Input::UniformField, 1, 1e-6),
        (Input::TipForce, 0, 1e-7),
        (Input::Roll, 0, 1e-5),
    ] {
        let at = |by: f64| {
            let mut inputs = scene.inputs.clone();
            match input {
                Input::BasePosition => inputs.base.position[axis] += by,
                Input::UniformField => inputs.uniform_field[axis] += by,
                Input::Roll => inputs.roll += by,
                _ => inputs.tip_force[axis] += by,
            }
            let mut beside = model.clone();
            assert!(beside.solve(&inputs).expect("finite").solved());
            (beside.tip().position, beside.base_reaction().force)
        };
        let (plus, minus) = (at(step), at(-step));
        for (output, slope) in [
            (Output::TipPosition, (plus.0 - minus.0) / (2.0 * step)),
            (Output::BaseReactionForce, (plus.1 - minus.1) / (2.0 * step)),
        ] {
            let told = jacobian.block(output, input).expect("exists").column(axis).into_owned();
            let apart = (Vector3::new(told[0], told[1], told[2]) - slope).norm();
            assert!(apart < 1e-4 * slope.norm().max(1e-3), "{output:?} by {input:?}: {told} {slope}");
        }
    }
}

/// All that is read of a shape.
fn read(model: &Equilibrium) -> String {
    let inputs = model.inputs().cloned().unwrap_or(Inputs::unloaded(4));
    let (shape, rings): (Vec<_>, Vec<_>) = (model.shape().collect(), model.rings().collect());
    let wrenches = [model.base_reaction(), model.magnetic_wrench(), model.source_reaction(0, &inputs)];
    let angles: Vec<_> = model.core_angles().collect();
    format!(
        "{:?}",
        (
            model.tip(),
            shape,
            rings,
            angles,
            wrenches,
            model.wall(),
            model.feed_reaction(&inputs),
            model.metric()
        )
    )
}

/// Without a vessel and in one, before the first shape and after it.
#[test]
fn a_failed_solve_keeps_all_that_is_read() {
    let scene = segments_of(&SEGMENTS.replace("[vessel]\n", &format!("{SHAFT}[vessel]\n")));
    let mut beyond = Inputs { insertion: scene.inputs.insertion + 3e-3, ..scene.inputs.clone() };
    beyond.tip_force.z = -500.0;
    let inside = || free(&scene).in_vessel(scene.vessel.as_ref().expect("a vessel"));
    for mut model in [free(&scene), inside(), first_shape(free(&scene), &scene), solved(&scene)] {
        let before = read(&model);
        let report = model.solve(&beyond).expect("finite");
        assert!(!report.solved(), "{report:?}");
        println!("{report:?}");
        let after = read(&model);
        // Where the budget ends, the last equilibrium on the way is kept.
        assert!(
            matches!(report.outcome, Outcome::OutOfBudget(_)) || after == before,
            "{report:?}\n{before}\n{after}"
        );
        let mut again = model.clone();
        again.restore(&model.snapshot()).expect("its own");
        assert!(after == read(&again), "{report:?}\n{after}\n{}", read(&again));
    }
}

/// The segments on a shaft that is pushed in, on walls from soft to stiff, beside fourth-order differences of whole solves.
#[test]
fn derivatives_by_the_inserted_length_agree_with_solves_beside() {
    for modulus in [1.0, 30.0, 1000.0] {
        let tables = format!("{SHAFT}[vessel]\nwall_modulus_mpa = {modulus}\n");
        let scene = segments_of(&SEGMENTS.replace("[vessel]\n", &tables));
        let model = solved(&scene);
        let jacobian = model.jacobian().expect("regular");
        let at = |by: f64| {
            let inputs = Inputs { insertion: scene.inputs.insertion + by, ..scene.inputs.clone() };
            let mut beside = model.clone();
            assert!(beside.solve(&inputs).expect("finite").solved());
            let push = Vector3::x() * beside.feed_reaction(&inputs).expect("a shaft");
            Matrix3::from_columns(&[beside.tip().position, beside.base_reaction().force, push])
        };
        let slopes = derivative(1e-7, at);
        let outputs = [Output::TipPosition, Output::BaseReactionForce, Output::FeedReaction];
        for (index, output) in outputs.into_iter().enumerate() {
            let slope = slopes.column(index).into_owned();
            let told = jacobian.block(output, Input::Insertion).expect("exists");
            let told = Vector3::from_fn(|i, _| told.get((i, 0)).copied().unwrap_or_default());
            let apart = (told - slope).norm() / slope.norm();
            println!("{modulus} MPa, {output:?}: {apart:.1e} of {:.3e}", slope.norm());
            assert!(apart < CONTACT_INSERTION, "{modulus} MPa, {output:?}: {told} {slope}");
        }
    }
}

/// The shape turns and moves with its scene, vessel and all.
#[test]
fn a_moved_scene_has_the_same_answer() {
    let scene = segments();
    let model = solved(&scene);
    let turn = mcm::geometry::RotationVector::new(Vector3::new(0.4, -0.3, 0.8)).matrix();
    let shift = Vector3::new(0.02, -0.01, 0.05);
    let branch = &scene.vessel.as_ref().expect("a vessel").lumen.branches()[0];
    let count = 60;
    let balls = (0..=count).map(|i| branch.ball(branch.range().end() * f64::from(i) / f64::from(count)));
    let (points, radii): (Vec<_>, Vec<_>) = balls.map(|(c, r)| (turn * c + shift, r)).unzip();
    let moved_branch = Branch::new("arc", &points, &radii).expect("allowed");
    let still: Vec<_> = points.iter().map(|point| turn.transpose() * (point - shift)).collect();
    let wall = scene.vessel.as_ref().expect("a vessel").wall;
    let vessel = |branch| Vessel { lumen: Lumen::new(vec![branch]).expect("one"), wall };
    let mut first = scene.clone();
    first.vessel = Some(vessel(Branch::new("arc", &still, &radii).expect("allowed")));
    let first = solved(&first);
    let mut second = scene.clone();
    second.vessel = Some(vessel(moved_branch));
    let inputs = &mut second.inputs;
    inputs.base.position = turn * inputs.base.position + shift;
    inputs.base.rotation = turn * inputs.base.rotation;
    for vector in [&mut inputs.uniform_field, &mut inputs.gravity, &mut inputs.tip_force] {
        *vector = turn * *vector;
    }
    let second = solved(&second);
    let apart = (turn * first.tip().position + shift - second.tip().position).norm();
    assert!(apart < WALL_MOVED, "{apart}");
    assert!((model.tip().position - first.tip().position).norm() < 1e-7);
}

/// A scene in a mirror has the shape in that mirror. Fields and moments turn the other way round there; with every magnet
/// reversed they mirror as forces do.
#[test]
fn a_mirrored_scene_has_the_mirrored_answer() {
    let scene = segments_with("spiral = \"axisymmetric\"\n");
    let vessel = scene.vessel.as_ref().expect("a vessel").clone();
    let branch = &vessel.lumen.branches()[0];
    let across = Vector3::new(-1.0, 1.0, 1.0);
    let count = 60;
    let balls = (0..=count).map(|i| branch.ball(branch.range().end() * f64::from(i) / f64::from(count)));
    let (points, radii): (Vec<_>, Vec<_>) = balls.unzip();
    let made = |mirror: &Vector3<f64>| {
        let points: Vec<_> = points.iter().map(|point: &Vector3<f64>| point.component_mul(mirror)).collect();
        let branch = Branch::new("arc", &points, &radii).expect("allowed");
        let mut other = scene.clone();
        other.vessel = Some(Vessel { lumen: Lumen::new(vec![branch]).expect("one"), wall: vessel.wall });
        let inputs = &mut other.inputs;
        for vector in [&mut inputs.uniform_field, &mut inputs.gravity, &mut inputs.tip_force] {
            vector.component_mul_assign(mirror);
        }
        solved(&other)
    };
    let (first, second) = (made(&Vector3::repeat(1.0)), made(&across));
    let [one, other] = [&first, &second].map(|model| model.wall().expect("a vessel"));
    assert!(one.count >= 1 && one.force.x.abs() > 1e-4, "{one:?}");
    let apart = (first.tip().position.component_mul(&across) - second.tip().position).norm();
    assert!(apart < WALL_MOVED, "{apart}");
    assert!(
        (one.force.component_mul(&across) - other.force).norm() < WALL_BALANCE * one.sum,
        "{one:?} {other:?}"
    );
}

/// Without contact a vessel changes nothing.
#[test]
fn a_wide_vessel_changes_nothing() {
    let mut scene = segments();
    let branch = scene.vessel.as_ref().expect("a vessel").lumen.branches()[0].clone();
    let balls = (0..=20).map(|i| branch.ball(branch.range().end() * f64::from(i) / 20.0));
    let (points, radii): (Vec<_>, Vec<_>) = balls.map(|(c, r)| (c, 8.0 * r)).unzip();
    let wide = Branch::new("wide", &points, &radii).expect("allowed");
    let wall = scene.vessel.as_ref().expect("a vessel").wall;
    scene.vessel = Some(Vessel { lumen: Lumen::new(vec![wide]).expect("one"), wall });
    let inside = solved(&scene);
    let settings = scene.settings.as_discretised();
    let mut outside =
        Equilibrium::new(&scene.design().expect("allowed"), None, settings, 11).expect("allowed");
    assert!(outside.solve(&scene.inputs).expect("finite").solved());
    let apart =
        inside.unknowns().iter().zip(outside.unknowns()).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(apart < 1e-9, "{apart}");
    assert_eq!(inside.wall().expect("a vessel").count, 0);
}

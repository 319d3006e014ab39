//! Friction between device and wall: what it remembers, its balance and its derivatives.

use mcm::equilibrium::{Equilibrium, Inputs, Solution};
use mcm::manipulator::{Scene, Status};
use nalgebra::Vector3;
use toml::Value;

use super::friction::{normal, push, solve, to};
use super::into_the_wall;
use crate::differences::derivative;
use crate::tolerance::{FRICTION_DERIVATIVE, WALL_BALANCE};

const PRESSED: &str = "[design]\nsegments = 3\n[field]\nuniform_mt = [0.0, 3.0, 0.0]\n[feed]\nmode = \"insertion\"\n\
    insertion_mm = 4.0\n[feed.shaft]\nouter_radius_mm = 0.75\ninner_radius_mm = 0.25\nelastic_modulus_mpa = 1.0\npoisson = 0.45\n\
    [gravity]\nacceleration_m_s2 = [0.0, -9.81, 0.0]\n";

/// Three segments on a shaft, pressed against the wall of a tube by field and weight.
fn pressed(interaction: &str, friction: &str) -> Result<Scene, mcm::error::Error> {
    let text = format!(
        "{PRESSED}[model]\ninteraction = \"{interaction}\"\ntime_budget_s = 60.0\n[vessel]\nfriction = {friction}\n\
         [[vessel.branch]]\nname = \"tube\"\npoints_mm = [[0, 0, -20], [0, 0, 40], [0, 0, 100]]\nradius_mm = 3.0\n"
    );
    Scene::parse(&text, "pressed")
}

fn model(scene: &Scene) -> Equilibrium {
    let settings = scene.settings.as_discretised();
    let made = Equilibrium::new(&scene.design().expect("allowed"), None, settings, 11).expect("allowed");
    made.in_vessel(scene.vessel.as_ref().expect("a vessel"))
}

#[test]
fn all_forces_balance_with_friction() {
    let scene = pressed("rings", "0.4").expect("a scene");
    let mut model = model(&scene);
    for insertion in [0.004, 0.006, 0.0055] {
        solve(&mut model, &Inputs { insertion, ..scene.inputs.clone() });
    }
    let wall = model.wall().expect("a vessel");
    let pulled = wall.force.z.abs();
    assert!(pulled > 0.2 * wall.sum && pulled <= 0.4 * wall.sum * (1.0 + 1e-3), "{wall:?}");
    let design = scene.design().expect("allowed");
    let weight = scene.inputs.gravity * (design.mass() + design.shaft().expect("one").mass() * 0.0055);
    let total = model.base_reaction().force + wall.force + model.magnetic_wrench().force + weight;
    println!("balance: {:.1e} of {:.1e}", total.norm(), wall.sum);
    assert!(total.norm() < WALL_BALANCE * wall.sum, "{total} of {}", wall.sum);
    let rings: Vector3<f64> = wall.rings.iter().sum();
    assert!(rings.z.abs() > 0.0, "friction acts on rings: {wall:?}");
}

/// With the lumen widened, the wall no longer touches, but holds on with the normal forces of before: friction alone, partly sliding.
#[test]
fn gradient_and_hessian_of_friction_agree_with_differences() {
    let scene = pressed("rings", "0.4").expect("a scene");
    let mut model = model(&scene);
    for insertion in [0.004, 0.006, 0.005_995] {
        solve(&mut model, &Inputs { insertion, ..scene.inputs.clone() });
    }
    let inputs = Inputs { insertion: 0.005_995, widening: 1e-3, ..scene.inputs.clone() };
    let direction = into_the_wall(&model, 1e-4, [FRICTION_DERIVATIVE; 2]);
    let mut free = model.clone();
    free.set_friction(0.0).expect("allowed");

    // Energy of friction alone, and its slope.
    let mut along = |distance: f64| {
        let (energy, gradient) = model.gradient(&inputs, &direction.at(distance)).expect("inside");
        let (other, without) = free.gradient(&inputs, &direction.at(distance)).expect("inside");
        (energy - other, direction.of(&gradient) - direction.of(&without))
    };
    let slope = derivative(direction.steps[0], |distance| along(distance).0);
    let told = along(0.0).1;
    println!("gradient: {told} {slope}, {:.1e}", (told / slope - 1.0).abs());
    assert!((told - slope).abs() < FRICTION_DERIVATIVE * slope.abs(), "{told} {slope}");

    let error = direction.hessian_error(&mut model, &inputs);
    println!("Hessian: {error:.1e}");
    assert!(error < FRICTION_DERIVATIVE, "{error}");
}

#[test]
fn a_snapshot_with_friction_that_is_not_finite_is_refused() {
    let scene = pressed("rings", "0.4").expect("a scene");
    let mut first = model(&scene);
    for insertion in [0.004, 0.006] {
        solve(&mut first, &Inputs { insertion, ..scene.inputs.clone() });
    }
    let whole = Value::try_from(first.snapshot()).expect("a table");
    let restore = |value: Value| model(&scene).restore(&value.try_into().expect("a snapshot"));
    restore(whole.clone()).expect("as it was");
    for odd in [f64::NAN, f64::INFINITY] {
        for key in ["force", "stick_point", "arm", "normal"] {
            let mut other = whole.clone();
            let number = &mut other["friction"]["contacts"][0][key];
            let number = if number.is_array() { &mut number[1] } else { number };
            *number = Value::Float(odd);
            let refused = restore(other).expect_err(key).to_string();
            assert!(refused.contains("friction is not finite"), "{refused}");
        }
    }
}

#[test]
fn a_snapshot_remembers_what_the_wall_holds() {
    let scene = pressed("rings", "0.4").expect("a scene");
    let mut first = scene.manipulator(5).expect("allowed");
    for insertion in [0.004, 0.006, 0.0058] {
        to(&mut first, &scene, insertion);
    }
    let mut second = scene.manipulator(5).expect("allowed");
    second.restore(&first.snapshot()).expect("of this design");
    for insertion in [0.00575, 0.0057, 0.008] {
        assert_eq!(to(&mut first, &scene, insertion), to(&mut second, &scene, insertion));
    }
    // Without its memory it would be pushed from the other side.
    let mut fresh = scene.manipulator(5).expect("allowed");
    to(&mut fresh, &scene, 0.0058);
    let mut again = scene.manipulator(5).expect("allowed");
    for insertion in [0.004, 0.006, 0.0058] {
        to(&mut again, &scene, insertion);
    }
    assert!((push(fresh.outputs()) - push(again.outputs())).abs() > 0.1 * normal(fresh.outputs()));
}

/// A solve that fails leaves stick points and shape where they were.
#[test]
fn a_failed_step_keeps_the_memory() {
    let scene = pressed("rings", "0.4").expect("a scene");
    let mut device = scene.manipulator(5).expect("allowed");
    for insertion in [0.004, 0.006, 0.0058] {
        to(&mut device, &scene, insertion);
    }
    let mut untouched = device.clone();
    let overturned = Inputs { uniform_field: Vector3::new(0.0, 50.0, 0.0), ..scene.inputs.clone() };
    let outputs = device.solve(&overturned).expect("finite");
    assert_eq!(outputs.status, Status::NotSolved);
    let [after, wanted] = [&mut device, &mut untouched].map(|device| push(to(device, &scene, 0.0057)));
    assert_eq!(after.to_bits(), wanted.to_bits());
}

/// The levels that `auto` takes hand their stick points on.
#[test]
fn auto_holds_as_its_richest_level_does() {
    let pushes = ["auto", "full"].map(|level| {
        let scene = pressed(level, "0.4").expect("a scene");
        let mut device = scene.manipulator(5).expect("allowed");
        [0.004, 0.005, 0.006, 0.0055].map(|insertion| {
            let outputs = to(&mut device, &scene, insertion);
            println!(
                "{level}, {}: {:.4e} of {:.4e}",
                outputs.interaction.name(),
                push(outputs),
                normal(outputs)
            );
            (push(outputs), 0.4 * normal(outputs))
        })
    });
    for (number, ((auto, _), (full, limit))) in pushes[0].iter().zip(&pushes[1]).enumerate() {
        assert!((auto - full).abs() < 0.02 * limit, "{number}: {auto} {full} of {limit}");
    }
}

#[test]
fn without_friction_nothing_changes() {
    let scene = pressed("rings", "0.0").expect("a scene");
    let mut first = scene.manipulator(5).expect("allowed");
    let mut second = scene.manipulator(5).expect("allowed");
    second.set_friction(0.7).expect("allowed");
    second.set_friction(0.0).expect("allowed");
    for insertion in [0.004, 0.0041, 0.0043] {
        assert_eq!(to(&mut first, &scene, insertion), to(&mut second, &scene, insertion));
    }
    // From now on the wall holds on.
    second.set_friction(0.4).expect("allowed");
    let [free, held] = [&mut first, &mut second].map(|device| push(to(device, &scene, 0.005)));
    assert!(held - free > 0.2 * normal(second.outputs()), "{held} {free}");
}

#[test]
fn wrong_coefficients_are_refused_by_name() {
    let says_what_is_allowed = |error: &str| error.contains("from 0 to 10") || error.contains("finite");
    for text in ["-0.1", "nan", "inf", "11.0"] {
        let error = pressed("rings", text).expect_err(text).to_string();
        assert!(error.contains("vessel.friction = ") && says_what_is_allowed(&error), "{error}");
    }
    let scene = pressed("rings", "0.0").expect("a scene");
    let mut device = scene.manipulator(2).expect("allowed");
    for wrong in [-0.1, f64::NAN, f64::INFINITY, 11.0] {
        let error = device.set_friction(wrong).expect_err("refused").to_string();
        assert!(error.contains("vessel friction = ") && says_what_is_allowed(&error), "{error}");
    }
}

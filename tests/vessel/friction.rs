//! Friction between device and wall beside closed forms.

use core::f64::consts::{FRAC_PI_2, PI};
use core::fmt::Write;

use mcm::equilibrium::{Equilibrium, Inputs, Settings, Solution};
use mcm::manipulator::{Manipulator, Outputs, Scene, Status};
use mcm::vessel::friction::GIVE;
use nalgebra::Vector3;

use crate::tolerance::{CAPSTAN, FRICTION_PUSH, FRICTION_SETTLED, FRICTION_STEPS};

const GRAVITY: f64 = 9.81;
const DENSITY: f64 = 2000.0;
const RADIUS: f64 = 0.5e-3;
const MODULUS: f64 = 3e6;

/// A heavy rod on a shaft of the same stuff that lies in a straight tube, whose far end is `tilt` (rad) lower.
fn slope(friction: f64, tilt: f64) -> Scene {
    let rod = format!("elastic_modulus_mpa = 3.0\npoisson = 0.45\ndensity_kg_m3 = {DENSITY}\n");
    let (sine, cosine) = tilt.sin_cos();
    let text = format!(
        "[design]\nkind = \"cylinder\"\nlength_mm = 10.0\nradius_mm = 0.5\nremanence_t = 0.0\n{rod}\
         [model]\ninteraction = \"none\"\ntime_budget_s = 60.0\n\
         [gravity]\nacceleration_m_s2 = [0.0, {}, {}]\n[base]\nposition_mm = [0.0, -3.4999, 0.0]\n\
         [feed]\nmode = \"insertion\"\ninsertion_mm = 40.0\n\
         [feed.shaft]\nouter_radius_mm = 0.5\ninner_radius_mm = 0.0\n{rod}\
         [vessel]\nfriction = {friction}\n[[vessel.branch]]\nname = \"tube\"\n\
         points_mm = [[0, 0, -20], [0, 0, 40], [0, 0, 120]]\nradius_mm = 4.0\n",
        -GRAVITY * cosine,
        GRAVITY * sine,
    );
    Scene::parse(&text, "slope").expect("a scene")
}

/// Weight (N) of that rod with so much of its shaft (m).
fn weight(insertion: f64) -> f64 {
    DENSITY * PI * RADIUS * RADIUS * (insertion + 0.01) * GRAVITY
}

pub(super) fn to<'a>(manipulator: &'a mut Manipulator, scene: &Scene, insertion: f64) -> &'a Outputs {
    let outputs = manipulator.solve(&Inputs { insertion, ..scene.inputs.clone() }).expect("finite");
    assert!(outputs.status != Status::NotSolved && outputs.stable == Some(true), "{outputs:?}");
    outputs
}

pub(super) fn push(outputs: &Outputs) -> f64 {
    outputs.feed_reaction.expect("a shaft")
}

pub(super) fn normal(outputs: &Outputs) -> f64 {
    outputs.wall.as_ref().expect("a vessel").sum
}

/// Pushed down a slope the rod takes `mu N - W sin`, pulled back `-(mu N + W sin)`: what it takes changes its sign where the
/// tangent of the slope is the coefficient of friction.
#[test]
fn a_rod_slides_down_by_itself_where_the_slope_exceeds_the_coefficient() {
    let friction = 0.3_f64;
    for tilt in [-0.2, 0.0, 0.9 * friction.atan(), 1.1 * friction.atan(), 0.6] {
        let scene = slope(friction, tilt);
        let mut rod = scene.manipulator(2).expect("allowed");
        let first = to(&mut rod, &scene, 0.04);
        assert!((normal(first) / (weight(0.04) * tilt.cos()) - 1.0).abs() < 0.05, "the port carries little");
        let insertion = 0.042;
        let along = weight(insertion) * tilt.sin();
        let pushed = to(&mut rod, &scene, insertion).clone();
        to(&mut rod, &scene, insertion + 0.001);
        let pulled = to(&mut rod, &scene, insertion).clone();
        for (outputs, side) in [(&pushed, 1.0), (&pulled, -1.0)] {
            let limit = friction * normal(outputs);
            // The energy per length of the compressed shaft helps to push it out.
            let force = side * limit - along;
            let stiffness = MODULUS * PI * RADIUS * RADIUS;
            let error = push(outputs) - (force - force * force / (2.0 * stiffness));
            println!("{tilt:.3} {side}: {:.3e}, error {:.1e} of mu N", push(outputs), error / limit);
            assert!(error.abs() < FRICTION_SETTLED * limit, "{tilt} {side}: {error} of {limit}");
        }
        let loop_width = push(&pushed) - push(&pulled);
        let wanted = friction * (normal(&pushed) + normal(&pulled));
        assert!((loop_width / wanted - 1.0).abs() < FRICTION_SETTLED, "{loop_width} {wanted}");
        // The margin around the angle of friction is wider than what the port carries.
        assert_eq!(push(&pushed) < 0.0, tilt.tan() > friction, "{tilt}: {}", push(&pushed));
    }
}

/// The paper's forces: a magnet that presses with 0.146 N and pulls with 0.103 N along the vessel does not drag dry silicone
/// (about 1), but oiled or wet walls (0.04).
#[test]
fn silicone_sticks_dry_and_slides_oiled() {
    let (across, along) = (0.146, 0.103);
    for (friction, drags) in [(1.0, false), (0.04, true)] {
        let text = format!(
            "[design]\nkind = \"cylinder\"\nlength_mm = 5.0\nradius_mm = 0.75\ninner_radius_mm = 0.25\nelastic_modulus_mpa = 3.0\n\
             poisson = 0.45\nremanence_t = 0.0\n[load]\ntip_force_n = [0.0, -{across}, {along}]\n\
             [model]\ninteraction = \"none\"\ntime_budget_s = 60.0\n[base]\nposition_mm = [0.0, -3.0, 0.0]\n\
             [feed]\nmode = \"insertion\"\ninsertion_mm = 10.0\n[feed.shaft]\nouter_radius_mm = 0.75\ninner_radius_mm = 0.25\n\
             elastic_modulus_mpa = 3.0\npoisson = 0.45\n[vessel]\nfriction = {friction}\n[[vessel.branch]]\nname = \"tube\"\n\
             points_mm = [[0, 0, -20], [0, 0, 40], [0, 0, 80]]\nradius_mm = 4.0\n"
        );
        let scene = Scene::parse(&text, "pressed").expect("a scene");
        let mut tube = scene.manipulator(2).expect("allowed");
        to(&mut tube, &scene, 0.01);
        let moved = to(&mut tube, &scene, 0.012);
        println!("mu {friction}: push {:.4}, normal force {:.4}", push(moved), normal(moved));
        assert_eq!(push(moved) < 0.0, drags, "{friction}: {}", push(moved));
        // The walls pull with no more than Coulomb's limit, which a tip reaches that slides; a dry one is bent aside first.
        let part = (moved.base_reaction_force.z + along) / (friction * normal(moved));
        assert!(part < 1.0 + FRICTION_SETTLED && part > if drags { 0.99 } else { 0.5 }, "{part}");
    }
}

const FORMER: f64 = 30e-3;
const CORD: f64 = 0.3e-3;
const CORD_MODULUS: f64 = 50e6;
const PULL: f64 = 0.2;

/// A cord on the inner wall of a wide ring, pulled at its tip by a force at right angles to the port.
fn cord(insertion_mm: f64) -> Scene {
    let (wide, count) = (25.0, 40);
    let mut points = String::new();
    for i in -5..=count {
        let (sine, cosine) = (2.6 * f64::from(i) / f64::from(count)).sin_cos();
        let radius = 1e3 * FORMER + wide;
        write!(points, "[{}, 0, {}], ", radius * cosine - 1e3 * FORMER, radius * sine).expect("a string");
    }
    let (radius, modulus) = (1e3 * CORD, 1e-6 * CORD_MODULUS);
    let text = format!(
        "[design]\nkind = \"cylinder\"\nlength_mm = 5.0\nradius_mm = {radius}\nelastic_modulus_mpa = {modulus}\nremanence_t = 0.0\n\
         poisson = 0.45\n[model]\ninteraction = \"none\"\ntime_budget_s = 100.0\n[base]\nposition_mm = [{radius}, 0.0, 0.0]\n\
         [load]\ntip_force_n = [-{PULL}, 0.0, 0.0]\n[feed]\nmode = \"insertion\"\ninsertion_mm = {insertion_mm}\n\
         [feed.shaft]\nouter_radius_mm = {radius}\ninner_radius_mm = 0.0\nelastic_modulus_mpa = {modulus}\npoisson = 0.45\n\
         [vessel]\nwall_modulus_mpa = 10.0\n[[vessel.branch]]\nname = \"ring\"\npoints_mm = [{points}]\nradius_mm = {wide}\n"
    );
    Scene::parse(&text, "cord").expect("a scene")
}

/// The cord laid round without friction, then held by it.
fn laid(scene: &Scene, friction: f64) -> Equilibrium {
    let settings = Settings { time_budget: 100.0, ..scene.settings.as_discretised() };
    let made = Equilibrium::new(&scene.design().expect("allowed"), None, settings, 2).expect("allowed");
    let mut model = made.in_vessel(scene.vessel.as_ref().expect("a vessel"));
    for part in [0.0, 0.01, 0.03, 0.1, 0.3, 1.0] {
        let tip_force = scene.inputs.tip_force * part;
        solve(&mut model, &Inputs { tip_force, ..scene.inputs.clone() });
    }
    model.set_friction(friction).expect("allowed");
    model
}

pub(super) fn solve(model: &mut Equilibrium, inputs: &Inputs) {
    let report = model.solve(inputs).expect("finite");
    assert!(report.solved() && report.stable == Some(true), "{report:?}");
}

/// Tensions of a cord that slides round a former differ by `exp(lambda)` per radian. That is the coefficient of friction for a thin
/// cord; friction on the surface of one of radius `R`, whose centreline turns with radius `rho`, has
/// `lambda (1 + mu lambda R/rho) = mu (1 - R/rho)`. The cord lifts off by an angle `a` before it points along the pull `P`, with
/// `P (1 - cos a) = K/(2 rho^2)`, and presses there with `P sin a`; an angle that the port bears across has no friction.
#[test]
fn tension_grows_round_a_former_as_on_a_capstan() {
    let scene = cord(62.0);
    let radius = FORMER + CORD;
    let stiffness = CORD_MODULUS * PI * CORD.powi(4) / 4.0;
    let lift = (1.0 - stiffness / (2.0 * PULL * radius * radius)).acos();
    for friction in [0.1, 0.5] {
        let mut model = laid(&scene, friction);
        let mut lambda = friction;
        for _ in 0..20 {
            lambda = friction * (1.0 - CORD / radius) / (1.0 + friction * lambda * CORD / radius);
        }
        for (insertion, side) in [(0.064, -1.0), (0.062, 1.0)] {
            solve(&mut model, &Inputs { insertion, ..scene.inputs.clone() });
            let port = model.base_reaction().force;
            let end = PULL * (lift.cos() + side * friction * lift.sin());
            let angle = FRAC_PI_2 - lift - (port.x / port.z).abs();
            let measured = side * (-port.z / end).ln() / angle;
            println!("mu {friction}, {side}: {measured:.5} a radian, {lambda:.5}");
            assert!((measured / lambda - 1.0).abs() < CAPSTAN, "{friction} {side}: {measured} {lambda}");
        }
    }
}

/// Derivative of the energy by the insertion, with the stick points where they are.
#[test]
fn the_push_is_the_derivative_of_the_energy_at_fixed_stick_points() {
    let scene = cord(62.0);
    let mut model = laid(&scene, 0.3);
    for insertion in [0.0625, 0.0624] {
        let inputs = Inputs { insertion, ..scene.inputs.clone() };
        solve(&mut model, &inputs);
        let push = model.feed_reaction(&inputs).expect("a shaft");
        let limit = 0.3 * model.wall().expect("a vessel").sum;
        let unknowns = model.unknowns().to_vec();
        let mut beside = model.clone();
        let mut energy = |by: f64| {
            let inputs = Inputs { insertion: insertion + by, ..inputs.clone() };
            beside.gradient(&inputs, &unknowns).expect("inside").0
        };
        let step = 1e-7;
        let slope = (energy(step) - energy(-step)) / (2.0 * step);
        println!("{insertion}: push {push:.6} {slope:.6}");
        assert!((push - slope).abs() < FRICTION_PUSH * limit, "{push} {slope}");
    }
}

/// In steps of 0.05 mm, of 1 mm and at once; and within the give of sticking contacts.
#[test]
fn the_answer_does_not_depend_on_the_step() {
    let scene = slope(0.3, 0.1);
    let mut answers: Vec<[Outputs; 3]> = Vec::new();
    for steps in [1, 4, 80] {
        let mut rod = scene.manipulator(2).expect("allowed");
        to(&mut rod, &scene, 0.04);
        let mut go = |from: f64, by: f64, steps: i32| {
            for step in 1..=steps {
                to(&mut rod, &scene, from + by * f64::from(step) / f64::from(steps));
            }
            rod.outputs().clone()
        };
        let there = go(0.04, 0.004, steps);
        let sticking = go(0.044, -GIVE, steps.min(8));
        let back = go(0.044 - GIVE, GIVE - 0.002, steps);
        answers.push([there, sticking, back]);
    }
    let [once, others @ ..] = &answers[..] else { panic!() };
    for other in others {
        for (a, b) in once.iter().zip(other) {
            let limit = 0.3 * normal(a);
            let force = (push(a) - push(b)).abs() / limit;
            let tip = (a.tip.position - b.tip.position).norm();
            println!("push {:.4e}, apart by {force:.1e} of mu N, tip by {tip:.1e} m", push(a));
            assert!(force < FRICTION_STEPS[0] && tip < FRICTION_STEPS[1], "{force} {tip}");
        }
    }
}

/// Pulled at its tip by less than friction the rod gives way a little and comes back; pulled by more, it stays where it went.
#[test]
fn what_slid_stays() {
    let mut scene = slope(0.5, 0.0);
    scene.inputs.gravity *= 100.0; // so that it stretches by more than contacts give way
    let mut rod = scene.manipulator(2).expect("allowed");
    let start = to(&mut rod, &scene, 0.04).tip.position;
    let limit = 0.5 * normal(rod.outputs());
    let mut moved = |part: f64| {
        let tip_force = Vector3::z() * (part * limit);
        let outputs = rod.solve(&Inputs { tip_force, ..scene.inputs.clone() }).expect("finite");
        assert_eq!(outputs.status, Status::Solved);
        (outputs.tip.position - start).z
    };
    let (held, back) = (moved(0.05), moved(0.0));
    println!("held {held:.2e}, back {back:.2e}");
    assert!(held > 0.0 && held < GIVE && back.abs() < 0.1 * held);
    let (pulled, kept) = (moved(0.8), moved(0.0));
    // A rod with this friction per length `f` that slides from its tip stretches by `F^2 / (2 f EA)`; half of that stays.
    let stretched = (0.8 * limit).powi(2) / (2.0 * limit / 0.05 * MODULUS * PI * RADIUS * RADIUS);
    println!("pulled {pulled:.3e}, of {stretched:.3e}; kept {kept:.3e}");
    assert!((pulled / stretched - 1.0).abs() < 0.15, "{pulled} {stretched}");
    assert!((kept / pulled - 0.5).abs() < 0.1, "{kept} of {pulled}");
}

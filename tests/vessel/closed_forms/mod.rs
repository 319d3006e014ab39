//! Closed forms of slender rods against walls: small slopes, no shear, rigid walls.
//!
//! Rods are thin, gaps small and walls stiff, so that none of these leaves an error above the tolerance.

mod column;
mod heavy;
mod held;

use core::f64::consts::PI;

use mcm::design::{Backbone, Cylinder, CylinderMaterial, Design, Modulus, Specification};
use mcm::equilibrium::{Equilibrium, Inputs, Interaction, Outcome, Settings, Solution};
use mcm::vessel::{Branch, Lumen, Vessel, Wall};
use nalgebra::Vector3;

use crate::tolerance::{HELIX, LIFT_OFF, LINE_FORCE, SLEEVE, WALL_CLOSED_FORM};

const LENGTH: f64 = 0.1;
const RADIUS: f64 = 0.1e-3;
const MODULUS: f64 = 1e9;

/// Gap between rod and wall in a tube, m: slopes of a thousandth.
const GAP: f64 = 1e-3 * LENGTH;

/// Young's modulus of a stiff wall, Pa.
const STIFF: f64 = 1e9;

fn bending_stiffness() -> f64 {
    MODULUS * PI * RADIUS.powi(4) / 4.0
}

/// A rod of this length (m) and mass per length (kg/m).
fn design(length: f64, line_density: f64) -> Design {
    let material = CylinderMaterial::Bulk { elastic_modulus: MODULUS, poisson: 0.45, remanence: 0.0 };
    let density = Some(line_density / (PI * RADIUS * RADIUS));
    let cylinder = Cylinder { length, radius: RADIUS, inner_radius: 0.0, material, density };
    Design::new(Specification::Cylinder(cylinder)).expect("allowed")
}

fn settings(elements: usize) -> Settings {
    Settings {
        cylinder_elements: elements,
        interaction: Interaction::None,
        time_budget: 60.0,
        iterations: 5000,
        ..Settings::default()
    }
}

fn model(design: &Design, elements: usize, vessel: &Vessel) -> Equilibrium {
    Equilibrium::new(design, None, settings(elements), 201).expect("allowed").in_vessel(vessel)
}

/// A vessel of one branch.
fn vessel(points: &[Vector3<f64>], radius: f64, modulus: f64) -> Vessel {
    let branch = Branch::new("one", points, &vec![radius; points.len()]).expect("allowed");
    Vessel { lumen: Lumen::new(vec![branch]).expect("one"), wall: Wall::new(modulus).expect("allowed") }
}

/// A straight tube along z with [`GAP`] around the rod.
fn tube(modulus: f64) -> Vessel {
    vessel(&[-1.0, 1.0, 3.0].map(|z| Vector3::new(0.0, 0.0, z * LENGTH)), RADIUS + GAP, modulus)
}

fn solve(model: &mut Equilibrium, inputs: &Inputs) {
    let report = model.solve(inputs).expect("finite");
    assert!(report.solved() && report.stable == Some(true), "{report:?}");
}

fn wall_force(model: &Equilibrium) -> f64 {
    model.wall().expect("a vessel").force.norm()
}

/// The tip force of a clamped rod whose tip is bent against the wall by a moment: `3 (M - M1) / (2 L)` beyond
/// `M1 = 2 K c / L^2`.
#[test]
fn bent_rod_presses_its_tip_as_in_closed_form() {
    let touching = 2.0 * bending_stiffness() * GAP / (LENGTH * LENGTH);
    let mut last = f64::INFINITY;
    for modulus in [1e6, 1e8, 1e10] {
        let mut model = model(&design(LENGTH, 0.0), 16, &tube(modulus));
        let mut worst = 0.0_f64;
        for times in [2.0, 5.0, 10.0] {
            let moment = times * touching;
            solve(&mut model, &Inputs { tip_moment: Vector3::new(0.0, moment, 0.0), ..Inputs::unloaded(0) });
            let wanted = 1.5 * (moment - touching) / LENGTH;
            worst = worst.max((wall_force(&model) / wanted - 1.0).abs());
        }
        println!("wall of {modulus:.0e} Pa: {worst:.1e}");
        assert!(worst < 0.2 * last || worst < WALL_CLOSED_FORM, "{worst} after {last}");
        last = worst;
    }
    assert!(last < WALL_CLOSED_FORM, "{last}");
}

/// A compressed column whose tip rests on the wall: `N = P (c/L) kL / (kL - tan kL)`.
#[test]
fn compressed_column_rests_on_the_wall_as_in_closed_form() {
    for (angle, tabulated) in [(2.0_f64, 1.91157), (2.5, 4.81210), (PI, PI * PI), (4.0, 22.51794)] {
        let axial = bending_stiffness() * (angle / LENGTH).powi(2);
        let mut model = model(&design(LENGTH, 0.0), 16, &tube(STIFF));
        let aside = 1e-2 * axial;
        let mut inputs = Inputs { tip_force: Vector3::new(aside, 0.0, -axial), ..Inputs::unloaded(0) };
        solve(&mut model, &inputs);
        inputs.tip_force.x = 0.0;
        // Without the force aside, the column may turn around the tube's axis freely.
        let report = model.solve(&inputs).expect("finite");
        assert!(report.outcome == Outcome::Neutral && report.progress >= 1.0, "{report:?}");

        let scaled = wall_force(&model) * LENGTH.powi(3) / (bending_stiffness() * GAP);
        let wanted = angle.powi(3) / (angle - angle.tan());
        assert!((wanted - tabulated).abs() < 1e-5, "{wanted} {tabulated}");
        println!("kL = {angle}: {scaled}, {wanted}: {:.1e}", scaled / wanted - 1.0);
        assert!((scaled / wanted - 1.0).abs() < WALL_CLOSED_FORM, "kL = {angle}: {scaled}, {wanted}");
    }
}

/// A rod that leaves a smooth port by `l` and bears a force `P` across at its tip is pushed out by `P^2 l^2 / (2 K)`.
#[test]
fn a_sleeve_pushes_a_bent_rod_out_as_in_closed_form() {
    let modulus = Modulus::Elastic(MODULUS);
    let shaft = Backbone { outer_radius: RADIUS, inner_radius: 0.0, modulus, poisson: 0.45, density: 0.0 };
    let (stiffness, end) = (bending_stiffness(), 0.01);
    let design = design(end, 0.0).with_shaft(&shaft).expect("allowed");
    for outside in [0.03, 0.1] {
        let mut last = f64::INFINITY;
        for slope in [0.1, 0.03, 0.01] {
            let across = slope * 2.0 * stiffness / (outside * outside);
            let inputs = Inputs {
                tip_force: Vector3::new(across, 0.0, 0.0),
                insertion: outside - end,
                ..Inputs::unloaded(0)
            };
            let mut model = Equilibrium::new(&design, None, settings(8), 2).expect("allowed");
            solve(&mut model, &inputs);
            let push = model.feed_reaction(&inputs).expect("a shaft");
            let off = (push / (-(across * outside).powi(2) / (2.0 * stiffness)) - 1.0).abs();
            println!("{outside} m outside, slope {slope}: {off:.1e}");
            // The port's own reaction along the axis is that force too: nothing else pushes.
            assert!(model.base_reaction().force.z.abs() < 1e-12 * across, "{:?}", model.base_reaction());
            assert!(off < 0.6 * slope * slope && off < 0.2 * last, "{off} after {last}");
            last = off;
        }
        assert!(last < SLEEVE, "{last}");
    }
}

/// Errors of wall force, tip (both relative) and place of lift-off (over the length) of a rod that is bent by a force at its tip
/// over a round former of this radius (m), from which this part of it lifts off.
fn off_the_former(former: f64, lifted: f64, elements: usize) -> [f64; 3] {
    let wide = 2e-3;
    let middle = former - RADIUS + wide;
    let place = |i: i32| {
        let angle = 5e-3 * f64::from(i) / former;
        Vector3::new(former - middle * angle.cos(), 0.0, middle * angle.sin())
    };
    let points: Vec<_> = (-20..=60).map(place).collect();
    let (free, stiffness) = (lifted * LENGTH, bending_stiffness());
    let force = stiffness / (former * free);
    let mut model = model(&design(LENGTH, 0.0), elements, &vessel(&points, wide, STIFF));
    let inputs = Inputs { tip_force: Vector3::new(force, 0.0, 0.0), ..Inputs::unloaded(0) };
    solve(&mut model, &inputs);
    polish(&mut model, &inputs);
    let s = LENGTH - free;
    let tip = (0.5 * s * s + s * free + free * free / 3.0) / former;
    // Beyond the lift-off the gap grows as the cube of the distance.
    let shape: Vec<(f64, Vector3<f64>)> = model.shape().collect();
    let root = |part: f64| {
        let (along, point) = shape[((s + part * free) / LENGTH * 200.0).round() as usize];
        (along, ((point - Vector3::new(former, 0.0, 0.0)).norm() - former).cbrt())
    };
    let ((x1, g1), (x2, g2)) = (root(0.4), root(0.8));
    let found = x1 - g1 * (x2 - x1) / (g2 - g1);
    [wall_force(&model) / force - 1.0, model.tip().position.x / tip - 1.0, (found - s) / LENGTH]
}

/// Newton steps beyond the residual at which a solve against a stiff wall ends.
fn polish(model: &mut Equilibrium, inputs: &Inputs) {
    let mut shape = model.unknowns().to_vec();
    for _ in 0..4 {
        let (_, gradient) = model.gradient(inputs, &shape).expect("apart");
        let step = model.solve_at(inputs, &shape, 0.0, &gradient).expect("stable");
        shape.iter_mut().zip(&step).for_each(|(x, s)| *x -= s);
    }
    model.gradient(inputs, &shape).expect("apart");
}

/// A rod bent over a round former by a force `F` at its tip lies on it up to `s = L - K/(F rho)`, where the former bears `F`.
#[test]
fn a_rod_bent_over_a_former_lifts_off_as_in_closed_form() {
    let mut last = f64::INFINITY;
    for former in [2.0, 4.0, 8.0] {
        let [force, tip, place] = off_the_former(former, 0.25, 16);
        println!("slopes to {:.1e}: force {force:.1e}, tip {tip:.1e}, lift-off {place:.1e}", LENGTH / former);
        assert!(tip.abs() < 0.3 * last && tip.abs() < 0.1 * (LENGTH / former).powi(2), "{tip} after {last}");
        last = tip.abs();
        let wanted = WALL_CLOSED_FORM * (8.0 / former).powi(2);
        assert!(force.abs() < wanted && tip.abs() < wanted, "{force} {tip}");
        assert!(place.abs() < LIFT_OFF * (8.0 / former).powi(2), "{place}");
    }
}

/// The former's force jumps where the rod lifts off. Within an element that is found the better the shorter it is.
#[test]
fn a_lift_off_within_an_element_converges_with_their_number() {
    let mut last = f64::INFINITY;
    for elements in [16, 32, 64] {
        let [force, _, place] = off_the_former(8.0, 0.6, elements);
        println!("{elements} elements: force {force:.1e}, lift-off {place:.1e}");
        assert!(force.abs() < 0.7 * last, "{force} after {last}");
        last = force.abs();
    }
    assert!(last < WALL_CLOSED_FORM, "{last}");
}

/// A long rod compressed by `F` in a tube winds as a helix of pitch `p`, `F = 8 pi^2 K/p^2`, and presses on the wall with
/// `c F^2/(4 K)` per length.
#[test]
fn a_long_rod_in_a_tube_winds_as_in_closed_form() {
    let (turns, stiffness) = (2.7, bending_stiffness());
    let wave = 2.0 * PI * turns / LENGTH;
    let axial = 2.0 * stiffness * wave * wave;
    let vessel = tube(1e7);
    let mut model = model(&design(LENGTH, 0.0), 16, &vessel);
    let tip_force = Vector3::new(0.02 * axial, 0.0, -axial);
    solve(&mut model, &Inputs { tip_force, ..Inputs::unloaded(0) });
    // Ends count for nothing in the middle: they decay as exp(-4 pi z/p). Four elements of sixteen.
    let points: Vec<Vector3<f64>> = model.shape().map(|row| row.1).collect();
    let middle = &points[75..=125];
    let pairs = || middle.windows(2).map(|pair| [pair[0], pair[1]]);
    let turn = |[a, b]: [Vector3<f64>; 2]| a.xy().perp(&b.xy()).atan2(a.xy().dot(&b.xy()));
    let along = middle[50].z - middle[0].z;
    let found = pairs().map(turn).sum::<f64>().abs() / along;
    let line = |point: &Vector3<f64>| vessel.wall.line(point.xy().norm() - GAP)[1];
    let mean = pairs().map(|[a, b]| 0.5 * (line(&a) + line(&b))).sum::<f64>() / 50.0;
    let wanted = GAP * axial * axial / (4.0 * stiffness);
    println!("pitch {:.1e}, force per length {:.1e}", wave / found - 1.0, mean / wanted - 1.0);
    // The square of the slope is 3e-4, that of the thickness over the pitch as much.
    assert!((found / wave - 1.0).abs() < HELIX, "{found} {wave}");
    assert!((mean / wanted - 1.0).abs() < LINE_FORCE, "{mean} {wanted}");
}

//! Random devices pushed into random vessels.

use std::f64::consts::{PI, TAU};
use std::fmt::Write;

use mcm::geometry::RotationVector;
use mcm::manipulator::{Inputs, Scene};
use mcm::vessel::Aorta;
use nalgebra::{UnitQuaternion, Vector3};
use rand::RngExt;
use rand::rngs::StdRng;

use crate::given::{direction, of_case};

/// Steps after the first solve.
const STEPS: usize = 10;

/// How likely each number of segments is, from one on.
const SEGMENTS: [u32; 9] = [24, 20, 16, 8, 6, 4, 2, 2, 3];

/// How likely each level is.
const LEVELS: [(&str, u32); 4] = [("none", 30), ("rings", 60), ("full", 6), ("auto", 4)];

/// How likely each vessel is.
const VESSELS: [(&str, u32); 4] = [("bent", 40), ("fork", 40), ("planar aorta", 10), ("spatial aorta", 10)];

/// Processor times of a solve, s.
const BUDGETS: [(f64, u32); 4] = [(0.02, 1), (0.2, 3), (1.0, 6), (3.0, 1)];

/// Young's moduli (`MPa`) of the shaft: of silicone, of a soft polymer, of a fluoropolymer.
const SHAFTS: [(f64, u32); 3] = [(1.0, 6), (10.0, 2), (500.0, 2)];

/// Distance of two points of a centreline, mm.
const APART_MM: f64 = 5.0;

/// A device, its vessel, and the inputs that follow one another.
#[derive(Debug, Clone)]
pub(crate) struct Insertion {
    pub(crate) vessel: &'static str,
    /// The scene of the first inputs, as a file.
    pub(crate) text: String,
    pub(crate) scene: Scene,
    pub(crate) steps: Vec<Inputs>,
}

fn one_of<T: Copy>(random: &mut StdRng, rows: &[(T, u32)]) -> T {
    let mut left = random.random_range(0..rows.iter().map(|row| row.1).sum());
    for (value, weight) in rows {
        if left < *weight {
            return *value;
        }
        left -= weight;
    }
    rows[0].0
}

/// A size between two powers of ten.
fn size(random: &mut StdRng, powers: [f64; 2]) -> f64 {
    10_f64.powf(random.random_range(powers[0]..powers[1]))
}

fn list(v: &Vector3<f64>) -> String {
    format!("[{:?}, {:?}, {:?}]", v.x, v.y, v.z)
}

/// Points (mm) and radii (mm) of a vessel that starts here, bends in a few arcs, and narrows or widens.
fn winding(
    random: &mut StdRng,
    [start, towards]: [Vector3<f64>; 2],
    [length, straight, radius]: [f64; 3],
) -> Vec<(Vector3<f64>, f64)> {
    let (mut place, mut along) = (start, towards);
    let ends_at = radius * random.random_range(0.5..1.3);
    let mut curvature = Vector3::zeros();
    let mut out = Vec::new();
    let mut at = 0.0;
    while at <= length {
        let part = ((at - straight) / (length - straight)).max(0.0);
        out.push((place, radius + (ends_at - radius) * part * part * (3.0 - 2.0 * part)));
        if at >= straight && random.random_bool(0.25) {
            let bend = random.random_range(3.0..20.0) * radius;
            curvature = along.cross(&direction(random)) / bend;
        }
        along = RotationVector::new(curvature * APART_MM).matrix() * along;
        place += along * APART_MM;
        at += APART_MM;
    }
    out
}

fn branch(name: &str, balls: &[(Vector3<f64>, f64)]) -> String {
    let points: Vec<String> = balls.iter().map(|ball| list(&ball.0)).collect();
    let radii: Vec<String> = balls.iter().map(|ball| format!("{:?}", ball.1)).collect();
    let (points, radii) = (points.join(", "), radii.join(", "));
    format!("[[vessel.branch]]\nname = \"{name}\"\npoints_mm = [{points}]\nradius_mm = [{radii}]\n")
}

/// Branches as text, and the length of the first one from the port on, mm.
fn vessel(random: &mut StdRng, kind: &str) -> (String, f64) {
    match kind {
        "planar aorta" => return (Aorta::planar().scene_text().expect("allowed"), 300.0),
        "spatial aorta" => return (Aorta::spatial().scene_text().expect("allowed"), 300.0),
        _ => {}
    }
    let radius = random.random_range(2.2..7.0);
    let (before, length) = (20.0, random.random_range(60.0..160.0));
    let first = winding(
        random,
        [Vector3::new(0.0, 0.0, -before), Vector3::z()],
        [length + before, before + 10.0, radius],
    );
    let mut out = branch("first", &first);
    if kind == "fork" {
        let number = random.random_range(7..first.len() - 2);
        let (from, wide) = first[number];
        let along = (first[number + 1].0 - from).normalize();
        let turn = random.random_range(20.0..135.0_f64).to_radians();
        let across = along.cross(&direction(random)).normalize();
        let towards = RotationVector::new(across * turn).matrix() * along;
        let wide = wide * random.random_range(0.4..1.0);
        let lengths = [random.random_range(30.0..90.0), 2.0 * wide, wide];
        out += &branch("second", &winding(random, [from, towards], lengths));
    }
    (out, length)
}

impl Insertion {
    /// The insertion of this number.
    pub(crate) fn random(seed: u64, index: u64) -> Self {
        let random = &mut of_case(seed, index);
        let weights: Vec<(usize, u32)> = (1..).zip(SEGMENTS).collect();
        let (segments, level) = (one_of(random, &weights), one_of(random, &LEVELS));
        let kind = one_of(random, &VESSELS);
        let (branches, length) = vessel(random, kind);
        let spiral = if random.random_bool(0.5) { "helical" } else { "axisymmetric" };
        let (budget, shaft) = (one_of(random, &BUDGETS), one_of(random, &SHAFTS));
        let mut text = format!(
            "[design]\nsegments = {segments}\nbase_magnet = {}\ntip_magnet = {}\nspiral = \"{spiral}\"\n[model]\n\
             interaction = \"{level}\"\ntime_budget_s = {budget:?}\n[feed]\nmode = \"insertion\"\ninsertion_mm = {:?}\n\
             [feed.shaft]\nouter_radius_mm = 0.75\ninner_radius_mm = 0.25\nelastic_modulus_mpa = {shaft:?}\npoisson = 0.45\n",
            random.random_bool(0.7),
            random.random_bool(0.9),
            if random.random_bool(0.5) { 0.0 } else { random.random_range(0.0..20.0) },
        );
        if random.random_bool(0.5) {
            let near = Vector3::z() * random.random_range(0.0..length);
            let place = near + direction(random) * size(random, [1.4, 2.3]);
            let turn = UnitQuaternion::from_scaled_axis(direction(random) * random.random_range(0.0..TAU));
            let (place, turn) = (list(&place), turn.quaternion());
            let _ = writeln!(
                text,
                "[magnet]\nposition_mm = {place}\norientation_wxyz = [{:?}, {:?}, {:?}, {:?}]",
                turn.w, turn.i, turn.j, turn.k
            );
        }
        if random.random_bool(0.3) {
            let field = direction(random) * random.random_range(0.0..20.0);
            let _ = writeln!(text, "[field]\nuniform_mt = {}", list(&field));
        }
        if random.random_bool(0.3) {
            let _ = writeln!(text, "[gravity]\nacceleration_m_s2 = {}", list(&(direction(random) * 9.81)));
        }
        let _ = write!(text, "[vessel]\nwall_modulus_mpa = {:?}\n{branches}", size(random, [-1.0, 1.5]));
        let mut scene =
            Scene::parse(&text, "random").unwrap_or_else(|error| panic!("{index}: {error}\n{text}"));
        if random.random_bool(0.6) {
            scene.settings = scene.settings.as_discretised();
        }
        let mut steps = vec![scene.inputs.clone()];
        for _ in 0..STEPS {
            let next = advanced(random, &scene, &steps[steps.len() - 1], 1e-3 * length);
            steps.push(next);
        }
        Self { vessel: kind, text, scene, steps }
    }
}

/// The next inputs: farther in, or back, and now and then turned, led elsewhere, or with the port against the wall.
fn advanced(random: &mut StdRng, scene: &Scene, last: &Inputs, length: f64) -> Inputs {
    let mut next = last.clone();
    let by = 1e-3 * size(random, [-1.0, 1.48]);
    let by = if random.random_bool(0.8) { by } else { -by };
    next.insertion = (last.insertion + by).clamp(0.0, length);
    if random.random_bool(0.2) {
        next.roll += PI * size(random, [-3.0, 0.0]) * if random.random_bool(0.5) { 1.0 } else { -1.0 };
    }
    if scene.sources.magnet().is_some() && random.random_bool(0.5) {
        next.sources[0].pose.position += direction(random) * (1e-3 * size(random, [-1.0, 1.48]));
        let turn = direction(random) * size(random, [-3.0, -0.5]);
        next.sources[0].pose.rotation = RotationVector::new(turn).matrix() * next.sources[0].pose.rotation;
    }
    if random.random_bool(0.1) {
        // From where the first ring is free to where it is pressed into the wall.
        let vessel = scene.vessel.as_ref().expect("a vessel");
        let room = vessel.lumen.clearance(&scene.inputs.base.position).value - 2e-3;
        let across = Vector3::new(random.random_range(-1.0..1.0), random.random_range(-1.0..1.0), 0.0);
        next.base.position = scene.inputs.base.position + across * (room + 0.3e-3);
        let tilt = direction(random) * random.random_range(0.0..0.1);
        next.base.rotation = RotationVector::new(tilt).matrix() * scene.inputs.base.rotation;
    }
    next
}

//! Random scenes as texts, so that any of them can be told and solved alone.

use std::f64::consts::TAU;
use std::fmt::Write;

use nalgebra::{UnitQuaternion, Vector3};
use rand::RngExt;
use rand::rngs::StdRng;

use crate::given::{direction, of_case};

/// Strongest uniform field, mT.
const STRONGEST_MT: f64 = 50.0;

/// Length of a segment with its ring and of the first ring, mm.
const SEGMENT_MM: f64 = 5.0;

/// How likely each number of segments is, from one on: mostly short ones, which are solved soonest.
const SEGMENTS: [u32; 9] = [50, 18, 18, 5, 3, 2, 1, 1, 2];

/// How likely each level is.
const LEVELS: [(&str, u32); 5] =
    [("none", 520), ("rings", 440), ("preceding", 20), ("full", 10), ("auto", 10)];

/// Warm steps after the cold solve: part of the way from the last loads to new ones.
const STEPS: [f64; 24] = [
    1e-3, 1e-3, 0.02, 0.05, 1e-3, 0.02, 0.02, 0.05, 1e-3, 0.02, 0.02, 0.05, 1e-3, 0.02, 0.02, 0.1, 1e-3,
    0.02, 0.02, 0.1, 1e-3, 0.02, 0.3, 1.0,
];

/// What acts on the manipulator, in the units of the scene file.
#[derive(Debug, Clone)]
struct Loads {
    field: Vector3<f64>,
    gradient: [f64; 5],
    magnet: Vector3<f64>,
    orientation: UnitQuaternion<f64>,
    strength: f64,
    tip_force: Vector3<f64>,
    tip_moment: Vector3<f64>,
    ring_force: Vector3<f64>,
    ring: usize,
    gravity: Vector3<f64>,
}

/// A manipulator and the loads that it meets one after the other.
#[derive(Debug, Clone)]
pub(crate) struct Walk {
    pub(crate) level: &'static str,
    model: String,
    rings: usize,
    has_magnet: bool,
    loads: Vec<Loads>,
}

fn one_of(random: &mut StdRng, weights: impl Iterator<Item = u32> + Clone) -> usize {
    let mut left = random.random_range(0..weights.clone().sum());
    for (index, weight) in weights.enumerate() {
        if left < weight {
            return index;
        }
        left -= weight;
    }
    0
}

/// A size between two powers of ten.
fn size(random: &mut StdRng, powers: [f64; 2]) -> f64 {
    10_f64.powf(random.random_range(powers[0]..powers[1]))
}

fn sometimes(random: &mut StdRng, likely: f64, powers: [f64; 2]) -> Vector3<f64> {
    if random.random_bool(likely) { direction(random) * size(random, powers) } else { Vector3::zeros() }
}

impl Loads {
    fn random(random: &mut StdRng, length: f64, has_magnet: bool, rings: usize) -> Self {
        let strongest = random.random_range(0.0..=STRONGEST_MT);
        let field = match random.random_range(0..20) {
            0..6 => Vector3::zeros(),
            6..8 => Vector3::new(0.0, 0.0, -strongest),
            8 => Vector3::new(0.0, 0.0, -strongest) + direction(random) * size(random, [-9.0, 0.0]),
            9 => Vector3::new(0.0, strongest, 0.0),
            _ => direction(random) * strongest,
        };
        let gradient =
            if random.random_bool(0.2) { [0; 5].map(|_| random.random_range(-1.0..=1.0)) } else { [0.0; 5] };
        let middle = Vector3::new(0.0, 0.0, random.random_range(-0.2..=1.2) * length);
        // From inside over touching to far away.
        let magnet = middle + direction(random) * size(random, [1.0, 2.5]);
        let orientation = match random.random_range(0..4) {
            0 => UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI),
            _ => UnitQuaternion::from_scaled_axis(direction(random) * random.random_range(0.0..TAU)),
        };
        let strength = if random.random_bool(0.7) { 1.0 } else { random.random_range(-2.0..=2.0) };
        Self {
            field,
            gradient,
            magnet,
            orientation,
            strength: if has_magnet { strength } else { 0.0 },
            tip_force: sometimes(random, 0.15, [-6.0, -1.5]),
            tip_moment: sometimes(random, 0.2, [-12.0, -4.0]),
            ring_force: sometimes(random, 0.1, [-6.0, -1.5]),
            ring: random.random_range(0..rings.max(1)),
            gravity: if random.random_bool(0.2) { direction(random) * 9.81 } else { Vector3::zeros() },
        }
    }

    /// A part of the way to other loads.
    fn towards(&self, other: &Self, part: f64) -> Self {
        let mix = |a: &Vector3<f64>, b: &Vector3<f64>| a.lerp(b, part);
        Self {
            field: mix(&self.field, &other.field),
            gradient: core::array::from_fn(|i| {
                self.gradient[i] + part * (other.gradient[i] - self.gradient[i])
            }),
            magnet: mix(&self.magnet, &other.magnet),
            orientation: self
                .orientation
                .try_slerp(&other.orientation, part, 1e-9)
                .unwrap_or(other.orientation),
            strength: self.strength + part * (other.strength - self.strength),
            tip_force: mix(&self.tip_force, &other.tip_force),
            tip_moment: mix(&self.tip_moment, &other.tip_moment),
            ring_force: mix(&self.ring_force, &other.ring_force),
            ring: self.ring,
            gravity: mix(&self.gravity, &other.gravity),
        }
    }
}

impl Walk {
    /// The walk of this number.
    pub(crate) fn random(seed: u64, index: u64) -> Self {
        let random = &mut of_case(seed, index);
        let segments = 1 + one_of(random, SEGMENTS.iter().copied());
        let level = LEVELS[one_of(random, LEVELS.iter().map(|row| row.1))].0;
        let (base, tip) = (random.random_bool(0.7), random.random_bool(0.95));
        let spiral = if random.random_bool(0.5) { "helical" } else { "axisymmetric" };
        let stop = random.random_bool(0.15);
        let model = format!(
            "[design]\nsegments = {segments}\nbase_magnet = {base}\ntip_magnet = {tip}\nspiral = \"{spiral}\"\n\
             [model]\ninteraction = \"{level}\"\nbending_stop = {stop}\n"
        );
        let rings = segments - 1 + usize::from(base) + usize::from(tip);
        let has_magnet = random.random_bool(0.5);
        let length = SEGMENT_MM * segments as f64;
        let mut loads = vec![Loads::random(random, length, has_magnet, rings)];
        for part in STEPS {
            let next = Loads::random(random, length, has_magnet, rings);
            loads.push(loads[loads.len() - 1].towards(&next, part));
        }
        Self { level, model, rings, has_magnet, loads }
    }

    /// Its scenes in their order.
    pub(crate) fn texts(&self) -> impl Iterator<Item = String> + '_ {
        self.loads.iter().map(|loads| self.text(loads))
    }

    fn text(&self, loads: &Loads) -> String {
        let mut out = self.model.clone();
        let list = |v: &Vector3<f64>| format!("[{:?}, {:?}, {:?}]", v.x, v.y, v.z);
        let mut add = |line: String| {
            let _ = writeln!(out, "{line}");
        };
        add(format!("[field]\nuniform_mt = {}\ngradient_t_per_m = {:?}", list(&loads.field), loads.gradient));
        if self.has_magnet {
            let turn = loads.orientation.quaternion();
            add(format!(
                "[magnet]\nposition_mm = {}\norientation_wxyz = [{:?}, {:?}, {:?}, {:?}]\nstrength = {:?}",
                list(&loads.magnet),
                turn.w,
                turn.i,
                turn.j,
                turn.k,
                loads.strength
            ));
        }
        add(format!(
            "[load]\ntip_force_n = {}\ntip_moment_nm = {}",
            list(&loads.tip_force),
            list(&loads.tip_moment)
        ));
        if self.rings > 0 {
            let zero = Vector3::zeros();
            let forces =
                (0..self.rings).map(|k| list(if k == loads.ring { &loads.ring_force } else { &zero }));
            add(format!("ring_force_n = [{}]", forces.collect::<Vec<_>>().join(", ")));
        }
        add(format!("[gravity]\nacceleration_m_s2 = {}", list(&loads.gravity)));
        out
    }
}

//! Random devices made of sections, and their scenes moved, mirrored or reversed.

use mcm::geometry::Pose;
use nalgebra::{Matrix3, Vector3};
use rand::RngExt;
use rand::rngs::StdRng;

use crate::given::direction;

/// A section as its numbers in the units of a scene.
#[derive(Debug, Clone)]
pub(super) struct Section {
    pub(super) length: f64,
    pub(super) outer: [f64; 2],
    pub(super) inner: f64,
    /// Young's modulus in megapascals; `None`: rigid.
    pub(super) modulus: Option<f64>,
    pub(super) remanence: f64,
    pub(super) direction: Vector3<f64>,
    pub(super) turn: f64,
    pub(super) rest: Vector3<f64>,
}

/// What acts on a device: field (mT), its gradient (T/m), gravity (m/s2), force on the tip (N), and the pose of the base (m).
#[derive(Debug, Clone)]
pub(super) struct Loads {
    pub(super) field: Vector3<f64>,
    pub(super) gradient: Matrix3<f64>,
    pub(super) gravity: Vector3<f64>,
    pub(super) force: Vector3<f64>,
    pub(super) base: Pose,
    /// Pose of a magnet (m) and the remanence of its cylinder (T).
    pub(super) magnet: (Pose, f64),
}

/// A scene with a device made of sections.
#[derive(Debug, Clone)]
pub(super) struct Device {
    pub(super) sections: Vec<Section>,
    pub(super) loads: Loads,
    pub(super) level: &'static str,
}

impl Device {
    /// A device of three to five sections, soft and rigid by turns, magnetised in all directions.
    pub(super) fn random(random: &mut StdRng, level: &'static str) -> Self {
        let count = random.random_range(3..=5);
        let sections = (0..count).map(|number| Section::random(random, number % 2 == 1)).collect();
        Self { sections, loads: Loads::random(random), level }
    }

    /// Length, m.
    pub(super) fn length(&self) -> f64 {
        self.sections.iter().map(|own| 1e-3 * own.length).sum()
    }

    /// The mirror image in the plane across x: of what points along an axis it keeps x and reverses the others, of what turns about an
    /// axis, as a field or a magnetisation, it is the other way round.
    pub(super) fn mirrored(&self) -> Self {
        let mirror = Matrix3::from_diagonal(&Vector3::new(-1.0, 1.0, 1.0));
        let turning = |axial: &Vector3<f64>| -(mirror * axial);
        let pose = |pose: &Pose| Pose {
            position: mirror * pose.position,
            rotation: mirror * pose.rotation * mirror,
        };
        let sections = self.sections.iter().map(|own| Section {
            direction: turning(&own.direction),
            turn: -own.turn,
            rest: turning(&own.rest),
            ..own.clone()
        });
        let Loads { field, gradient, gravity, force, base, magnet: (placed, remanence) } = &self.loads;
        let loads = Loads {
            field: turning(field),
            gradient: -(mirror * gradient * mirror),
            gravity: mirror * gravity,
            force: mirror * force,
            base: pose(base),
            // Along the axis of its frame, as a field.
            magnet: (pose(placed), -remanence),
        };
        Self { sections: sections.collect(), loads, level: self.level }
    }

    /// Everything moved as one body.
    pub(super) fn moved(&self, by: &Pose) -> Self {
        let turn = by.rotation;
        let Loads { field, gradient, gravity, force, base, magnet: (placed, remanence) } = &self.loads;
        let gradient = turn * gradient * turn.transpose();
        let loads = Loads {
            // The linear field is given at the origin.
            field: turn * field - gradient * by.position * 1e3,
            gradient,
            gravity: turn * gravity,
            force: turn * force,
            base: by.compose(base),
            magnet: (by.compose(placed), *remanence),
        };
        Self { loads, ..self.clone() }
    }

    /// All magnetisation and all fields the other way round.
    pub(super) fn reversed(&self) -> Self {
        let sections = self.sections.iter().map(|own| Section { remanence: -own.remanence, ..own.clone() });
        let (placed, remanence) = &self.loads.magnet;
        let loads = Loads {
            field: -self.loads.field,
            gradient: -self.loads.gradient,
            magnet: (*placed, -remanence),
            ..self.loads.clone()
        };
        Self { sections: sections.collect(), loads, level: self.level }
    }

    /// The text of its scene.
    pub(super) fn text(&self) -> String {
        let sections: String = self.sections.iter().map(Section::text).collect();
        let Loads { field, gradient: g, gravity, force, base, magnet: (placed, remanence) } = &self.loads;
        let list = |v: &Vector3<f64>| format!("[{:e}, {:e}, {:e}]", v.x, v.y, v.z);
        let pose = |pose: &Pose| {
            let [w, x, y, z] = pose.quaternion();
            let position = list(&(pose.position * 1e3));
            format!("position_mm = {position}\norientation_wxyz = [{w:e}, {x:e}, {y:e}, {z:e}]\n")
        };
        format!(
            "[design]\nkind = \"sections\"\n{sections}[field]\nuniform_mt = {}\n\
             gradient_t_per_m = [{:e}, {:e}, {:e}, {:e}, {:e}]\n[gravity]\nacceleration_m_s2 = {}\n[load]\n\
             tip_force_n = {}\n[base]\n{}[magnet]\n{}cylinders = [{{ radius_mm = 15.0, inner_radius_mm = 0.0, \
             length_mm = 20.0, offset_mm = 0.0, remanence_t = {remanence:e} }}]\n[model]\ninteraction = \"{}\"\n\
             tolerance_position_mm = 1e-6\ntolerance_angle_deg = 1e-6\ntolerance_relative = 0.0\ntime_budget_s = 60.0\n",
            list(field),
            g[(0, 0)],
            g[(0, 1)],
            g[(0, 2)],
            g[(1, 1)],
            g[(1, 2)],
            list(gravity),
            list(force),
            pose(base),
            pose(placed),
            self.level
        )
    }
}

impl Section {
    fn random(random: &mut StdRng, rigid: bool) -> Self {
        let mut between = |low: f64, high: f64| random.random_range(low..high);
        let outer = between(0.5, 0.8);
        let taper = if rigid { 1.0 } else { between(0.8, 1.0) };
        let own = Self {
            length: if rigid { between(1.5, 3.0) } else { between(6.0, 14.0) },
            outer: [outer, taper * outer],
            inner: between(0.0, 0.25),
            modulus: (!rigid).then(|| between(1.0, 4.0)),
            remanence: if rigid { between(-1.3, 1.3) } else { between(-0.1, 0.1) },
            direction: Vector3::z(),
            turn: if rigid { 0.0 } else { between(-8.0, 8.0) },
            rest: Vector3::zeros(),
        };
        let rest = if rigid { 0.0 } else { between(0.0, 40.0) };
        Self { direction: direction(random), rest: direction(random) * rest, ..own }
    }

    fn text(&self) -> String {
        let Self { length, outer: [start, end], inner, remanence, direction: d, turn, rest: u, .. } = self;
        let body = self.modulus.map_or("rigid = true\n".to_owned(), |modulus| {
            format!(
                "elastic_modulus_mpa = {modulus:e}\npoisson = 0.45\ndirection_turn_deg_per_mm = {turn:e}\n\
                 rest_curvature_per_m = [{:e}, {:e}, {:e}]\n",
                u.x, u.y, u.z
            )
        });
        let outer = if start.to_bits() == end.to_bits() {
            format!("{start:e}")
        } else {
            format!("[{start:e}, {end:e}]")
        };
        format!(
            "[[design.section]]\nlength_mm = {length:e}\nouter_radius_mm = {outer}\ninner_radius_mm = {inner:e}\n{body}\
             remanence_t = {remanence:e}\ndirection = [{:e}, {:e}, {:e}]\n",
            d.x, d.y, d.z
        )
    }
}

impl Loads {
    fn random(random: &mut StdRng) -> Self {
        let field = direction(random) * random.random_range(2.0..8.0);
        let lean = direction(random);
        // Symmetric and without trace.
        let gradient = (lean * lean.transpose() - Matrix3::identity() / 3.0) * random.random_range(0.0..0.1);
        let turn = direction(random);
        let position = Vector3::new(random.random_range(0.06..0.09), -0.02, 0.01);
        let [x, y, z] = turn.into();
        Self {
            field,
            gradient,
            gravity: direction(random) * 9.81,
            force: direction(random) * 1e-4,
            base: Pose::new([1e-3, -2e-3, 3e-3], [1.0, 0.0, 0.0, 0.0]).expect("a pose"),
            magnet: (Pose::new(position.into(), [0.0, x, y, z]).expect("a unit quaternion"), 1.1),
        }
    }
}

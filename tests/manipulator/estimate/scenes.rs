//! Random scenes of every level, with the error that is told and the error that is.

use mcm::design::{Design, Segmented, Specification, SpiralKind};
use mcm::equilibrium::{Equilibrium, Interaction, Settings, Solution, TipDeviation};
use mcm::geometry::RotationVector;
use mcm::manipulator::{Inputs, Manipulator, Status};
use nalgebra::Vector3;
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};

use crate::given::{pair, unloaded_beside_pair};

/// The levels and their shares.
const LEVELS: [(Interaction, f64); 5] = [
    (Interaction::None, 0.15),
    (Interaction::Preceding, 0.1),
    (Interaction::Rings, 0.35),
    (Interaction::Full, 0.2),
    (Interaction::Auto, 0.2),
];

/// Strain degree and pair accuracy of a converged answer.
const CONVERGED: (usize, f64) = (7, 1e-9);

/// Distance of the tips over the length from which on two answers are different shapes.
pub(crate) const ANOTHER_SHAPE: f64 = 0.05;

/// A design, what acts on it, and a level.
pub(crate) struct Scene {
    pub(crate) design: Design,
    pub(crate) inputs: Inputs,
    pub(crate) settings: Settings,
}

/// What is told of an answer, and what is true.
#[derive(Debug)]
pub(crate) struct Told {
    /// Number of the scene.
    pub(crate) number: u64,
    /// Level asked for.
    pub(crate) level: Interaction,
    /// Level and degree of the model that answered.
    pub(crate) answered: (Interaction, usize),
    /// Segments.
    pub(crate) segments: usize,
    /// Largest bend of a core, deg.
    pub(crate) bend: f64,
    /// Stability margin.
    pub(crate) margin: f64,
    /// Error of the tip that is told over the length.
    pub(crate) estimate: f64,
    /// Error of the tip over the length.
    pub(crate) error: f64,
    /// Tolerance over the length.
    pub(crate) tolerance: f64,
}

impl Scene {
    /// By number: the same number, the same scene; of at most so many segments.
    pub(crate) fn random(number: u64, segments: usize) -> Self {
        let mut random = StdRng::seed_from_u64(number);
        let design = loop {
            if let Ok(design) = Design::new(specification(&mut random, segments)) {
                break design;
            }
        };
        let mut share: f64 = random.random_range(0.0..1.0);
        let level = LEVELS.iter().find(|(_, part)| {
            share -= part;
            share < 0.0
        });
        let settings = Settings {
            interaction: level.map_or(Interaction::Auto, |level| level.0),
            bending_stop: random.random_bool(0.3).then_some(true),
            ..Settings::default()
        };
        Self { inputs: inputs(&mut random, &design), design, settings }
    }

    /// What is told of it; `None` where no equilibrium is found.
    pub(crate) fn told(&self, number: u64) -> Option<Told> {
        let magnet = pair();
        let mut own = Manipulator::new(&self.design, Some(&magnet), self.settings, 2).ok()?;
        let answer = own.solve(&self.inputs).ok()?.clone();
        let auto = self.settings.interaction == Interaction::Auto;
        let (degree, pair_accuracy) = CONVERGED;
        let converged = Settings {
            interaction: if auto { Interaction::Full } else { self.settings.interaction },
            bending_stop: Some(self.settings.has_bending_stop()),
            degree,
            pair_accuracy,
            time_budget: 30.0,
            ..self.settings
        };
        let mut exact = Equilibrium::new(&self.design, Some(&magnet), converged, 2).ok()?;
        let solved = exact.solve(&self.inputs).ok()?.solved();
        let length = self.design.length();
        let error = TipDeviation::between(&exact.tip(), &answer.tip).distance / length;
        (answer.status != Status::NotSolved && solved).then(|| Told {
            number,
            level: self.settings.interaction,
            answered: (answer.interaction, answer.degree),
            segments: self.design.segments().len(),
            bend: answer.core_angles.iter().copied().fold(0.0, f64::max).to_degrees(),
            margin: answer.stability_margin,
            estimate: answer.error_estimate / length,
            error,
            tolerance: self.settings.tolerance_position / length,
        })
    }
}

impl Told {
    /// The columns of [`Told::line`].
    pub(crate) const HEADER: &str =
        "scene,level,answered,degree,segments,bend_deg,margin,estimate,error,tolerance";

    /// The numbers as a line of CSV.
    pub(crate) fn line(&self) -> String {
        format!(
            "{},{},{},{},{},{:.2},{:.4},{:.3e},{:.3e},{:.3e}",
            self.number,
            self.level.name(),
            self.answered.0.name(),
            self.answered.1,
            self.segments,
            self.bend,
            self.margin,
            self.estimate,
            self.error,
            self.tolerance
        )
    }
}

fn specification(random: &mut StdRng, segments: usize) -> Specification {
    let mut out = Segmented::paper(random.random_range(1..=segments));
    out.base_magnet = random.random_bool(0.8);
    out.tip_magnet = random.random_bool(0.8);
    out.spiral = if random.random_bool(0.5) { SpiralKind::Helical } else { SpiralKind::Axisymmetric };
    out.helix.length = random.random_range(3e-3..6.5e-3);
    out.helix.boundary_angle = random.random_range(0.4..0.9);
    out.helix.shore_a = random.random_range(20.0..60.0);
    Specification::Segmented(out)
}

/// Half of them by the magnet, near or far; the others in a field that may be turned against the manipulator.
fn inputs(random: &mut StdRng, design: &Design) -> Inputs {
    let mut inputs = unloaded_beside_pair(design.rings().count());
    let vector = |random: &mut StdRng, size: f64| Vector3::from_fn(|_, _| random.random_range(-size..=size));
    let across = Vector3::new(random.random_range(-1.0..=1.0), -1.0, 0.0).normalize();
    if random.random_bool(0.5) {
        // Beside the manipulator, its field along the magnetisation, and slanted.
        let turn = RotationVector::new(vector(random, 0.5)).matrix();
        inputs.sources[0].pose.rotation = turn * RotationVector::new(across * core::f64::consts::PI).matrix();
        let middle = Vector3::z() * (0.5 * design.length());
        inputs.sources[0].pose.position = middle + across * random.random_range(0.0625..0.2);
        inputs.sources[0].strength = 1.0;
    } else {
        let (sine, cosine) = random.random_range(0.0..2.6_f64).sin_cos();
        inputs.uniform_field = (across * sine + Vector3::z() * cosine) * random.random_range(1e-3..0.05);
    }
    if random.random_bool(0.4) {
        inputs.gravity = vector(random, 9.81);
        inputs.tip_force = vector(random, 5e-3);
    }
    if random.random_bool(0.2) {
        inputs.tip_moment = vector(random, 1e-5);
    }
    inputs
}

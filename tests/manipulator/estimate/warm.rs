//! Warm steps of `auto` along random ways on which the loads rise and fall again, with the error that is told and the error that is.

use core::f64::consts::PI;

use mcm::equilibrium::{Equilibrium, Interaction, Settings, Solution, TipDeviation};
use mcm::geometry::RotationVector;
use mcm::manipulator::{Inputs, Manipulator, Status};
use nalgebra::Vector3;
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};

use super::scenes::{ANOTHER_SHAPE, Scene};
use crate::given::pair;

/// Steps of a way, of which one of so many is compared.
const STEPS: u32 = 48;
const EACH: u32 = 2;

/// Ratio of what is told to what is true above which an estimate is too pessimistic.
const PESSIMISM: f64 = 5.0;

/// Loads at both ends of a way, relative to those in its middle.
const LEAST_LOAD: f64 = 0.6;

/// Strain degree and pair accuracy of a converged answer.
const CONVERGED: (usize, f64) = (6, 1e-8);

/// A scene, and the turn (rad) of its magnet or field along the way.
pub(crate) struct Way {
    scene: Scene,
    turn: Vector3<f64>,
}

/// What is told of a warm step, and what is true, over the length.
#[derive(Debug)]
pub(crate) struct Warm {
    /// Number of the way, and of the step.
    pub(crate) at: (u64, u32),
    /// Level and degree of the model that answered.
    pub(crate) answered: (Interaction, usize),
    /// Error of the tip that is told.
    pub(crate) estimate: f64,
    /// Error of the tip.
    pub(crate) error: f64,
    /// Tolerance of the position.
    pub(crate) tolerance: f64,
}

impl Way {
    /// By number: the same number, the same way; of at most so many segments. One of two has a tolerance other than the default.
    pub(crate) fn random(number: u64, segments: usize) -> Self {
        let mut scene = Scene::random(number, segments);
        let mut random = StdRng::seed_from_u64(!number);
        let size = random.random_range(0.0..0.4);
        let turn = Vector3::from_fn(|_, _| random.random_range(-size..=size));

        scene.settings = Settings {
            interaction: Interaction::Auto,
            bending_stop: None,
            time_budget: 600.0, // what is compared must not depend on the machine
            ..scene.settings
        };
        if random.random_bool(0.5) {
            let tolerance_position = 10_f64.powf(random.random_range(-5.0..-3.0));
            scene.settings = Settings {
                tolerance_position,
                tolerance_angle: 100.0 * tolerance_position,
                tolerance_relative: 0.0,
                ..scene.settings
            };
        }
        Self { scene, turn }
    }

    fn at(&self, part: f64) -> Inputs {
        let mut out = self.scene.inputs.clone();
        let load = LEAST_LOAD + (1.0 - LEAST_LOAD) * (PI * part).sin();
        let turn = RotationVector::new(self.turn * part).matrix();
        for source in &mut out.sources {
            source.strength *= load;
            source.pose.rotation = turn * source.pose.rotation;
        }
        out.uniform_field = turn * out.uniform_field * load;
        for of in [&mut out.tip_force, &mut out.tip_moment, &mut out.gravity] {
            *of *= load;
        }
        out
    }

    /// The warm steps up to the first where either has no shape, or another one.
    pub(crate) fn told(&self, number: u64) -> Vec<Warm> {
        let Scene { design, settings, .. } = &self.scene;
        let (degree, pair_accuracy) = CONVERGED;
        let converged = Settings {
            interaction: Interaction::Full,
            bending_stop: Some(true),
            degree,
            pair_accuracy,
            ..*settings
        };
        let magnet = pair();
        let mut own = Manipulator::new(design, Some(&magnet), *settings, 2).expect("an allowed scene");
        let mut exact = Equilibrium::new(design, Some(&magnet), converged, 2).expect("an allowed scene");

        let mut out = Vec::new();
        for step in 0..STEPS {
            let inputs = self.at(f64::from(step) / f64::from(STEPS));
            let answer = own.solve(&inputs).expect("finite inputs").clone();
            if answer.status == Status::NotSolved {
                break;
            }
            if step % EACH != EACH - 1 {
                continue;
            }
            if !exact.solve(&inputs).expect("finite inputs").solved() {
                break;
            }
            let error = TipDeviation::between(&exact.tip(), &answer.tip).distance / design.length();
            if error > ANOTHER_SHAPE {
                break;
            }
            out.push(Warm {
                at: (number, step),
                answered: (answer.interaction, answer.degree),
                estimate: answer.error_estimate / design.length(),
                error,
                tolerance: settings.tolerance_position / design.length(),
            });
        }
        out
    }
}

impl Warm {
    /// The columns of [`Warm::line`].
    pub(crate) const HEADER: &str = "way,step,answered,degree,estimate,error,tolerance";

    /// The numbers as a line of CSV.
    pub(crate) fn line(&self) -> String {
        format!(
            "{},{},{},{},{:.3e},{:.3e},{:.3e}",
            self.at.0,
            self.at.1,
            self.answered.0.name(),
            self.answered.1,
            self.estimate,
            self.error,
            self.tolerance
        )
    }

    /// Whether more is told than [`PESSIMISM`] times what is true.
    pub(crate) fn is_pessimistic(&self) -> bool {
        self.estimate > PESSIMISM * self.error
    }
}

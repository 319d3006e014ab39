//! Time saved by the level `auto`: time and error of its models, and of `auto` by tolerance, along paths of inputs.
//!
//! The times are measured, as in [`super::accuracy()`].

use std::time::Instant;

use serde::Serialize;

use super::progress::Progress;
use super::scenes::{PAIR, later};
use crate::equilibrium::{Interaction, Settings};
use crate::error::Error;
use crate::manipulator::{Followed, Inputs, Scene, Status, models_of_auto};
use crate::methods::Device;

/// Name, number of segments and field of each scene.
pub(super) const SCENES: [(&str, usize, &str); 4] = [
    ("1 segment, 10 mT turning", 1, "[field]\nuniform_mt = [0, 10, 0]"),
    ("1 segment, pair passing", 1, PAIR),
    ("3 segments, pair passing", 3, PAIR),
    ("9 segments, pair passing", 9, PAIR),
];

/// Number of steps at 1 kHz, forth and as many back.
const STEPS: u32 = 100;

/// Number of steps between two evaluations of the error.
const LOOKS: usize = 10;

/// Number of times that every model of a scene is timed, in turn; the fastest run counts, because other load on the machine only adds
/// time.
const ROUNDS: usize = 5;

/// Tolerances of the tip's position over the length, and, in radians, of its angle.
const TOLERANCES: [f64; 7] = [1e-1, 3e-2, 1e-2, 3e-3, 1e-3, 1e-4, 1e-5];

/// Time and error of one model, or of `auto` with a tolerance, along one path.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Fidelity {
    /// The scene.
    pub scene: &'static str,
    /// The model, or `auto`.
    pub model: String,
    /// Tolerance of `auto`, over the length.
    pub tolerance: Option<f64>,
    /// Mean time of a step with all outputs, microseconds.
    pub time_us: f64,
    /// Mean time of a step, relative to the richest model.
    pub time_relative: f64,
    /// Largest error of the tip's position over the length, against a finer discretisation of the richest model.
    pub tip_over_length: f64,
    /// Largest error of the tip's angle, deg.
    pub angle_deg: f64,
}

/// All models along all paths. The scenes run one after the other, so that they do not
/// disturb each other's times.
///
/// # Errors
/// None for these scenes; those of the solves are passed on.
pub fn fidelity(progress: &dyn Progress) -> Result<Vec<Fidelity>, Error> {
    let mut out = Vec::new();
    for (name, segments, field) in SCENES {
        let text = format!("{field}\n[design]\nsegments = {segments}\n[model]\nbending_stop = true");
        out.extend(Walk::new(name, &Scene::parse(&text, name)?)?.models(progress)?);
    }
    Ok(out)
}

/// A scene with the inputs of each step of its path.
pub(super) struct Walk {
    name: &'static str,
    scene: Scene,
    length: f64,
    path: Vec<Inputs>,
}

/// Result of a path: time of a step (s), largest errors of the tip position over the length and of the tip angle (rad).
pub(super) struct Shown {
    pub(super) time: f64,
    pub(super) tip: f64,
    pub(super) angle: f64,
}

impl Walk {
    pub(super) fn new(name: &'static str, scene: &Scene) -> Result<Self, Error> {
        let path = (0..STEPS).chain((1..=STEPS).rev()).map(|step| later(&scene.inputs, step)).collect();
        Ok(Self { name, scene: scene.clone(), length: scene.design()?.length(), path })
    }

    fn models(&self, progress: &dyn Progress) -> Result<Vec<Fidelity>, Error> {
        let base = self.scene.settings;
        let models = models_of_auto(&base, true);
        let mut rows = Vec::new();

        for settings in &models {
            let Settings { interaction, degree, pair_accuracy, .. } = settings;
            let model = format!("{}, degree {degree}, pairs {pair_accuracy:.0e}", interaction.name());
            rows.push((model, None, settings.as_discretised()));
        }

        for tolerance in TOLERANCES {
            let (tolerance_position, tolerance_angle) = (tolerance * self.length, tolerance);
            let settings = Settings {
                interaction: Interaction::Auto,
                tolerance_position,
                tolerance_angle,
                tolerance_relative: 0.0,
                ..base
            };
            rows.push(("auto".to_owned(), Some(tolerance), settings));
        }

        // Errors are counted from a model one refinement above the richest that is timed.
        let richest = models.last().copied().unwrap_or(base).as_discretised();
        progress.more(rows.len());

        let scenes: Vec<Scene> = rows.iter().map(|row| self.with(row.2)).collect();
        let shown = self.follow(&scenes, &self.with(richest.refined()), progress)?;
        let whole = shown.get(models.len() - 1).map_or(f64::NAN, |shown| shown.time);

        let row = |((model, tolerance, _), shown): ((String, Option<f64>, Settings), Shown)| Fidelity {
            scene: self.name,
            model,
            tolerance,
            time_us: 1e6 * shown.time,
            time_relative: shown.time / whole,
            tip_over_length: shown.tip,
            angle_deg: shown.angle.to_degrees(),
        };
        Ok(rows.into_iter().zip(shown).map(row).collect())
    }

    /// Follows the path with each model: its errors against the model `reference`, and its time.
    pub(super) fn follow(
        &self,
        models: &[Scene],
        reference: &Scene,
        progress: &dyn Progress,
    ) -> Result<Vec<Shown>, Error> {
        let mut followed = Vec::new();
        for model in models {
            let mut device = Device::of(model, 2)?;
            let shown = self.errors(&mut device, reference)?;
            followed.push((device, shown));
            progress.done();
        }
        for _ in 0..ROUNDS {
            for (device, shown) in &mut followed {
                let begin = Instant::now();
                for inputs in &self.path {
                    device.solve(inputs)?;
                }
                shown.time = shown.time.min(begin.elapsed().as_secs_f64() / self.path.len() as f64);
            }
        }
        Ok(followed.into_iter().map(|(_, shown)| shown).collect())
    }

    /// Errors of a device along the path against the model `reference`, without a time.
    fn errors(&self, own: &mut Device, reference: &Scene) -> Result<Shown, Error> {
        let mut reference = Device::of(reference, 2)?;
        let mut shown = Shown { time: f64::INFINITY, tip: 0.0, angle: 0.0 };
        for (step, inputs) in self.path.iter().enumerate() {
            let answer = own.solve(inputs)?;
            if step % LOOKS == 0 {
                let exact = reference.solve(inputs)?;
                let solved = [answer, exact].iter().all(|outputs| outputs.status != Status::NotSolved);
                let (a, b) = (&answer.tip, &exact.tip);
                let apart = (a.position - b.position).norm() / self.length;
                shown.tip = if solved { shown.tip.max(apart) } else { f64::NAN };
                shown.angle = shown.angle.max(a.axis().angle(&b.axis()));
            }
        }
        Ok(shown)
    }

    fn with(&self, settings: Settings) -> Scene {
        Scene { settings, ..self.scene.clone() }
    }
}

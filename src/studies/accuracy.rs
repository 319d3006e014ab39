//! Error against time of all methods, by resolution, pair quadrature and interaction level, from reference solutions.
//!
//! The times are measured: they are those of one machine at one moment.

use std::time::{Duration, Instant};

use nalgebra::Vector3;
use serde::Serialize;

use super::PATIENCE;
use super::progress::Progress;
use super::scenes::{LEVELS, PAIR, SEGMENTS, later};
use crate::equilibrium::{Interaction, Settings};
use crate::error::Error;
use crate::manipulator::{Followed, Inputs, Outputs, Scene, Status};
use crate::methods::{self, Device, Method};

/// Name and scene text of each field: 10 mT at 90 and 150 deg from the axis, and the exact magnet pair beside it.
const FIELDS: [(&str, &str); 3] = [
    ("uniform 90 deg", "[field]\nuniform_mt = [0, 10, 0]"),
    ("uniform 150 deg", "[field]\nuniform_mt = [0, 5, -8.660254038]"),
    ("pair", PAIR),
];

/// Centreline points of the outputs, as many as the FMU has by default.
const SHAPE_POINTS: usize = 21;

/// Number of warm steps before the inputs turn back, large enough that the easily predicted reversal has little weight.
const STEPS: u32 = 8;

/// Number of times that all trials of a scene are measured, seconds apart, and within each the maximum number of timed repetitions and their
/// time budget. The shortest time per solve counts, because other load on the machine only adds time.
const ROUNDS: usize = 3;
const MOST_REPETITIONS: usize = 101;
const BUDGET: Duration = Duration::from_millis(20);

/// Degree and pair accuracy of the reference, and of a coarser solution: their difference is the uncertainty.
const REFERENCE: (usize, f64) = (8, 1e-10);
const COARSER: (usize, f64) = (7, 5e-10);

/// Pair accuracy of the finest points that are measured.
const FINEST_PAIRS: f64 = 1e-8;

/// Residual of the collocation that checks the reference, at the interaction levels that it supports.
const CONFIRMING_RESIDUAL: f64 = 1e-8;

/// Tip distance over the length from which two shapes are different equilibria; collocation ignores stability and may
/// find either.
const ANOTHER_SHAPE: f64 = 1e-2;

/// Time and errors of one method in one scene.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Point {
    /// The field.
    pub field: &'static str,
    /// Number of segments.
    pub segments: usize,
    /// Length of the manipulator, mm.
    pub length_mm: f64,
    /// Level of interaction of the reference.
    pub interaction: &'static str,
    /// `cold` from the straight shape or `warm` after a small step of the inputs.
    pub start: &'static str,
    /// The method, or the level of interaction if it differs from that of the reference.
    pub name: &'static str,
    /// Resolution of the method, in words.
    pub resolution: String,
    /// Shortest time of a solve with all outputs, microseconds; `None` if it did not solve.
    pub time_us: Option<f64>,
    /// Error of the tip's position over the length.
    pub tip_over_length: Option<f64>,
    /// Error of the tip's angle, deg.
    pub angle_deg: Option<f64>,
    /// Error of the magnetic force plus that of the torque over the length, relative to the same sum of the reference.
    pub wrench_relative: Option<f64>,
    /// Uncertainty of the reference's tip position over the length.
    pub reference_over_length: Option<f64>,
}

impl Point {
    /// Time (us) and tip error over the length, at least the reference's uncertainty; `None` if it did not solve.
    #[must_use]
    pub fn place(&self) -> Option<[f64; 2]> {
        Some([self.time_us?, self.tip_over_length?.max(self.reference_over_length?)])
    }

    /// Whether both solve the same scene from the same start.
    #[must_use]
    pub fn beside(&self, other: &Self) -> bool {
        let case = |point: &Self| (point.field, point.segments, point.interaction, point.start);
        case(self) == case(other)
    }
}

/// Pareto front in time and error of points of one scene and start, fastest first.
#[must_use]
pub fn front<'a>(points: impl IntoIterator<Item = &'a Point>) -> Vec<&'a Point> {
    let mut solved: Vec<(&Point, [f64; 2])> =
        points.into_iter().filter_map(|point| Some((point, point.place()?))).collect();
    solved.sort_by(|a, b| a.1[0].total_cmp(&b.1[0]));
    let mut best = f64::INFINITY;
    solved.retain(|(_, [_, error])| {
        let better = *error < best;
        best = best.min(*error);
        better
    });
    solved.into_iter().map(|(point, _)| point).collect()
}

/// A method with its settings.
struct Trial {
    name: &'static str,
    resolution: String,
    settings: Settings,
    solver: methods::Settings,
}

/// A scene with the inputs of its warm steps.
struct Case {
    field: &'static str,
    segments: usize,
    scene: Scene,
    /// Inputs of the steps at 1 kHz, away from the scene's inputs and back to them, where the errors are evaluated.
    walk: Vec<Inputs>,
    length: f64,
}

/// All points of 27 cases, with cold and warm solves in one thread. A case without a
/// reference, as where the rings snap together, has one point without numbers.
///
/// # Errors
/// None for these scenes; those of the solves are passed on.
pub fn accuracy(progress: &dyn Progress) -> Result<Vec<Point>, Error> {
    progress.more(Case::COUNT);
    let mut points = Vec::new();
    for (field, table) in FIELDS {
        for segments in SEGMENTS {
            for level in LEVELS {
                points.extend(Case::new(field, table, segments, level)?.points()?);
                progress.done();
            }
        }
    }
    Ok(points)
}

impl Case {
    /// Number of cases.
    const COUNT: usize = FIELDS.len() * SEGMENTS.len() * LEVELS.len();

    fn new(field: &'static str, table: &str, segments: usize, level: Interaction) -> Result<Self, Error> {
        let model = format!("[model]\ninteraction = \"{}\"", level.name());
        let mut scene = Scene::parse(&format!("{table}\n[design]\nsegments = {segments}\n{model}"), field)?;
        scene.settings = scene.settings.as_discretised();
        let walk = (1..=STEPS).chain((0..STEPS).rev()).map(|step| later(&scene.inputs, step)).collect();
        let length = scene.design()?.length();
        Ok(Self { field, segments, scene, walk, length })
    }

    fn points(&self) -> Result<Vec<Point>, Error> {
        let base = self.scene.settings;

        let fine = |(degree, pair_accuracy)| Settings {
            degree,
            pair_accuracy,
            fine_stations: true,
            time_budget: PATIENCE,
            ..base
        };

        let (Some(reference), Some(coarser)) =
            (self.reference(fine(REFERENCE))?, self.reference(fine(COARSER))?)
        else {
            return Ok(vec![self.empty("reference", "not solved", "cold")]);
        };

        // The reference is as uncertain as it is far from a coarser one, and from that of an independent
        // method.
        let mut uncertainty = self.tip_error(&coarser, &reference);
        if Method::Collocation.supports(base.interaction) {
            let solver = methods::Settings {
                method: Method::Collocation,
                mesh_tolerance: CONFIRMING_RESIDUAL,
                tolerance: 1e-11,
                ..methods::Settings::default()
            };
            let mut manipulator = self.device(fine(REFERENCE), solver)?;
            let outputs = manipulator.solve(&self.scene.inputs)?;
            let apart = self.tip_error(outputs, &reference);
            if outputs.status != Status::NotSolved && apart < ANOTHER_SHAPE {
                uncertainty = uncertainty.max(apart);
            }
        }

        let mut points = self.round(&reference, uncertainty)?;

        // The least time of several rounds: other work on the machine can only add to it.
        for _ in 1..ROUNDS {
            for (point, again) in points.iter_mut().zip(self.round(&reference, uncertainty)?) {
                point.time_us = point.time_us.zip(again.time_us).map(|(time, again)| time.min(again));
            }
        }

        Ok(points)
    }

    /// Every trial once, cold and warm.
    fn round(&self, reference: &Outputs, uncertainty: f64) -> Result<Vec<Point>, Error> {
        let mut points = Vec::new();
        for trial in trials(self.scene.settings) {
            for start in ["cold", "warm"] {
                points.push(self.point(&trial, start, reference, uncertainty)?);
            }
        }
        Ok(points)
    }

    fn device(&self, settings: Settings, solver: methods::Settings) -> Result<Device, Error> {
        Device::new(&Scene { settings, ..self.scene.clone() }, solver, SHAPE_POINTS)
    }

    fn reference(&self, settings: Settings) -> Result<Option<Outputs>, Error> {
        let mut manipulator = self.device(settings, methods::Settings::default())?;
        let outputs = manipulator.solve(&self.scene.inputs)?;
        Ok((outputs.status != Status::NotSolved).then(|| outputs.clone()))
    }

    /// A point without numbers.
    fn empty(&self, name: &'static str, resolution: &str, start: &'static str) -> Point {
        Point {
            field: self.field,
            segments: self.segments,
            length_mm: 1e3 * self.length,
            interaction: self.scene.settings.interaction.name(),
            start,
            name,
            resolution: resolution.into(),
            time_us: None,
            tip_over_length: None,
            angle_deg: None,
            wrench_relative: None,
            reference_over_length: None,
        }
    }

    fn tip_error(&self, outputs: &Outputs, reference: &Outputs) -> f64 {
        (outputs.tip.position - reference.tip.position).norm() / self.length
    }

    fn point(
        &self,
        trial: &Trial,
        start: &'static str,
        reference: &Outputs,
        uncertainty: f64,
    ) -> Result<Point, Error> {
        let mut manipulator = self.device(trial.settings, trial.solver)?;
        let warm = start == "warm";
        let walk = if warm { &self.walk[..] } else { std::slice::from_ref(&self.scene.inputs) };

        // Solved once before the clock starts: a warm device begins there.
        let mut solved = manipulator.solve(&self.scene.inputs)?.status != Status::NotSolved;

        let (begin, mut count, mut time) = (Instant::now(), 0, f64::INFINITY);
        while count == 0 || (count < MOST_REPETITIONS && begin.elapsed() < BUDGET) {
            if !warm {
                manipulator.reset();
            }
            let start = Instant::now();
            for inputs in walk {
                solved &= manipulator.solve(inputs)?.status != Status::NotSolved;
            }
            (count, time) = (count + 1, time.min(start.elapsed().as_secs_f64() / walk.len() as f64));
        }

        let outputs = manipulator.outputs();
        let point = self.empty(trial.name, &trial.resolution, start);
        if !solved {
            return Ok(Point { reference_over_length: Some(uncertainty), ..point });
        }

        let wrench = |a: &Outputs, b: Option<&Outputs>| {
            let other = |pick: fn(&Outputs) -> Vector3<f64>| b.map_or_else(Vector3::zeros, pick);
            (a.magnetic_force - other(|o| o.magnetic_force)).norm()
                + (a.magnetic_torque - other(|o| o.magnetic_torque)).norm() / self.length
        };

        Ok(Point {
            time_us: Some(1e6 * time),
            tip_over_length: Some(self.tip_error(outputs, reference)),
            angle_deg: Some((outputs.tip_angle - reference.tip_angle).abs().to_degrees()),
            wrench_relative: Some(wrench(outputs, Some(reference)) / wrench(reference, None)),
            reference_over_length: Some(uncertainty),
            ..point
        })
    }
}

/// All methods and resolutions for a scene with the interaction level of `base`.
fn trials(base: Settings) -> Vec<Trial> {
    let level = base.interaction;
    let mut out = Vec::new();
    let default = methods::Settings::default();
    let mut add = |name, resolution: String, settings, solver| {
        out.push(Trial { name, resolution, settings, solver });
    };
    // Without pair interaction, the pair accuracy affects only the rings in the magnet's field.
    let every = [1e-2, 1e-3, 1e-5, 1e-7];
    let own = [base.pair_accuracy];
    let accuracies = if level == Interaction::None { &own[..] } else { &every };
    for degree in [0, 2, 4, 6] {
        for &pair_accuracy in accuracies {
            let resolution = format!("degree {degree}, pairs {pair_accuracy:.0e}");
            add("potential", resolution, Settings { degree, pair_accuracy, ..base }, default);
        }
    }
    // Beyond the pairs, the stations of the external field limit the accuracy.
    for degree in [4, 6] {
        let settings = Settings { degree, pair_accuracy: FINEST_PAIRS, fine_stations: true, ..base };
        let resolution = format!("degree {degree}, pairs {FINEST_PAIRS:.0e}, fine stations");
        add("potential", resolution, settings, default);
    }
    for (method, name) in Method::ALL.iter().filter(|row| row.0.supports(level)) {
        let default = methods::Settings { method: *method, ..default };
        match method {
            Method::Potential => {}
            Method::ConstantCurvature => add(name, "one arc a core".into(), base, default),
            Method::Collocation => {
                for mesh_tolerance in [1e-1, 1e-2, 1e-3, 1e-4, 1e-5] {
                    let resolution = format!("residual {mesh_tolerance:.0e}");
                    add(name, resolution, base, methods::Settings { mesh_tolerance, ..default });
                }
            }
            _ => {
                for steps in [2, 4, 8, 16, 32] {
                    add(name, format!("{steps} steps a core"), base, methods::Settings { steps, ..default });
                }
            }
        }
    }
    if level == Interaction::Full {
        for (name, interaction) in [("level none", Interaction::None), ("level rings", Interaction::Rings)] {
            add(name, "degree 2".into(), Settings { interaction, ..base }, default);
        }
    }
    out
}

//! How far the magnet may move in one communication step before the result depends on the step.

use core::f64::consts::{FRAC_PI_4, PI};

use nalgebra::Vector3;
use rayon::prelude::*;

use super::experiment::{SEGMENTS, magnet_pair};
use super::hysteresis;
use super::progress::Progress;
use super::study::{Column, Comparison, Study, Value};
use crate::design::{Design, Specification};
use crate::equilibrium::{Interaction, Settings};
use crate::error::Error;
use crate::geometry::{Pose, RotationVector};
use crate::manipulator::{Inputs, Manipulator, PlacedSource, Status};

/// Numbers of steps along a path, from a single jump to the reference.
const STEPS: [u32; 13] = [1, 2, 3, 4, 5, 7, 10, 20, 50, 100, 200, 500, FINEST];
const FINEST: u32 = 1000;

/// Tip distance up to which two shapes count as equal, mm: the error that the residuals of two solves leave.
const SAME: f64 = 1e-7;

/// Distance of the magnet's axis from the manipulator's, m, as in the demonstration.
const DISTANCE: f64 = 0.14;

/// Travel of the demonstration's magnet to each side of the manipulator's middle, and position of that middle, m.
const TRAVEL: f64 = 0.18;
const MIDDLE: f64 = 0.023;

/// A path of the magnet.
struct Way {
    name: &'static str,
    /// Description of the path.
    remark: &'static str,
    /// The manipulator, solved at the beginning of the path.
    manipulator: Manipulator,
    /// Inputs at a fraction of the path's duration, from 0 to 1.
    inputs: Box<dyn Fn(f64) -> Inputs + Sync>,
}

/// Result of following a path.
struct Walked {
    /// Longest step of the magnet, mm.
    step: f64,
    /// Number of snaps reported.
    snaps: u32,
    /// Number of steps that were not solved; the path continues from the last good shape.
    refused: u32,
    tip: Vector3<f64>,
}

/// The paper's magnet pair moves along fixed paths beside nine segments, at the level `rings`, in few and in many
/// steps; each step is one solve at the pose at its end.
///
/// # Errors
/// None for the paper's design; those of the solves are passed on.
pub fn communication_step(progress: &dyn Progress) -> Result<Study, Error> {
    let ways = ways()?;
    let walks: Vec<(usize, u32)> = (0..ways.len()).flat_map(|way| STEPS.map(|steps| (way, steps))).collect();

    progress.more(walks.iter().map(|(_, steps)| *steps as usize).sum());
    let walked = walks.par_iter().map(|&(way, steps)| ways[way].walked(steps, progress));
    let walked = walked.collect::<Result<Vec<Walked>, Error>>()?;

    let mut columns = vec![Column::new("steps", STEPS.iter().map(|&steps| f64::from(steps)).collect())];
    let mut comparison = Vec::new();
    for (way, walked) in ways.iter().zip(walked.chunks(STEPS.len())) {
        let finest = &walked[STEPS.len() - 1];
        let apart = |walked: &Walked| 1e3 * (walked.tip - finest.tip).norm();

        let mut add = |quantity: &str, value: &dyn Fn(&Walked) -> f64| {
            let name = quantity.replace("WAY", &way.name.replace(' ', "_"));
            columns.push(Column::new(name, walked.iter().map(value).collect()));
        };
        add("WAY_step_mm", &|walked| walked.step);
        add("WAY_apart_mm", &apart);
        add("snaps_WAY", &|walked| f64::from(walked.snaps));
        add("refused_WAY", &|walked| f64::from(walked.refused));

        let same =
            |walked: &Walked| walked.refused == 0 && apart(walked) <= SAME && walked.snaps == finest.snaps;
        let fine = walked.iter().rev().take_while(|walked| same(walked)).map(|walked| walked.step);
        comparison.push(Comparison {
            quantity: format!(
                "{}: longest step of the magnet up to which nothing depends on it (mm)",
                way.name
            ),
            decimals: 1,
            paper: Value::Absent,
            printed: Value::Absent,
            exact: Value::Number(fine.fold(0.0, f64::max)),
            remark: format!(
                "{}; snaps on it: {}; no such experiment is in the paper",
                way.remark, finest.snaps
            ),
        });
    }

    Ok(Study { columns, marks: Vec::new(), comparison })
}

impl Way {
    /// Follows the path in the given number of steps.
    fn walked(&self, steps: u32, progress: &dyn Progress) -> Result<Walked, Error> {
        let mut manipulator = self.manipulator.clone();
        let before = manipulator.outputs().snaps;
        let mut magnet = (self.inputs)(0.0).sources[0].pose.position;
        let (mut step, mut refused) = (0.0_f64, 0);
        for number in 1..=steps {
            let inputs = (self.inputs)(f64::from(number) / f64::from(steps));
            step = step.max(1e3 * (inputs.sources[0].pose.position - magnet).norm());
            magnet = inputs.sources[0].pose.position;
            refused += u32::from(manipulator.solve(&inputs)?.status == Status::NotSolved);
            progress.done();
        }
        let outputs = manipulator.outputs();
        Ok(Walked { step, snaps: outputs.snaps - before, refused, tip: outputs.tip.position })
    }

    /// A path whose beginning is solved from the present shape of `manipulator`, or from the straight one.
    fn new(
        [name, remark]: [&'static str; 2],
        mut manipulator: Manipulator,
        inputs: impl Fn(f64) -> Inputs + Sync + 'static,
    ) -> Result<Self, Error> {
        manipulator.solve(&inputs(0.0))?;
        Ok(Self { name, remark, manipulator, inputs: Box::new(inputs) })
    }
}

fn ways() -> Result<Vec<Way>, Error> {
    let design = Design::new(Specification::paper(SEGMENTS))?;
    let settings = Settings { interaction: Interaction::Rings, ..Settings::default() };
    let free = Manipulator::new(&design, Some(&magnet_pair()?), settings, 2)?;
    let (first, last) = (hysteresis::FIRST, hysteresis::LAST);

    let passing = |from: f64, to: f64| move |part: f64| hysteresis::inputs(from + (to - from) * part);
    let forth = Way::new(
        ["snap forth", "the path of the study hysteresis"],
        hysteresis::manipulator()?,
        passing(first, last),
    )?;

    // For the way back, a device that has snapped over on the way forth.
    let mut over = forth.manipulator.clone();
    for step in 1..=FINEST {
        over.solve(&(forth.inputs)(f64::from(step) / f64::from(FINEST)))?;
    }

    let back = ["snap back", "the same path in reverse"];
    Ok(vec![
        Way::new(
            ["pass", "the demonstration: past at 140 mm, back, a turn by 45 deg"],
            free.clone(),
            demonstration,
        )?,
        Way::new(
            ["half orbit", "half around the axis at 140 mm: a step cuts the corner along its chord"],
            free,
            orbit,
        )?,
        forth,
        Way::new(back, over, passing(last, first))?,
    ])
}

/// Inputs with the magnet at `place` relative to the manipulator's middle, turned by `turn` (rad) about x; without a
/// turn, its field at the manipulator is along +z.
fn beside(place: Vector3<f64>, turn: f64) -> Inputs {
    let rotation = RotationVector::new(Vector3::new(PI + turn, 0.0, 0.0)).matrix();
    let magnet = Pose { position: place + Vector3::new(0.0, 0.0, MIDDLE), rotation };
    Inputs { sources: vec![PlacedSource { pose: magnet, strength: 1.0 }], ..Inputs::unloaded(SEGMENTS + 1) }
}

/// The path of `fmu/demo` without its return, since a single step from start to start would not move the magnet: past the manipulator
/// in half of the time, back to its middle in a sixth, then a turn.
fn demonstration(part: f64) -> Inputs {
    let eased = |share: f64| {
        let share = share.clamp(0.0, 1.0);
        share * share * (3.0 - 2.0 * share)
    };
    let passed = 2.0 * eased(2.0 * part) - 1.0 - eased(6.0 * part - 3.0);
    beside(Vector3::new(0.0, -DISTANCE, TRAVEL * passed), FRAC_PI_4 * eased(3.0 * part - 2.0))
}

/// Half an orbit around the manipulator's axis.
fn orbit(part: f64) -> Inputs {
    let (sine, cosine) = (PI * part).sin_cos();
    beside(Vector3::new(sine, -cosine, 0.0) * DISTANCE, 0.0)
}

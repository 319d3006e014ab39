//! How far the magnet may move in one step: what is followed must not depend on the communication step.

use core::f64::consts::{FRAC_PI_4, PI};

use nalgebra::Vector3;
use rayon::prelude::*;

use super::experiment::{SEGMENTS, magnet_pair};
use super::hysteresis;
use super::study::{Column, Comparison, Panel, Series, Stroke, Study, Value};
use crate::design::{Design, Specification};
use crate::equilibrium::{Interaction, Settings};
use crate::error::Error;
use crate::geometry::{Pose, RotationVector};
use crate::manipulator::{Inputs, Manipulator, Status};

/// In how many steps a way is taken: from one jump to what the others are compared with.
const STEPS: [u32; 13] = [1, 2, 3, 4, 5, 7, 10, 20, 50, 100, 200, 500, FINEST];
const FINEST: u32 = 1000;

/// Tips closer than this, mm, are those of one shape: what two solves leave of their residuals.
const SAME: f64 = 1e-7;

/// Smaller distances of tips are drawn as this one, mm.
const LEAST: f64 = 1e-10;

/// Distance of the magnet's axis from the manipulator's, m: the demonstration's.
const DISTANCE: f64 = 0.14;

/// How far the demonstration's magnet passes before and behind the manipulator's middle, and that middle, m.
const REACH: f64 = 0.18;
const MIDDLE: f64 = 0.023;

/// A way of the magnet.
struct Way {
    name: &'static str,
    /// What it is.
    remark: &'static str,
    /// At its beginning, solved.
    manipulator: Manipulator,
    /// What acts at a part, from 0 to 1, of the time that it takes.
    inputs: Box<dyn Fn(f64) -> Inputs + Sync>,
}

/// What came of a way.
struct Walked {
    /// Longest step of the magnet, mm.
    step: f64,
    /// Snaps that were told.
    snaps: u32,
    /// Steps that were not solved; the way goes on from the last good shape.
    refused: u32,
    tip: Vector3<f64>,
}

/// The paper's magnet pair moves along fixed ways beside nine segments, `rings`, in few steps and in many; each step is one
/// solve at the pose at its end.
///
/// # Errors
/// None for the paper's design; those of the solves are passed on.
pub fn communication_step() -> Result<Study, Error> {
    let ways = ways()?;
    let walks: Vec<(usize, u32)> = (0..ways.len()).flat_map(|way| STEPS.map(|steps| (way, steps))).collect();
    let walked = walks.par_iter().map(|&(way, steps)| ways[way].walked(steps));
    let walked = walked.collect::<Result<Vec<Walked>, Error>>()?;
    let mut columns = vec![Column::new("steps", STEPS.iter().map(|&steps| f64::from(steps)).collect())];
    let (mut series, mut comparison) = (Vec::new(), Vec::new());
    for (number, (way, walked)) in ways.iter().zip(walked.chunks(STEPS.len())).enumerate() {
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
        series.push(Series {
            label: way.name.into(),
            colour: number,
            stroke: Stroke::Solid,
            places: walked.iter().map(|walked| [walked.step, apart(walked).max(LEAST)]).collect(),
        });
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
    Ok(Study {
        title: "The same way of the magnet in few steps and in many",
        columns,
        panels: vec![Panel::Places {
            title: "where the tip is at the end".into(),
            x: "longest step of the magnet (mm)".into(),
            y: "distance from the tip after 1000 steps (mm)".into(),
            series,
            marks: Vec::new(),
        }],
        comparison,
    })
}

impl Way {
    /// Takes the way in so many steps.
    fn walked(&self, steps: u32) -> Result<Walked, Error> {
        let mut manipulator = self.manipulator.clone();
        let before = manipulator.outputs().snaps;
        let mut magnet = (self.inputs)(0.0).magnet.position;
        let (mut step, mut refused) = (0.0_f64, 0);
        for number in 1..=steps {
            let inputs = (self.inputs)(f64::from(number) / f64::from(steps));
            step = step.max(1e3 * (inputs.magnet.position - magnet).norm());
            magnet = inputs.magnet.position;
            refused += u32::from(manipulator.solve(&inputs)?.status == Status::NotSolved);
        }
        let outputs = manipulator.outputs();
        Ok(Walked { step, snaps: outputs.snaps - before, refused, tip: outputs.tip.position })
    }

    /// The way that begins where `manipulator` stands, or with the magnet at the way's beginning if it is unsolved.
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
        ["snap forth", "the way forth of the study hysteresis"],
        hysteresis::manipulator()?,
        passing(first, last),
    )?;
    let mut over = forth.manipulator.clone();
    for step in 1..=FINEST {
        over.solve(&(forth.inputs)(f64::from(step) / f64::from(FINEST)))?;
    }
    let back = ["snap back", "the same way back"];
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

/// The magnet beside the manipulator, its field there along +z, at a place about the manipulator's middle.
fn beside(place: Vector3<f64>, turn: f64) -> Inputs {
    let rotation = RotationVector::new(Vector3::new(PI + turn, 0.0, 0.0)).matrix();
    let magnet = Pose { position: place + Vector3::new(0.0, 0.0, MIDDLE), rotation };
    Inputs { magnet, magnet_strength: 1.0, ..Inputs::unloaded(SEGMENTS + 1) }
}

/// The way of `fmu/demo`: past the manipulator in half of the time, back to its middle in a sixth, then a turn.
fn demonstration(part: f64) -> Inputs {
    let eased = |share: f64| {
        let share = share.clamp(0.0, 1.0);
        share * share * (3.0 - 2.0 * share)
    };
    let passed = 2.0 * eased(2.0 * part) - 1.0 - eased(6.0 * part - 3.0);
    beside(Vector3::new(0.0, -DISTANCE, REACH * passed), FRAC_PI_4 * eased(3.0 * part - 2.0))
}

/// Half around the manipulator's axis.
fn orbit(part: f64) -> Inputs {
    let (sine, cosine) = (PI * part).sin_cos();
    beside(Vector3::new(sine, -cosine, 0.0) * DISTANCE, 0.0)
}

//! Random slow ways of the inputs, walked in coarse steps beside steps a hundred times as fine.

use core::f64::consts::TAU;

use mcm::design::{Design, Specification};
use mcm::equilibrium::{Equilibrium, Inputs, Interaction, PlacedSource, Settings, Solution};
use mcm::geometry::{Pose, RotationVector};
use nalgebra::Vector3;
use rand::RngExt;

use crate::given::{direction, of_case, pair, unloaded_beside_pair};

/// Fine steps in a coarse one.
const FINE: usize = 100;

/// Longest way of the fine walk's tip over the length within a coarse step, snaps aside, of a slow way.
const SLOW: f64 = 0.02;

/// Tips that are the same, over the length.
const SAME: f64 = 1e-6;

/// What of the inputs changes along a way from 0 to 1, by sines of whole waves and halves.
#[derive(Debug, Clone)]
pub(crate) struct Way {
    pub(crate) segments: usize,
    pub(crate) interaction: Interaction,
    has_magnet: bool,
    magnet: [Vector3<f64>; 3],
    turn: [Vector3<f64>; 2],
    strength: [f64; 2],
    field: [Vector3<f64>; 3],
}

/// How a coarse walk went beside the fine one.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Comparison {
    /// The fine walk has no start, or is too fast where they do not agree.
    Unfit,
    /// Both agree; so many snaps were told.
    Alike(u32),
    /// Both end within the same step, as bodies touch or the branch ends.
    End,
    /// They do not.
    Differs(String),
}

impl Way {
    /// The way of this number.
    pub(crate) fn random(seed: u64, index: u64) -> Self {
        let random = &mut of_case(seed, index);
        let segments = [1, 1, 1, 2, 3, 3, 4, 5, 6, 9][random.random_range(0..10)];
        let rings = random.random_bool(0.5);
        let has_magnet = random.random_bool(0.6);
        let length = 0.005 * segments as f64;
        let middle = Vector3::new(0.0, 0.0, random.random_range(0.0..=1.0) * length);
        let mut vector = |most: f64| direction(random) * random.random_range(0.0..=most);
        let (turn, shift) = ([vector(3.0), vector(0.5)], [vector(0.02), vector(0.01)]);
        let strongest = if has_magnet { 0.005 } else { 0.03 };
        let mut field = [vector(strongest), vector(strongest), vector(0.5 * strongest)];
        if !has_magnet && random.random_bool(0.7) {
            // Nearly against the manipulator, with a part across that changes its side: the bent shape snaps over.
            let axis = Vector3::z();
            let across = direction(random).cross(&axis) * 0.1 * strongest;
            field =
                [-axis * random.random_range(0.1..=2.0) * strongest + across, -2.0 * across, field[2] * 0.05];
        }
        // Weak and close, or strong and far away.
        let away = direction(random) * random.random_range(0.04..0.2);
        let weak = if random.random_bool(0.5) { 0.02 } else { 1.0 };
        let strength = [weak * random.random_range(0.1..1.0), weak * random.random_range(-0.5..0.5)];
        let interaction = if rings { Interaction::Rings } else { Interaction::None };
        let mut way = Self {
            segments,
            interaction,
            has_magnet,
            magnet: [middle + away, shift[0], shift[1]],
            turn,
            strength,
            field,
        };
        if has_magnet && random.random_bool(0.6) {
            // Nine segments beside the base: the tip is drawn to the magnet as that grows stronger, and let go again.
            let aside =
                Vector3::new(random.random_range(-0.003..=0.003), -random.random_range(0.049..0.056), 0.003);
            way.segments = 9;
            way.magnet = [aside, direction(random) * 5e-4, direction(random) * 2e-4];
            way.turn = [Vector3::x() * 0.5 * TAU + direction(random) * 0.1, direction(random) * 0.02];
            let critical = 2.5e-3 * (aside.norm() / 0.05).powi(4);
            way.strength =
                [critical * random.random_range(0.3..0.8), critical * random.random_range(0.2..0.7)];
            way.field = [Vector3::zeros(); 3];
        }
        way
    }

    fn inputs(&self, part: f64) -> Inputs {
        let (half, whole) = ((0.5 * TAU * part).sin(), (TAU * part).sin());
        let mut out = unloaded_beside_pair(self.segments + 1);
        out.uniform_field = self.field[0] + self.field[1] * half + self.field[2] * whole;
        if self.has_magnet {
            let pose = Pose {
                position: self.magnet[0] + self.magnet[1] * half + self.magnet[2] * whole,
                rotation: RotationVector::new(self.turn[0] + self.turn[1] * half).matrix(),
            };
            let strength = self.strength[0] + self.strength[1] * half;
            out.sources = vec![PlacedSource { pose, strength }];
        }
        out
    }

    /// Walks it twice from the same shape; in `steps` coarse ones; only the first part of it where all of it is not slow.
    pub(crate) fn compare(&self, steps: usize) -> Comparison {
        let (model, length) = self.model();
        [1.0, 0.25, 0.06]
            .iter()
            .map(|part| self.compare_part(&model, length, steps, *part))
            .find(|c| *c != Comparison::Unfit)
            .unwrap_or(Comparison::Unfit)
    }

    fn model(&self) -> (Equilibrium, f64) {
        let design = Design::new(Specification::paper(self.segments)).expect("allowed");
        let settings = Settings { interaction: self.interaction, ..Settings::default() };
        let model = Equilibrium::new(&design, Some(&pair()), settings, 2).expect("allowed");
        (model, design.length())
    }

    fn compare_part(&self, model: &Equilibrium, length: f64, steps: usize, part: f64) -> Comparison {
        let at = |step: usize| self.inputs(part * step as f64 / (steps * FINE) as f64);
        let mut fine = model.clone();
        if !fine.solve(&at(0)).expect("finite inputs").solved() {
            return Comparison::Unfit;
        }
        let mut coarse = fine.clone();
        for step in 0..steps {
            let (mut snaps, mut way) = (0, 0.0);
            for small in 1..=FINE {
                let before = fine.tip().position;
                let report = fine.solve(&at(step * FINE + small)).expect("finite inputs");
                if !report.solved() || report.stable != Some(true) {
                    let end = at((step + 1) * FINE);
                    let ends = !fine.solve(&end).expect("finite inputs").solved();
                    let told = coarse.solve(&end).expect("finite inputs");
                    return match (ends, told.solved()) {
                        (true, false) => Comparison::End,
                        (true, true) if told.snaps == 0 => Comparison::Differs(format!(
                            "part {part}, step {}: solved, in fine steps {report:?}",
                            step + 1
                        )),
                        _ => Comparison::Unfit,
                    };
                }
                snaps += report.snaps;
                if report.snaps == 0 {
                    way += (fine.tip().position - before).norm() / length;
                }
            }
            let report = coarse.solve(&at((step + 1) * FINE)).expect("finite inputs");
            let apart = (coarse.tip().position - fine.tip().position).norm() / length;
            if !report.solved() || report.snaps != snaps || apart > SAME {
                if way > SLOW {
                    return Comparison::Unfit;
                }
                return Comparison::Differs(format!(
                    "part {part}, step {}: {snaps} snaps in fine steps; {report:?}, tips {apart:e} of the length apart",
                    step + 1
                ));
            }
            if snaps > 0 {
                // Beyond, both go on alike: from the same shape.
                return Comparison::Alike(snaps);
            }
        }
        Comparison::Alike(0)
    }
}

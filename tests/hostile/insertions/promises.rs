//! What every answer in a vessel promises, and whether it keeps it.

use std::fmt;

use cpu_time::ThreadTime;
use mcm::design::Design;
use mcm::geometry::Pose;
use mcm::manipulator::{Inputs, Manipulator, Outcome, Outputs, Scene, Status};
use mcm::vessel::Lumen;
use nalgebra::Vector3;

use super::scenes::Insertion;
use super::tally::Tally;
use super::worst::Defect;

/// Centreline points at which the shape is looked at.
const POINTS: usize = 121;

/// Places around a rim.
const AROUND: u32 = 48;

/// Answers without a shape after which an insertion ends.
const ENOUGH: u32 = 3;

/// How far a solve may exceed its budget of processor time: a part of it, and models that are made in it, s.
const LATE: f64 = 1.2;
const MAKING: f64 = 0.3;

/// How far (m) a place of the shape may be deeper in the wall than the depth told.
const DEEPER: f64 = 2e-6;

/// Largest sum of all forces, relative to the sum of their magnitudes, but to no less than this force (N). The weight is that of a
/// quadrature, good to 5e-9 of the mass.
const BALANCE: f64 = 1e-8;
const FORCELESS: f64 = 1e-3;

/// One step in so many is done again in [`FINER`] parts.
const SAMPLE: u64 = 8;
const FINER: u32 = 16;

/// Distance (m) of the tip from that after finer steps beyond which another branch was met.
const ELSEWHERE: f64 = 1e-5;

/// Solves the steps of an insertion one after the other; `alone` tells them.
pub(crate) fn try_insertion(insertion: &Insertion, index: u64, alone: bool) -> Tally {
    let mut tally = Tally::of_one();
    let Insertion { scene, steps, text, .. } = insertion;
    if alone {
        println!("{text}");
    }
    let body = Body::new(scene);
    let mut manipulator = scene.manipulator(POINTS).unwrap();
    let mut without = 0;
    for (step, inputs) in steps.iter().enumerate() {
        if without == ENOUGH {
            break;
        }
        let before = manipulator.clone();
        let start = ThreadTime::now();
        let out = manipulator.solve(inputs).unwrap().clone();
        let seconds = start.elapsed().as_secs_f64();
        let solved = out.status != Status::NotSolved;
        let mut broken = Vec::new();
        let budget = scene.settings.time_budget;
        if seconds > LATE * budget + MAKING {
            broken.push(format!("took {seconds:.2} s of {budget} s, {:?}", out.outcome));
        }
        if !are_finite(&out) {
            broken.push(format!("an output is not finite, {:?}", out.outcome));
        }
        let contradiction = match out.outcome {
            Outcome::Solved => !solved || out.stable == Some(false),
            Outcome::Neutral => !solved || out.stable == Some(true),
            _ => solved || !same_shape(&out, before.outputs()),
        };
        if contradiction {
            broken.push(format!("{:?} contradicts {:?}, stable {:?}", out.outcome, out.status, out.stable));
        }
        if alone {
            tell(step, inputs, &out, seconds);
        }
        tally.time(seconds, budget, (index, step));
        if solved {
            let [soft, rims, barrels] = body.deepest(&out, inputs);
            let told = out.wall.as_ref().expect("a vessel").largest_indentation;
            tally.depths([soft - told, rims - told, barrels - told], (index, step));
            if soft.max(rims) > told + DEEPER {
                broken.push(format!("{soft:.2e} and {rims:.2e} deep in the wall, told {told:.2e}"));
            }
            let unbalanced = body.unbalanced(&out, inputs);
            tally.balance(unbalanced, (index, step));
            if unbalanced > BALANCE {
                broken.push(format!("forces add up to {unbalanced:.1e} of their sum"));
            }
        }
        let last = step.checked_sub(1).map(|last| &steps[last]);
        let went_on = before.has_shape() && before.outputs().status != Status::NotSolved;
        let again = alone || (index + step as u64).is_multiple_of(SAMPLE);
        let same_branch = went_on && solved && out.status != Status::Snapped;
        if let Some(last) = last.filter(|_| again && same_branch) {
            let (how, apart) = in_parts(&before, [last, inputs], &out);
            if alone {
                println!("   in {FINER} parts: {how}, {apart:.1e} m away");
            }
            tally.repeated(how);
            if how.is_defect() {
                broken.push(format!("in {FINER} parts {how}, {apart:.1e} m away"));
            }
        }
        if !solved && went_on && !matches!(out.outcome, Outcome::OutOfBudget(_)) {
            let last = last.expect("a step before");
            let back = manipulator.clone().solve(last).unwrap().clone();
            let apart = (back.tip.position - out.tip.position).norm();
            if back.status == Status::NotSolved || apart > ELSEWHERE {
                broken.push(format!("back at the last good inputs {:?}, {apart:.1e} m away", back.outcome));
            }
        }
        without += u32::from(!solved);
        tally.count(insertion, &out, last.filter(|_| before.has_shape()), inputs);
        let new = broken.into_iter().map(|what| Defect { index, step, what });
        tally.defects.extend(new);
    }
    tally
}

fn tell(step: usize, inputs: &Inputs, out: &Outputs, seconds: f64) {
    let wall = out.wall.as_ref().expect("a vessel");
    println!(
        "{step}: insertion {:.3} mm, roll {:.3}, base {:?}, {:?} {:?}, progress {:.3}, margin {:.2e}, {} iterations, {:.1} ms, \
         tip {:.3?} mm, contacts {}, {:.2} mN, {:.1} um, push {:.2} mN",
        1e3 * inputs.insertion,
        inputs.roll,
        (inputs.base.position * 1e3).as_slice(),
        out.status,
        out.outcome,
        out.progress,
        out.stability_margin,
        out.iterations,
        1e3 * seconds,
        (out.tip.position * 1e3).as_slice(),
        wall.count,
        1e3 * wall.sum,
        1e6 * wall.largest_indentation,
        1e3 * out.feed_reaction.unwrap_or_default()
    );
}

/// What became of a step that was done again in small parts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Repeated {
    /// The shape of the whole step, without a jump.
    Alike,
    /// Another shape, although neither tells of a jump.
    Elsewhere,
    /// A jump on the way that the whole step does not tell.
    JumpNotTold,
    /// No shape on the way.
    NotSolved,
}

impl Repeated {
    fn is_defect(self) -> bool {
        matches!(self, Self::Elsewhere | Self::JumpNotTold)
    }
}

impl fmt::Display for Repeated {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(match self {
            Self::Alike => "alike",
            Self::Elsewhere => "elsewhere without a jump",
            Self::JumpNotTold => "with a jump that was not told",
            Self::NotSolved => "no shape on the way",
        })
    }
}

/// The step again in small parts, and how far its end is from the one of the whole step.
fn in_parts(before: &Manipulator, [from, to]: [&Inputs; 2], whole: &Outputs) -> (Repeated, f64) {
    let mut again = before.clone();
    for part in 1..=FINER {
        let inputs =
            if part == FINER { to.clone() } else { from.between(to, f64::from(part) / f64::from(FINER)) };
        if again.solve(&inputs).unwrap().status == Status::NotSolved {
            return (Repeated::NotSolved, f64::NAN);
        }
    }
    let out = again.outputs();
    let apart = (out.tip.position - whole.tip.position).norm();
    let allowed = ELSEWHERE + out.error_estimate.min(1e-3) + whole.error_estimate.min(1e-3);
    let jumped = out.snaps > before.outputs().snaps;
    let how = match (jumped, apart > allowed) {
        (true, _) => Repeated::JumpNotTold,
        (false, true) => Repeated::Elsewhere,
        _ => Repeated::Alike,
    };
    (how, apart)
}

fn same_shape(a: &Outputs, b: &Outputs) -> bool {
    a.tip == b.tip && a.shape == b.shape && a.rings == b.rings && a.wall == b.wall
}

fn are_finite(out: &Outputs) -> bool {
    let vectors = [
        out.tip.position,
        out.magnetic_force,
        out.magnetic_torque,
        out.base_reaction_force,
        out.base_reaction_moment,
        out.tip_field,
    ];
    let reactions = out.reactions.iter().flat_map(|reaction| [reaction.force, reaction.torque]);
    let numbers = [
        out.stability_margin,
        out.progress,
        out.energy,
        out.error_estimate,
        out.feed_reaction.unwrap_or_default(),
    ];
    let wall = out.wall.as_ref().expect("a vessel");
    let forces = wall.rings.iter().chain([&wall.force]).all(|v| v.iter().all(|x| x.is_finite()));
    let sums =
        [wall.sum, wall.largest_force, wall.largest_indentation].iter().all(|x| x.is_finite() && *x >= 0.0);
    let rings =
        out.rings.iter().all(|pose| pose.position.iter().chain(pose.rotation.iter()).all(|x| x.is_finite()));
    vectors
        .into_iter()
        .chain(reactions)
        .chain(out.shape.iter().copied())
        .all(|v| v.iter().all(|x| x.is_finite()))
        && numbers.iter().all(|x| x.is_finite())
        && forces
        && sums
        && rings
}

/// What of a device may touch the wall.
struct Body<'a> {
    lumen: &'a Lumen,
    /// Length (m) and radius (m) of what follows the shaft; a ring has none.
    parts: Vec<(f64, Option<f64>)>,
    /// Radius of the shaft, m.
    shaft: f64,
    /// Length and radius of each ring, m.
    rings: Vec<[f64; 2]>,
    mass: f64,
    /// Mass per length of the shaft, kg/m.
    line_mass: f64,
}

impl<'a> Body<'a> {
    fn new(scene: &'a Scene) -> Self {
        let design: Design = scene.design().unwrap();
        let tube = scene.shaft.as_ref().expect("a shaft");
        let mut parts: Vec<(f64, Option<f64>)> = Vec::new();
        parts.extend(design.base_rings().iter().map(|ring| (ring.length, None)));
        for segment in design.segments() {
            parts.extend(segment.spans.iter().map(|span| (span.length, Some(span.widest_radius()))));
            parts.extend(segment.rings.iter().map(|ring| (ring.length, None)));
        }
        let section = std::f64::consts::PI * (tube.outer_radius.powi(2) - tube.inner_radius.powi(2));
        Self {
            lumen: &scene.vessel.as_ref().expect("a vessel").lumen,
            parts,
            shaft: tube.outer_radius,
            rings: design.rings().map(|ring| [ring.length, ring.outer_radius]).collect(),
            mass: design.mass(),
            line_mass: tube.density * section,
        }
    }

    /// Radius (m) of the soft part at this arc length behind the shaft (m).
    fn radius(&self, mut s: f64) -> Option<f64> {
        for (length, radius) in &self.parts {
            if s <= *length {
                return *radius;
            }
            s -= length;
        }
        None
    }

    /// Greatest depths (m) in the wall: of soft parts and the shaft by their centreline, of rims, of rings between their rims.
    fn deepest(&self, out: &Outputs, inputs: &Inputs) -> [f64; 3] {
        let depth = |point: &Vector3<f64>| -self.lumen.clearance(point).value;
        let mut soft = 0.0_f64;
        for (s, point) in out.shape_arc_length.iter().zip(&out.shape) {
            let behind = s - inputs.insertion;
            let radius = if behind < 0.0 { Some(self.shaft) } else { self.radius(behind) };
            soft = soft.max(radius.map_or(0.0, |radius| radius + depth(point)));
        }
        let around = |ring: &Pose, [length, radius]: [f64; 2], height: f64| {
            let place = |i: u32| {
                let (sine, cosine) = (std::f64::consts::TAU * f64::from(i) / f64::from(AROUND)).sin_cos();
                let local = Vector3::new(radius * cosine, radius * sine, height * length);
                depth(&(ring.position + ring.rotation * local))
            };
            (0..AROUND).map(place).fold(0.0, f64::max)
        };
        let mut found = [soft, 0.0, 0.0];
        for (pose, ring) in out.rings.iter().zip(&self.rings) {
            for (kind, height) in [(1, -0.5), (1, 0.5), (2, -0.25), (2, 0.0), (2, 0.25)] {
                found[kind] = found[kind].max(around(pose, *ring, height));
            }
        }
        found
    }

    /// Sum of all forces over the sum of their magnitudes, or over [`FORCELESS`].
    fn unbalanced(&self, out: &Outputs, inputs: &Inputs) -> f64 {
        let wall = out.wall.as_ref().expect("a vessel");
        let weight = inputs.gravity * (self.mass + self.line_mass * inputs.insertion);
        let total = out.base_reaction_force + wall.force + out.magnetic_force + weight;
        let sum = out.base_reaction_force.norm() + wall.sum + out.magnetic_force.norm() + weight.norm();
        total.norm() / sum.max(FORCELESS)
    }
}

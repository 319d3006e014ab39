//! Where methods fail: every method over field strength and direction, cold and warm, with every solution verified.

mod verdict;
mod verification;

use nalgebra::{Rotation3, Vector3};
use serde::Serialize;

use super::scenes::{LEVELS, SEGMENTS};
use crate::design::{Design, Specification};
use crate::equilibrium::{Interaction, Settings};
use crate::error::Error;
use crate::magnetics::Sources;
use crate::manipulator::{Followed, Inputs, Scene, Status, Way};
use crate::methods::{Device, Method};
use verification::{FineModel, Known};

pub use verdict::Verdict;

/// Number of field strengths and their step, mT; the largest are beyond the ends of all known branches.
const STRENGTHS: usize = 8;
const STRENGTH_STEP: f64 = 5.0;

/// Numbers of field steps between two strengths, for warm starts and for the reference branch.
const WARM_STEPS: usize = 5;
const LOADING_STEPS: usize = 10;

/// Number of field directions from the axis and their step, deg.
const DIRECTIONS: usize = 13;
const DIRECTION_STEP: f64 = 15.0;

/// Largest distance of a correct solution from its equilibrium, over the length: for methods that resolve the rod, and
/// for arcs of constant curvature.
const RESOLVED: f64 = 1e-3;
const ARCS: f64 = 0.05;

/// One attempt of one method at one field.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Attempt {
    /// The method.
    pub method: &'static str,
    /// Level of interaction.
    pub interaction: &'static str,
    /// Number of segments.
    pub segments: usize,
    /// `cold` from the straight shape, or `warm` along the growing field.
    pub start: &'static str,
    /// Direction of the field, deg from the axis.
    pub direction_deg: f64,
    /// Strength of the field, mT.
    pub field_mt: f64,
    /// Result of the attempt.
    pub verdict: Verdict,
    /// Largest distance of a ring from its position in the equilibrium, over the length.
    pub distance_over_length: Option<f64>,
    /// Smallest eigenvalue of the Hessian at the equilibrium, relative to the elastic energy.
    pub margin: Option<f64>,
    /// Residual reported by the method, in its own unit.
    pub residual: f64,
}

/// One direction of the field for one design and level: all strengths lie on one loading path.
#[derive(Debug, Clone)]
pub struct Ray {
    /// Number of segments of the paper's design.
    pub segments: usize,
    /// Level of interaction.
    pub interaction: Interaction,
    /// Direction of the field, deg from the axis.
    pub direction_deg: f64,
}

/// All rays of the map, those that take longest first.
#[must_use]
pub fn stability_rays() -> Vec<Ray> {
    let levels = LEVELS.into_iter().rev();
    let designs = levels.flat_map(|level| SEGMENTS.into_iter().rev().map(move |segments| (level, segments)));
    let rays = designs.flat_map(|(interaction, segments)| {
        (0..DIRECTIONS).map(move |i| Ray { segments, interaction, direction_deg: DIRECTION_STEP * i as f64 })
    });
    rays.collect()
}

impl Ray {
    /// Attempts of every method along the ray, cold and warm.
    ///
    /// Each reported solution is verified independently of the method: strain modes of degree 4, with ring pairs to
    /// 1e-7, are fitted through its rings; Newton's method on the gradient of that potential, with a Hessian by finite
    /// differences, finds an equilibrium, stable or not. The solution is correct if no ring moves by more than 1e-3 of
    /// the length (5e-2 for arcs of constant curvature), and stable if no eigenvalue of the full matrix is negative.
    /// The branch is what the same finer potential finds as the field grows from zero in steps of 0.5 mT. Warm starts
    /// raise it in steps of 1 mT; after an unsolved step, only the map's strengths are tried, from the last good shape.
    ///
    /// # Errors
    /// None for the paper's designs; those of the solves are passed on.
    pub fn attempts(&self) -> Result<Vec<Attempt>, Error> {
        let design = Design::new(Specification::paper(self.segments))?;
        let mut fine = FineModel::new(&design, self.interaction)?;
        let mut known = self.branch(&mut fine)?;
        let mut out = Vec::new();
        for (method, name) in Method::ALL.iter().filter(|row| row.0.supports(self.interaction)) {
            let scene = Scene {
                way: Way::default(),
                specification: Specification::paper(self.segments),
                vessel: None,
                shaft: None,
                guidewire: None,
                sources: Sources::default(),
                inputs: self.inputs(0.0),
                settings: Settings { interaction: self.interaction, ..Settings::default() },
                method: method.name().into(),
            };
            let mut manipulator = Device::of(&scene, 2)?;
            let accuracy = if *method == Method::ConstantCurvature { ARCS } else { RESOLVED };
            for (start, first) in [("cold", WARM_STEPS), ("warm", 1)] {
                manipulator.reset();
                for (number, known) in known.iter_mut().enumerate() {
                    if start == "cold" {
                        manipulator.reset();
                    }
                    // Where a step has failed, only the strengths of the map are tried.
                    let lost = manipulator.outputs().status == Status::NotSolved;
                    for part in (if lost { WARM_STEPS } else { first })..=WARM_STEPS {
                        manipulator.solve(&self.inputs(strength(number, part, WARM_STEPS)))?;
                    }
                    let strength = strength(number, 1, 1);
                    let outputs = manipulator.outputs();
                    let solved = outputs.status != Status::NotSolved;
                    let found = if solved {
                        fine.nearest(&self.inputs(strength), &outputs.rings, accuracy, known)
                    } else {
                        None
                    };
                    let verdict = match found {
                        Some(found) if found.distance <= accuracy => found.verdict,
                        _ if solved => Verdict::Wrong,
                        _ if outputs.residual.is_finite() => Verdict::Stalled,
                        _ => Verdict::Diverged,
                    };
                    out.push(Attempt {
                        method: name,
                        interaction: self.interaction.name(),
                        segments: self.segments,
                        start,
                        direction_deg: self.direction_deg,
                        field_mt: strength,
                        verdict,
                        distance_over_length: found.map(|found| found.distance),
                        margin: found.map(|found| found.margin),
                        residual: outputs.residual,
                    });
                }
            }
        }
        Ok(out)
    }

    fn inputs(&self, strength: f64) -> Inputs {
        let turn = Rotation3::from_axis_angle(&-Vector3::x_axis(), self.direction_deg.to_radians());
        let uniform_field = turn * Vector3::z() * (1e-3 * strength);
        Inputs { uniform_field, ..Inputs::unloaded(self.segments + 1) }
    }

    /// The equilibria of quasi-static loading, by strength.
    fn branch(&self, fine: &mut FineModel) -> Result<Vec<Vec<Known>>, Error> {
        let mut out = vec![Vec::new(); STRENGTHS];
        for (number, known) in out.iter_mut().enumerate() {
            for part in 1..=LOADING_STEPS {
                if !fine.load(&self.inputs(strength(number, part, LOADING_STEPS)))? {
                    return Ok(out);
                }
            }
            known.extend(fine.loaded(&self.inputs(strength(number, 1, 1))));
        }
        Ok(out)
    }
}

/// Strength (mT) after `part` of `parts` equal steps from the preceding strength of the map to strength `number`.
fn strength(number: usize, part: usize, parts: usize) -> f64 {
    STRENGTH_STEP * (number as f64 + part as f64 / parts as f64)
}

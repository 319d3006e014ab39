//! Independent verification of a shape that a method reports as solved.

use super::verdict::Verdict;
use crate::design::Design;
use crate::equilibrium::{Equilibrium, Inputs, Interaction, Settings, Verifier};
use crate::error::Error;
use crate::geometry::Pose;

/// Degree of the strain modes and accuracy of the ring pairs, both finer than in the methods that are verified.
const DEGREE: usize = 4;
const PAIR_ACCURACY: f64 = 1e-7;

/// Distance of the rings, over the length, up to which two equilibria count as the same.
const SAME: f64 = 1e-5;

/// Longest step of Newton's method towards the equilibrium with which a solution is compared (1: one element turned by a radian).
const LONGEST_STEP: f64 = 0.5;

/// Smallest eigenvalue, relative to the elastic stiffness, below which a shape is unstable: the noise of the differences.
/// Between it and zero a shape is neutral, as one bent in an antiparallel field, which may turn freely about the axis.
const UNSTABLE: f64 = -1e-6;

/// An equilibrium that is known at some inputs.
#[derive(Debug, Clone)]
pub(super) struct Known {
    pub(super) rings: Vec<Pose>,
    /// Smallest eigenvalue of the Hessian relative to the elastic stiffness.
    pub(super) margin: f64,
    /// Whether it is [`Verdict::Branch`].
    pub(super) of_branch: bool,
}

impl Known {
    /// Verdict on a solution that is this equilibrium.
    fn verdict(&self) -> Verdict {
        if self.margin < UNSTABLE {
            Verdict::Unstable
        } else if self.of_branch {
            Verdict::Branch
        } else {
            Verdict::OtherStable
        }
    }
}

/// The equilibrium with which a solution is compared.
#[derive(Debug, Clone, Copy)]
pub(super) struct Found {
    pub(super) verdict: Verdict,
    /// Largest distance of a ring from its position in the equilibrium, over the length.
    pub(super) distance: f64,
    /// As [`Known::margin`].
    pub(super) margin: f64,
}

/// A finer potential, whose equilibria, found by [`Verifier`], are compared with solutions.
#[derive(Debug, Clone)]
pub(super) struct FineModel {
    fine: Equilibrium,
    length: f64,
}

impl FineModel {
    pub(super) fn new(design: &Design, interaction: Interaction) -> Result<Self, Error> {
        let settings =
            Settings { interaction, degree: DEGREE, pair_accuracy: PAIR_ACCURACY, ..Settings::default() };
        Ok(Self { fine: Equilibrium::new(design, None, settings, 2)?, length: design.length() })
    }

    /// Follows the branch to `inputs`; returns whether it was reached.
    pub(super) fn load(&mut self, inputs: &Inputs) -> Result<bool, Error> {
        Ok(self.fine.solve(inputs)?.solved())
    }

    /// The equilibrium that [`FineModel::load`] has reached; `None` if Newton's method does not converge there.
    pub(super) fn loaded(&mut self, inputs: &Inputs) -> Option<Known> {
        let shape = self.fine.unknowns().to_vec();
        Some(Known { of_branch: true, ..self.polished(inputs, &shape)? })
    }

    /// The equilibrium in `known` nearest to `rings` or, if none is within `accuracy`, the one that Newton's method
    /// finds from `rings` and that is added to `known`. `None` if none is found.
    pub(super) fn nearest(
        &mut self,
        inputs: &Inputs,
        rings: &[Pose],
        accuracy: f64,
        known: &mut Vec<Known>,
    ) -> Option<Found> {
        let length = self.length;
        let apart = |known: &Known| distance(&known.rings, rings) / length;
        let nearest = known.iter().min_by(|a, b| apart(a).total_cmp(&apart(b)));

        let found =
            |known: &Known| Found { verdict: known.verdict(), distance: apart(known), margin: known.margin };
        if let Some(near) = nearest.filter(|known| apart(known) <= accuracy) {
            return Some(found(near));
        }

        let start = self.fine.amplitudes_through(rings)?;
        let polished = self.polished(inputs, &start)?;
        let again = known.iter().find(|known| distance(&known.rings, &polished.rings) <= SAME * length);
        if let Some(known) = again {
            return Some(found(known));
        }

        let found = found(&polished);
        known.push(polished);
        Some(found)
    }

    /// The equilibrium, stable or not, that Newton's method finds from `start`; `None` if it does not converge.
    fn polished(&mut self, inputs: &Inputs, start: &[f64]) -> Option<Known> {
        let mut verifier = Verifier::new(&mut self.fine, inputs, true);
        let unknowns = verifier.polished(start, LONGEST_STEP)?;
        let margin = verifier.smallest_real_part(&unknowns)?;
        Some(Known { rings: self.fine.rings_at(&inputs.base, &unknowns), margin, of_branch: false })
    }
}

/// Largest distance between corresponding rings, m.
fn distance(a: &[Pose], b: &[Pose]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a.position - b.position).norm()).fold(0.0, f64::max)
}

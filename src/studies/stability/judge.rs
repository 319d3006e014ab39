//! The independent judge of a shape that a method calls solved.

use nalgebra::{DMatrix, DVector, SymmetricEigen};

use super::verdict::Verdict;
use crate::design::Design;
use crate::equilibrium::{Equilibrium, Inputs, Interaction, Settings};
use crate::error::Error;
use crate::geometry::Pose;

/// The judge resolves more finely than what it judges: degree of the strain modes and accuracy of the ring pairs.
const DEGREE: usize = 4;
const PAIR_ACCURACY: f64 = 1e-7;

/// Step of the differences of gradients, in radians of the first mode.
const STEP: f64 = 1e-5;

/// Newton steps at most, and the residual (in turns of one element by a radian) at which a shape is in balance.
const STEPS: usize = 30;
const BALANCE: f64 = 1e-8;

/// Rings closer than this, over the length, are those of one equilibrium.
const SAME: f64 = 1e-5;

/// Longest Newton step, in the same measure: nobody's answer is judged by an equilibrium far away.
const LONGEST_STEP: f64 = 0.5;

/// A Hessian made earlier serves while it makes the residual shrink by this factor.
const SHRINKING: f64 = 0.1;

/// Smallest eigenvalue, relative to the elastic energy, below which a shape is unstable: the noise of the differences. Between
/// it and zero nothing drives the shape away: bent in a field straight against it, it may turn about the axis at no cost.
const UNSTABLE: f64 = -1e-6;

/// An equilibrium that is known at some inputs.
#[derive(Debug, Clone)]
pub(super) struct Known {
    pub(super) rings: Vec<Pose>,
    /// Smallest eigenvalue of the Hessian relative to the elastic energy.
    pub(super) margin: f64,
    /// Whether it is [`Verdict::Branch`].
    pub(super) of_branch: bool,
}

impl Known {
    /// What an answer is worth that is this equilibrium.
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

/// The equilibrium that an answer was found to be, or to be nearest to.
#[derive(Debug, Clone, Copy)]
pub(super) struct Found {
    pub(super) verdict: Verdict,
    /// Largest distance of a ring from there over the length.
    pub(super) distance: f64,
    /// As [`Known::margin`].
    pub(super) margin: f64,
}

/// Judges shapes by a finer potential, of which it takes the gradient alone: Newton's method with differences of gradients
/// leads from the shape to an equilibrium, stable or not, and the eigenvalues of that Hessian, as a full matrix, tell which.
#[derive(Debug, Clone)]
pub(super) struct Judge {
    fine: Equilibrium,
    length: f64,
}

impl Judge {
    pub(super) fn new(design: &Design, interaction: Interaction) -> Result<Self, Error> {
        let settings =
            Settings { interaction, degree: DEGREE, pair_accuracy: PAIR_ACCURACY, ..Settings::default() };
        Ok(Self { fine: Equilibrium::new(design, None, settings, 2)?, length: design.length() })
    }

    /// Follows the branch to `inputs`; whether it goes so far.
    pub(super) fn load(&mut self, inputs: &Inputs) -> Result<bool, Error> {
        Ok(self.fine.solve(inputs)?.solved())
    }

    /// The equilibrium to which [`Judge::load`] has come.
    pub(super) fn loaded(&mut self, inputs: &Inputs) -> Option<Known> {
        let shape = self.fine.unknowns().to_vec();
        Some(Known { of_branch: true, ..self.polished(inputs, &shape)? })
    }

    /// The equilibrium of `known` or, if none is within `accuracy`, the one that Newton's method finds from `rings`, which is
    /// then known, too; with its distance from `rings` over the length. `None` where there is none.
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

    /// Newton's method from `start` to any equilibrium.
    fn polished(&mut self, inputs: &Inputs, start: &[f64]) -> Option<Known> {
        // Weighted by the root of the metric all amplitudes have one size; the first is a turn of an element.
        let roots = DVector::from_iterator(start.len(), self.fine.metric().iter().map(|k| k.sqrt()));
        let unit = roots[0];
        let mut shape = DVector::from_column_slice(start).component_mul(&roots);
        let mut gradient = self.gradient(inputs, &shape, &roots)?;
        let mut hessian = None;
        for _ in 0..STEPS {
            let residual = gradient.norm() / unit;
            if residual <= BALANCE {
                let last = self.hessian(inputs, &shape, &roots)?;
                let unknowns = shape.component_div(&roots);
                return Some(Known {
                    rings: self.fine.rings_at(&inputs.base, unknowns.as_slice()),
                    margin: SymmetricEigen::new(last).eigenvalues.min(),
                    of_branch: false,
                });
            }
            let factors = match hessian.take() {
                Some(factors) => factors,
                None => self.hessian(inputs, &shape, &roots)?.lu(),
            };
            let step = factors.solve(&gradient)?;
            let length = step.norm() / unit;
            shape -= step * f64::min(1.0, LONGEST_STEP / length);
            gradient = self.gradient(inputs, &shape, &roots)?;
            hessian = (gradient.norm() / unit <= SHRINKING * residual).then_some(factors);
        }
        None
    }

    fn gradient(
        &mut self,
        inputs: &Inputs,
        shape: &DVector<f64>,
        roots: &DVector<f64>,
    ) -> Option<DVector<f64>> {
        let (_, gradient) = self.fine.gradient(inputs, shape.component_div(roots).as_slice())?;
        Some(DVector::from_vec(gradient).component_div(roots))
    }

    fn hessian(
        &mut self,
        inputs: &Inputs,
        shape: &DVector<f64>,
        roots: &DVector<f64>,
    ) -> Option<DMatrix<f64>> {
        let step = STEP * roots[0];
        let mut out = DMatrix::zeros(shape.len(), shape.len());
        for i in 0..shape.len() {
            let mut at = |side: f64| {
                let mut moved = shape.clone();
                moved[i] += side * step;
                self.gradient(inputs, &moved, roots)
            };
            let slope = (at(1.0)? - at(-1.0)?) / (2.0 * step);
            out.set_column(i, &slope);
        }
        Some((&out + out.transpose()) * 0.5)
    }
}

/// Largest distance of two rings, m.
fn distance(a: &[Pose], b: &[Pose]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a.position - b.position).norm()).fold(0.0, f64::max)
}

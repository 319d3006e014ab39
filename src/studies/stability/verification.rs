//! Independent verification of a shape that a method reports as solved.

use nalgebra::{DMatrix, DVector, SymmetricEigen};

use super::verdict::Verdict;
use crate::design::Design;
use crate::equilibrium::{Equilibrium, Inputs, Interaction, Settings};
use crate::error::Error;
use crate::geometry::Pose;

/// Degree of the strain modes and accuracy of the ring pairs, both finer than in the methods that are verified.
const DEGREE: usize = 4;
const PAIR_ACCURACY: f64 = 1e-7;

/// Step of the finite differences of the gradient, in radians of the first mode.
const STEP: f64 = 1e-5;

/// Maximum number of Newton steps, and residual at which a shape is an equilibrium (1: one element turned by a radian).
const STEPS: usize = 30;
const BALANCE: f64 = 1e-8;

/// Distance of the rings, over the length, up to which two equilibria count as the same.
const SAME: f64 = 1e-5;

/// Longest Newton step, in the unit of the residual, so that a solution is not compared with a distant equilibrium.
const LONGEST_STEP: f64 = 0.5;

/// Largest ratio of successive residuals for which the Hessian is reused in the next step.
const SHRINKING: f64 = 0.1;

/// Smallest eigenvalue, relative to the elastic energy, below which a shape is unstable: the noise of the differences.
/// Between it and zero a shape is neutral, as one bent in an antiparallel field, which may turn freely about the axis.
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

/// Verifies shapes with the gradient of a finer potential: Newton's method with finite differences of the gradient
/// finds an equilibrium from the shape, and the eigenvalues of the full Hessian show whether it is stable.
#[derive(Debug, Clone)]
pub(super) struct Verifier {
    fine: Equilibrium,
    length: f64,
}

impl Verifier {
    pub(super) fn new(design: &Design, interaction: Interaction) -> Result<Self, Error> {
        let settings =
            Settings { interaction, degree: DEGREE, pair_accuracy: PAIR_ACCURACY, ..Settings::default() };
        Ok(Self { fine: Equilibrium::new(design, None, settings, 2)?, length: design.length() })
    }

    /// Follows the branch to `inputs`; returns whether it was reached.
    pub(super) fn load(&mut self, inputs: &Inputs) -> Result<bool, Error> {
        Ok(self.fine.solve(inputs)?.solved())
    }

    /// The equilibrium that [`Verifier::load`] has reached; `None` if Newton's method does not converge there.
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
        // Scaled by the root of the metric, all amplitudes have one size; the first is the rotation of an element.
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

/// Largest distance between corresponding rings, m.
fn distance(a: &[Pose], b: &[Pose]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a.position - b.position).norm()).fold(0.0, f64::max)
}

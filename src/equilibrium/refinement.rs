//! How far an answer is from converged: what a finer discretisation of the same model makes of it.
//!
//! The finer model has strain modes of higher degree, and smaller errors of its quadratures. Its forces at the shape of the
//! coarser one say three things at once: what the added modes lack, what the quadratures were off, and the residual. The
//! added modes are stiff beside the loads, so that their elastic stiffness alone decides how far they give way; what this and
//! the rest of the forces do to the coarser modes follows by the factorisation that the solve has left. So two gradients
//! of the finer model suffice, without a Hessian of it.

use super::inputs::Inputs;
use super::model_transfer::{NEAR, TipDeviation};
use super::settings::{Interaction, Settings};
use super::solution::Solution;
use super::solver::Equilibrium;
use crate::design::Design;
use crate::error::Error;
use crate::magnetics::Assembly;
use crate::numerics::trust_region::{Objective, norm};

/// Degrees that one refinement adds: an odd one alone adds almost nothing.
const DEGREES: usize = 2;

/// What one refinement leaves of the errors of the quadratures, and the smallest error that one asks for.
const QUADRATURE: f64 = 1e-2;
const FINEST: f64 = 1e-10;

/// The least error that is told, of the tip over the length and of its angle (rad): residuals, and strains with kinks, of which
/// more modes find little at once.
const LEAST: f64 = 1e-8;

/// A finer discretisation of a model, and how its modes follow from those of the coarser one.
#[derive(Debug, Clone)]
pub struct Refinement {
    /// The finer model.
    pub model: Equilibrium,
    projection: Projection,
    shape: Vec<f64>,
    step: Vec<f64>,
    coarse: Vec<f64>,
}

/// Unknown of the finer model, unknown of the coarser one, and how much of a unit amplitude of the second the first takes up.
#[derive(Debug, Clone)]
struct Projection(Vec<(usize, usize, f64)>);

impl Projection {
    /// Adds the shape `coarse` to `fine`.
    fn raise(&self, coarse: &[f64], fine: &mut [f64]) {
        for (i, j, part) in &self.0 {
            fine[*i] += part * coarse[*j];
        }
    }

    /// Writes the part of `fine` that the coarser modes have, or of a gradient, to `coarse`.
    fn lower(&self, fine: &[f64], coarse: &mut [f64]) {
        coarse.fill(0.0);
        for (i, j, part) in &self.0 {
            coarse[*j] += part * fine[*i];
        }
    }
}

impl Settings {
    /// The same with the next finer discretisation.
    #[must_use]
    pub fn refined(&self) -> Self {
        let finest = FINEST.min(self.pair_accuracy);
        let pair_accuracy = (QUADRATURE * self.pair_accuracy).max(finest);
        Self { degree: self.degree + DEGREES, pair_accuracy, ..*self }
    }
}

impl Equilibrium {
    /// Whether there are fields that vary over a ring.
    fn has_quadratures(&self, inputs: &Inputs) -> bool {
        let magnet = self.magnet.is_some() && inputs.magnet_strength != 0.0;
        magnet || self.settings.interaction != Interaction::None
    }
}

impl Refinement {
    /// Of `coarse`, which is of this design and magnet.
    ///
    /// # Errors
    /// As [`Equilibrium::new`].
    pub fn new(
        coarse: &Equilibrium,
        design: &Design,
        magnet: Option<&Assembly>,
        shape_points: usize,
    ) -> Result<Self, Error> {
        let model = Equilibrium::of_checked(design, magnet, coarse.settings.refined(), shape_points)?;
        let (own, other) = (&model.chain, &coarse.chain);
        let mut projection = Vec::new();
        for (k, (element, from)) in own.elements.iter().zip(&other.elements).enumerate() {
            let entries = element.projection(from).into_iter();
            projection.extend(entries.map(|(i, j, part)| (own.first[k] + i, other.first[k] + j, part)));
        }
        let zeros = vec![0.0; own.freedoms()];
        let coarse = vec![0.0; other.freedoms()];
        let projection = Projection(projection);
        Ok(Self { shape: zeros.clone(), step: zeros, coarse, model, projection })
    }

    /// How far the tip of `coarse` at its last solved shape is from where the finer model would put it, to first order, and
    /// what the quadratures of that one may be off.
    ///
    /// Neither branch is touched. `None` before the first solve, where `coarse` cannot be factorised, and where the step
    /// is too long to tell.
    pub fn error_of(&mut self, coarse: &mut Equilibrium) -> Option<TipDeviation> {
        let inputs = coarse.branch.inputs.take()?;
        let error = self.error_at(coarse, &inputs);
        coarse.branch.inputs = Some(inputs);
        error
    }

    fn error_at(&mut self, coarse: &mut Equilibrium, inputs: &Inputs) -> Option<TipDeviation> {
        let Self { model, projection, shape, step, coarse: own } = self;
        let unknowns = std::mem::take(&mut coarse.branch.unknowns);
        let mut potential = coarse.potential_as_ruled(inputs);
        let factored = potential.work.factorisation.is_some()
            || (potential.linearise(&unknowns).is_some() && potential.factorise(0.0));
        shape.fill(0.0);
        projection.raise(&unknowns, shape);
        coarse.branch.unknowns = unknowns;
        if !factored {
            return None;
        }
        // What the added modes give way: all of the elastic step but its part in the coarser modes.
        let mut finer = model.potential(inputs, shape);
        finer.slope(shape)?;
        let metric = &finer.chain.metric;
        for ((by, slope), stiffness) in step.iter_mut().zip(finer.gradient()).zip(metric) {
            *by = -slope / stiffness;
        }
        projection.lower(step, own);
        negate(own);
        projection.raise(own, step);
        add(step, shape);
        // What the coarser modes do then.
        finer.slope(shape)?;
        projection.lower(finer.gradient(), own);
        negate(own);
        coarse.potential_as_ruled(inputs).solve(own);
        step.fill(0.0);
        projection.raise(own, step);
        let length = norm(&model.chain.metric, step);
        if length.is_nan() || length > NEAR * model.chain.radian_norm() {
            return None;
        }
        add(step, shape);
        model.work.place(&model.chain, &inputs.base, shape);
        let seen = TipDeviation::between(&model.tip(), &coarse.tip());
        // Between two accuracies the quadratures may well stay the same: what the finer ones may be off is added.
        let quadratures = model.has_quadratures(inputs);
        let unseen = LEAST + if quadratures { QUADRATURE * coarse.settings.pair_accuracy } else { 0.0 };
        let unseen = TipDeviation { distance: unseen * model.chain.length(), angle: unseen };
        Some(seen.plus(unseen)).filter(TipDeviation::is_finite)
    }
}

/// Adds a step to a shape.
fn add(step: &[f64], shape: &mut [f64]) {
    for (x, by) in shape.iter_mut().zip(step) {
        *x += by;
    }
}

fn negate(step: &mut [f64]) {
    for by in step {
        *by = -*by;
    }
}

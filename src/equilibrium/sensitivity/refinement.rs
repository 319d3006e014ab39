//! Error estimate of the discretisation: the tip deviation from a finer discretisation of the same model.
//!
//! The finer model has strain modes of higher degree and smaller quadrature errors. Its residual at the coarser shape
//! combines the effect of the missing modes, the quadrature errors and the residual of the coarser solve. The added modes
//! are stiff compared with the loads, so that their elastic stiffness alone determines their amplitudes; the effect of
//! these and of the remaining forces on the coarser modes follows from the factorisation left by the solve. Two gradients
//! of the finer model therefore suffice, without its Hessian.

use std::sync::Arc;

use crate::design::Design;
use crate::equilibrium::model::{Inputs, Interaction, Settings};
use crate::equilibrium::search::{DIVERGING, Equilibrium, NEAR, SOFT, Solution, TipDeviation};
use crate::error::Error;
use crate::magnetics::Sources;
use crate::numerics::trust_region::{Objective, norm};

/// Polynomial degrees added by one refinement: a single odd degree adds almost nothing.
const DEGREES: usize = 2;

/// Factor by which one refinement reduces the quadrature errors, and the smallest error it requests.
const QUADRATURE: f64 = 1e-2;
const FINEST: f64 = 1e-10;

/// Accuracy of the pairs at which the stations of the rods limit that of a shape.
const LIMITED_BY_STATIONS: f64 = 1e-8;

/// Smallest reported error, of the tip position over the length and of its angle (rad): it covers residuals, and strains
/// with kinks, to which more modes converge slowly.
const LEAST: f64 = 1e-8;

/// Largest number of steps to the finer equilibrium of a soft shape, and the length of the last one relative to the first.
const ROUNDS: usize = 6;
const SETTLED: f64 = 0.05;

/// Error estimate of a discretisation: how far the tip of the next finer one is away, and how far that one may be off.
#[derive(Debug, Clone, Copy)]
pub struct DiscretisationError {
    /// Deviation of the tip from that of the finer model, to first order.
    pub seen: TipDeviation,
    /// Largest deviation that the quadrature errors of the finer model, residuals and kinks leave: a bound.
    pub unseen: TipDeviation,
}

/// A finer discretisation of a model, and the map from the coarser modes to its own.
#[derive(Debug, Clone)]
pub struct Refinement {
    /// The finer model.
    pub model: Equilibrium,
    projection: Projection,
    shape: Vec<f64>,
    step: Vec<f64>,
    coarse: Vec<f64>,
}

/// Projection of the coarser modes onto the finer ones. Entries: unknown of the finer model, unknown of the coarser one,
/// and amplitude of the first for a unit amplitude of the second.
#[derive(Debug, Clone)]
struct Projection(Vec<(usize, usize, f64)>);

impl Projection {
    /// Adds the coarser shape `coarse` to `fine`.
    fn raise(&self, coarse: &[f64], fine: &mut [f64]) {
        for (i, j, part) in &self.0 {
            fine[*i] += part * coarse[*j];
        }
    }

    /// Writes the part of `fine`, or of a gradient, in the coarser modes to `coarse`.
    fn lower(&self, fine: &[f64], coarse: &mut [f64]) {
        coarse.fill(0.0);
        for (i, j, part) in &self.0 {
            coarse[*j] += part * fine[*i];
        }
    }
}

impl Settings {
    /// These settings with the next finer discretisation.
    #[must_use]
    pub fn refined(&self) -> Self {
        let finest = FINEST.min(self.pair_accuracy);
        let pair_accuracy = (QUADRATURE * self.pair_accuracy).max(finest);
        let fine_stations = self.fine_stations || pair_accuracy <= LIMITED_BY_STATIONS;
        Self { degree: self.degree + DEGREES, pair_accuracy, fine_stations, ..*self }
    }
}

impl Equilibrium {
    /// Whether there are fields that vary over a ring, so that quadratures are needed.
    fn has_quadratures(&self, inputs: &Inputs) -> bool {
        let any_is_on = inputs.sources.iter().any(|source| source.strength != 0.0);
        any_is_on || self.settings.interaction != Interaction::None
    }
}

impl Refinement {
    /// Refines `coarse`, which must be of this design and magnet, to `settings`.
    ///
    /// # Errors
    /// As [`Equilibrium::new`].
    pub fn new(
        coarse: &Equilibrium,
        settings: Settings,
        design: &Design,
        sources: &Arc<Sources>,
        shape_points: usize,
    ) -> Result<Self, Error> {
        let made = Equilibrium::of_checked(design, sources, settings, shape_points)?;
        let model = match coarse.vessel() {
            Some(vessel) => made.in_vessel(vessel),
            None => made,
        };
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

    /// Error estimate of the tip of `coarse` at its last solved shape: its first-order deviation from the finer model,
    /// and the possible quadrature error of that model.
    ///
    /// Neither branch is changed. `None` before the first solve, where `coarse` cannot be factorised, and where the step
    /// is too long for an estimate.
    pub fn error_of(&mut self, coarse: &mut Equilibrium) -> Option<DiscretisationError> {
        let inputs = coarse.branch.inputs.take()?;
        let error = self.error_at(coarse, &inputs);
        coarse.branch.inputs = Some(inputs);
        error
    }

    fn error_at(&mut self, coarse: &mut Equilibrium, inputs: &Inputs) -> Option<DiscretisationError> {
        let softness = coarse.branch.softness();
        if !self.take_up(coarse, inputs) {
            return None;
        }
        let first = self.approach(coarse, inputs)?;
        if first > NEAR * self.model.chain.radian_norm() {
            return None;
        }
        // Where the shape is soft, the response is not linear in the forces: further steps tell by how much.
        let ratio = if softness > SOFT { self.settle(coarse, inputs, first)? } else { 0.0 };

        let Self { model, shape, .. } = self;
        model.work.place(&model.chain, inputs, shape);
        let seen = TipDeviation::between(&model.tip(), &coarse.tip()).times(1.0 / (1.0 - ratio));
        // Two accuracies may share the same quadratures, so that the possible error of the finer ones is told beside.
        let quadratures = model.has_quadratures(inputs);
        let unseen =
            LEAST + if quadratures { QUADRATURE * coarse.settings.pair_accuracy * softness } else { 0.0 };
        let unseen = TipDeviation { distance: unseen * model.chain.length(), angle: unseen };
        Some(DiscretisationError { seen, unseen })
            .filter(|error| error.seen.is_finite() && unseen.is_finite())
    }

    /// Takes up the shape of `coarse`, which is factorised afterwards: anew where it is soft, as an old factorisation is then too
    /// far off. Returns whether it could be.
    fn take_up(&mut self, coarse: &mut Equilibrium, inputs: &Inputs) -> bool {
        let old = coarse.is_soft();
        let unknowns = std::mem::take(&mut coarse.branch.unknowns);
        let mut potential = coarse.potential_as_ruled(inputs);
        let factored = (potential.work.factorisation.is_some() && !old)
            || (potential.linearise(&unknowns).is_some() && potential.factorise(0.0));
        self.shape.fill(0.0);
        self.projection.raise(&unknowns, &mut self.shape);
        coarse.branch.unknowns = unknowns;

        self.model.copy_friction(coarse);
        factored
    }

    /// Goes on after a `first` step until little is left; returns the ratio of the last two, `None` where they do not shrink.
    fn settle(&mut self, coarse: &mut Equilibrium, inputs: &Inputs, first: f64) -> Option<f64> {
        let (mut last, mut ratio) = (first, 0.0);
        for _ in 1..ROUNDS {
            if last <= SETTLED * first {
                break;
            }
            let next = self.approach(coarse, inputs)?;
            ratio = next / last;
            if ratio > DIVERGING {
                return None;
            }
            last = next;
        }
        Some(ratio)
    }

    /// Brings the shape one step nearer to the equilibrium of the finer model; returns the length (radian norm) of the response of
    /// the coarser modes.
    fn approach(&mut self, coarse: &mut Equilibrium, inputs: &Inputs) -> Option<f64> {
        let Self { model, projection, shape, step, coarse: own } = self;
        // Amplitudes of the added modes: the elastic step without its part in the coarser modes.
        let mut finer = model.potential(inputs, shape);
        finer.slope(shape)?;
        let metric = finer.metric;
        for ((by, slope), stiffness) in step.iter_mut().zip(finer.gradient()).zip(metric) {
            *by = -slope / stiffness;
        }
        projection.lower(step, own);
        negate(own);
        projection.raise(own, step);
        add(step, shape);

        // Response of the coarser modes.
        finer.slope(shape)?;
        projection.lower(finer.gradient(), own);
        negate(own);
        coarse.potential_as_ruled(inputs).solve(own);
        step.fill(0.0);
        projection.raise(own, step);
        add(step, shape);
        Some(norm(&model.metric, step)).filter(|length| length.is_finite())
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

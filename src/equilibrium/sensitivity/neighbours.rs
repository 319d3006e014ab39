//! First-order change of a shape along a change of the model itself: of dimensions, materials, magnet or vessel.
//!
//! With the gradient `g(q, p)` of the potential by the unknowns `q` and the number `p` that changes, and the Hessian `H`,
//!
//! ```text
//! dq/dp = -H^-1 @g/@p
//! ```
//!
//! where `@g/@p` is the difference of the exact gradients of two models, with `p` a little smaller and larger, at the same
//! unknowns: no equilibrium is solved anew. The quadrature of rings is that of the model between the two.

use std::sync::Arc;

use crate::design::Design;
use crate::equilibrium::model::Inputs;
use crate::equilibrium::search::Equilibrium;
use crate::error::Error;
use crate::magnetics::Sources;
use crate::numerics::trust_region::{Objective, dual_norm};
use crate::vessel::Vessel;

/// Largest second difference of the gradients, relative to their first difference, of models that differ smoothly: a change of a
/// quadrature between the two gives one.
const SMOOTH: f64 = 0.05;

/// Second difference (radian norm) that may be rounding or the residual of the shape.
const ROUNDED: f64 = 1e-9;

/// A solved shape with its factorised Hessian.
#[derive(Debug)]
pub(crate) struct Linearised {
    model: Equilibrium,
    inputs: Inputs,
    /// Gradient at the shape: what its solve left.
    residual: Vec<f64>,
}

/// How a shape moves from one neighbouring model to the other.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Neighbourhood {
    /// Both models hold their shapes, to first order.
    Smooth,
    /// The models differ in a quadrature, or bodies touch in one of them.
    Broken,
}

impl Equilibrium {
    /// An unsolved model of another device with the settings and the shape points of this one.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub(crate) fn alike(
        &self,
        design: &Design,
        sources: &Sources,
        vessel: Option<&Vessel>,
    ) -> Result<Self, Error> {
        let made = Self::of_checked(design, &Arc::new(sources.clone()), self.settings, self.shape.len())?;
        Ok(match vessel {
            Some(vessel) => made.in_vessel(vessel),
            None => made,
        })
    }

    /// The last solved shape with its Hessian factorised.
    ///
    /// # Errors
    /// [`Error::NoDerivatives`] before the first solved shape, and at a fold.
    pub(crate) fn linearised(&self) -> Result<Linearised, Error> {
        let nothing = || Error::NoDerivatives("nothing is solved yet".into());
        let inputs = self.branch.inputs.clone().ok_or_else(nothing)?;
        let mut model = self.apart();
        let unknowns = model.branch.unknowns.clone();
        let mut potential = model.potential(&inputs, &unknowns);
        potential.factorise_regular(&unknowns)?;
        let residual = potential.gradient().to_vec();
        Ok(Linearised { model, inputs, residual })
    }

    /// The gradient at `unknowns`, by the quadrature rules of `other`; `None` where bodies touch.
    fn gradient_ruled_by(&mut self, other: &Self, inputs: &Inputs, unknowns: &[f64]) -> Option<&[f64]> {
        self.chain.stiffness_at(inputs.insertion, &mut self.metric);
        self.lay_out(inputs);
        self.work.place(&self.chain, inputs, unknowns);
        let chosen: Vec<usize> = other.rules.chosen().collect();
        let mut potential = self.rules.restore(&chosen).then(|| self.potential_as_ruled(inputs))?;
        potential.slope(unknowns)?;
        Some(&self.work.gradient)
    }
}

impl Linearised {
    /// The inputs of the shape.
    pub(crate) fn inputs(&self) -> &Inputs {
        &self.inputs
    }

    /// Moves two neighbouring models, in which something is smaller by `apart[0]` and larger by `apart[1]`, to their equilibria, to
    /// first order; a step of 0 means this model itself. From them all results are read as from a solved model.
    pub(crate) fn lead(
        &mut self,
        mut sides: [(&mut Equilibrium, &Inputs); 2],
        apart: [f64; 2],
    ) -> Neighbourhood {
        let (count, span) = (self.residual.len(), apart[0] + apart[1]);
        let mut gradients = [self.residual.clone(), self.residual.clone()];
        let mut still = [Vec::new(), Vec::new()];
        for (side, (model, inputs)) in sides.iter_mut().enumerate() {
            if model.chain.freedoms() != count {
                return Neighbourhood::Broken;
            }
            model.copy_friction(&self.model);
            still[side] = self.kept_in_place(model, inputs);
            if apart[side] == 0.0 {
                continue;
            }
            match model.gradient_ruled_by(&self.model, inputs, &still[side]) {
                Some(gradient) => gradients[side].copy_from_slice(gradient),
                None => return Neighbourhood::Broken,
            }
        }
        let [before, after] = &gradients;
        let rate: Vec<f64> = before.iter().zip(after).map(|(a, b)| (b - a) / span).collect();
        if !self.is_smooth(&gradients, &rate, apart) {
            return Neighbourhood::Broken;
        }

        let mut step = rate;
        self.model.potential_as_ruled(&self.inputs).solve(&mut step);
        for (side, (model, inputs)) in sides.into_iter().enumerate() {
            let moved = if side == 0 { -apart[0] } else { apart[1] };
            let mut unknowns = std::mem::take(&mut still[side]);
            unknowns.iter_mut().zip(&step).for_each(|(unknown, rate)| *unknown -= moved * rate);
            if self.rest_at(model, inputs, unknowns).is_none() {
                return Neighbourhood::Broken;
            }
        }
        Neighbourhood::Smooth
    }

    /// Leaves a neighbouring model at the shape `unknowns`, evaluated there; `None` where bodies touch.
    fn rest_at(&mut self, model: &mut Equilibrium, inputs: &Inputs, mut unknowns: Vec<f64>) -> Option<()> {
        let left = model.gradient_ruled_by(&self.model, inputs, &unknowns)?;
        if self.model.chain.shaft > 0 {
            // A shaft is so stiff along its axis that what is left of second order would count in the push.
            let mut correction: Vec<f64> = left.iter().zip(&self.residual).map(|(a, b)| a - b).collect();
            self.model.potential_as_ruled(&self.inputs).solve(&mut correction);
            unknowns.iter_mut().zip(&correction).for_each(|(unknown, by)| *unknown -= by);
            model.gradient_ruled_by(&self.model, inputs, &unknowns)?;
        }
        model.branch.unknowns = unknowns;
        model.branch.inputs = Some(inputs.clone());
        Some(())
    }

    /// The unknowns of a neighbouring model at which its bodies are where those of this one are, but for what differs in their
    /// dimensions: a shaft that is inserted farther is compressed by as much.
    fn kept_in_place(&self, other: &Equilibrium, inputs: &Inputs) -> Vec<f64> {
        let mut still = self.model.branch.unknowns.clone();
        let grown = other.inserted(inputs) - self.model.inserted(&self.inputs);
        self.model.growing().for_each(|(unknown, rate)| still[unknown] -= grown * rate);
        still
    }

    /// Whether the gradients of both sides lie on a smooth curve with that of this model.
    fn is_smooth(&self, gradients: &[Vec<f64>; 2], rate: &[f64], apart: [f64; 2]) -> bool {
        let metric = &self.model.metric;
        let unit = self.model.chain.radian_norm();
        let smaller = apart[0].min(apart[1]);
        if smaller == 0.0 {
            return rate.iter().all(|entry| entry.is_finite());
        }
        let [before, after] = gradients;
        let bend: Vec<f64> = (0..rate.len())
            .map(|i| (after[i] - self.residual[i]) / apart[1] - (self.residual[i] - before[i]) / apart[0])
            .collect();
        let allowed = SMOOTH * dual_norm(metric, rate) + ROUNDED * unit / smaller;
        dual_norm(metric, &bend) <= allowed
    }
}

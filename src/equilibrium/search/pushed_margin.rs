//! Stability margin of a shaft whose push is given: its length is free and has no elastic energy of its own.

use super::solver::Equilibrium;
use crate::equilibrium::model::{EigenSearch, Inputs, Potential, THOROUGH};
use crate::numerics::cholesky::dot;
use crate::numerics::trust_region::{Objective, spread};

/// Step, relative to the unknowns, of the difference of two gradients.
const STEP: f64 = 1e-4;

/// Second derivatives of the energy by the inserted length where the strains stay as they are.
struct ByLength {
    /// Of the gradient.
    gradient: Vec<f64>,
    /// Of the push, N/m.
    push: f64,
}

impl Equilibrium {
    /// Stability margin: smallest eigenvalue of `H x = lambda K x` at the last solved shape, with the elastic norm `K` of the
    /// variation of the strains there. It is 1 for the unloaded manipulator without internal forces and 0 at a fold; `None` before
    /// the first solve and where the shape is not stable.
    ///
    /// Where the push on a shaft is given, its length, which has no elastic energy of its own, is condensed first (Schur
    /// complement).
    #[must_use]
    pub fn margin(&self) -> Option<f64> {
        let (inputs, unknowns) = (self.branch.inputs.as_ref()?, &self.branch.unknowns);
        if self.branch.turn.is_some() {
            return Some(0.0); // neutral
        }
        let mut apart = self.apart();
        let free = self.chain.shaft > 0 && inputs.feed_force.is_some() && inputs.insertion > 0.0;
        let by_length = if free { Some(apart.by_length(inputs, unknowns)?) } else { None };

        let mut potential = apart.potential(inputs, unknowns);
        potential.linearise(unknowns)?;
        if !potential.factorise(0.0) {
            return None;
        }
        let margin = match by_length {
            Some(by_length) => condensed(&mut potential, &by_length)?,
            None => potential.measured_margin(&self.branch.softest),
        };
        Some(margin).filter(|margin| margin.is_finite())
    }

    /// Derivatives by the length at constant strains, from those where every body stays in place.
    fn by_length(&mut self, inputs: &Inputs, unknowns: &[f64]) -> Option<ByLength> {
        let in_place = self.by_insertion(inputs, unknowns)?;

        // Displacement of the unknowns from the one variation to the other: strains are amplitudes per length of the shaft.
        let length = self.inserted(inputs);
        let shaft = self.chain.first[self.chain.shaft];
        let mut moved: Vec<f64> = unknowns.iter().map(|unknown| unknown / length).collect();
        moved[shaft..].fill(0.0);
        self.growing().for_each(|(unknown, rate)| moved[unknown] += rate);

        let step = STEP * length;
        let mut slope_at = |step: f64| {
            let shape: Vec<f64> =
                unknowns.iter().zip(&moved).map(|(unknown, by)| unknown + step * by).collect();
            let mut potential = self.potential(inputs, &shape);
            potential.slope(&shape)?;
            Some(potential.gradient().to_vec())
        };
        let (before, after) = (slope_at(-step)?, slope_at(step)?);
        let turned: Vec<f64> = before.iter().zip(&after).map(|(a, b)| (b - a) / (2.0 * step)).collect();

        let push = in_place.push + 2.0 * dot(&moved, &in_place.gradient) + dot(&moved, &turned);
        let gradient = in_place.gradient.iter().zip(&turned).map(|(own, by)| own + by).collect();
        Some(ByLength { gradient, push })
    }
}

/// Smallest eigenvalue with the length condensed; `None` where no constant push holds the shaft.
fn condensed(potential: &mut Potential<'_>, by_length: &ByLength) -> Option<f64> {
    let mut image = by_length.gradient.clone();
    potential.solve(&mut image);
    let stiffness = by_length.push - dot(&by_length.gradient, &image);
    if stiffness.is_nan() || stiffness <= 0.0 {
        return None;
    }

    // The inverse of the condensed Hessian (Sherman and Morrison).
    let mut eigen = EigenSearch::default();
    eigen.norm.update(potential.chain, &potential.work.configurations);
    let mut softest = vec![0.0; potential.chain.freedoms()];
    spread(potential.metric, &mut softest, 1.0);
    let margin = eigen.lanczos.smallest(&eigen.norm, 0.0, &mut softest, THOROUGH, |x| {
        let along = dot(&image, x) / stiffness;
        potential.solve(x);
        x.iter_mut().zip(&image).for_each(|(entry, own)| *entry += along * own);
    });
    Some(margin)
}

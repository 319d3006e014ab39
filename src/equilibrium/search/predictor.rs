//! Predictor: extrapolates the last shapes of a branch to the next one.

use super::history::History;
use crate::equilibrium::model::{Inputs, Model};
use crate::numerics::trust_region::norm;

/// Longest step (radian norm) that is predicted.
const PREDICTED: f64 = 0.1;

impl History {
    /// Writes the shape extrapolated to `target` to `shape` and returns the length of that step in the radian norm.
    /// `None` where the inputs change direction, or the step is too long or too near a fold for extrapolation.
    ///
    /// Linear extrapolation through the last two shapes; quadratic through three (Newton's divided differences) where the
    /// inputs have kept their direction and the two differ by more than the tolerance, which is the error of the shapes
    /// themselves.
    pub(super) fn predicted(&self, target: &Inputs, model: &Model<'_>, shape: &mut [f64]) -> Option<f64> {
        let held = self.stable.is_none_or(|stable| {
            (stable || self.turn.is_some()) && self.margin >= model.settings.fold_margin
        });
        let (Some(here), [(last, before), older @ ..], true) = (&self.inputs, &self.earlier[..], held) else {
            return None;
        };

        let pace = target.pace(here, before)?;
        for ((x, now), then) in shape.iter_mut().zip(&self.unknowns).zip(last) {
            *x = pace * (now - then);
        }
        if let [(oldest, first), ..] = older
            && let Some(quickened) = here.pace(before, first).filter(|pace| *pace > 0.0)
        {
            // Newton's second divided difference, times the product of both distances.
            let curved = pace * (pace + 1.0) / (1.0 + 1.0 / quickened);
            let bends = self.unknowns.iter().zip(last).zip(oldest);
            let bends = bends.map(|((now, then), old)| curved * ((now - then) - quickened * (then - old)));
            let squares = bends.clone().zip(model.metric).map(|(bend, k)| k * bend * bend);
            if squares.sum::<f64>().sqrt() > model.settings.tolerance * model.chain.radian_norm() {
                shape.iter_mut().zip(bends).for_each(|(x, bend)| *x += bend);
            }
        }

        let length = norm(model.metric, shape) / model.chain.radian_norm();
        shape.iter_mut().zip(&self.unknowns).for_each(|(x, now)| *x += now);
        Some(length).filter(|length| *length <= PREDICTED)
    }
}

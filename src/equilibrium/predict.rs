//! Predictor: extrapolates the last shapes of a branch to the next one.

use super::history::History;
use super::inputs::Inputs;
use super::search::{Model, Search};
use crate::numerics::trust_region::norm;

/// Largest correction of a predicted step, relative to its length.
const MISTAKEN: f64 = 0.1;

/// Longest step (radian norm) that is predicted.
const PREDICTED: f64 = 0.1;

impl Search<'_> {
    /// Predicts the next shape and corrects it; returns whether the prediction was possible and nearly right.
    pub(super) fn predict(&mut self, branch: &mut History, target: &Inputs) -> bool {
        let mut trial = std::mem::take(&mut self.scratch.trial);
        let expected = branch.predicted(target, &self.model, &mut trial);
        let found = expected.is_some_and(|length| {
            let reach = (MISTAKEN * length).max(self.model.nearly());
            self.accept(branch.inputs.as_ref(), target, &mut branch.unknowns, &mut trial, reach)
        });
        let found = found && self.settle_friction_of(branch, target);
        self.scratch.trial = trial;
        found
    }
}

impl History {
    /// Writes the shape extrapolated to `target` to `shape` and returns the length of that step in the radian norm.
    /// `None` where the inputs change direction, or the step is too long or too near a fold for extrapolation.
    ///
    /// Linear extrapolation through the last two shapes; quadratic through three (Newton's divided differences) where the
    /// inputs have kept their direction and the two differ by more than the tolerance, which is the error of the shapes
    /// themselves.
    fn predicted(&self, target: &Inputs, model: &Model<'_>, shape: &mut [f64]) -> Option<f64> {
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

//! The stability margin of a solved shape, kept with it: computing it takes as long as ten steps.

use crate::equilibrium::{Equilibrium, Inputs, Settings};
use crate::numerics::trust_region::distance;

/// Change of a shape (radian norm) up to which it counts as the same: that of a solve at unchanged inputs.
const SAME: f64 = 1e-8;

/// A stability margin with the model and the shape that it was computed for.
#[derive(Debug, Clone)]
pub(super) struct MeasuredMargin {
    settings: Settings,
    inputs: Inputs,
    unknowns: Vec<f64>,
    pub(super) value: f64,
}

impl MeasuredMargin {
    /// Computes the margin of the shape of `model`; `None` where it has none.
    pub(super) fn of(model: &Equilibrium) -> Option<Self> {
        let (value, inputs) = (model.margin()?, model.inputs()?.clone());
        Some(Self { settings: *model.settings(), inputs, unknowns: model.unknowns().to_vec(), value })
    }

    /// Whether `model` still has that shape.
    pub(super) fn is_of(&self, model: &Equilibrium) -> bool {
        let alike = self.settings == *model.settings() && model.inputs() == Some(&self.inputs);
        let (now, metric) = (model.unknowns(), model.metric());
        if !alike || now.len() != self.unknowns.len() {
            return false;
        }
        distance(metric, now, &self.unknowns) <= SAME * metric[0].sqrt()
    }
}

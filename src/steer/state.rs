//! A device at its inputs, and steps from one to the next.

use nalgebra::DVector;

use super::bounds::{Bodies, Bound};
use super::constants::{FACE_ROUNDING, MARGIN_DIFFERENCE, NEAR_MARGIN};
use super::limits::{Limit, Limits};
use super::moves::{Freedom, MAGNET, Move, freedoms, moved};
use crate::error::Error;
use crate::manipulator::{Inputs, Manipulator, Outputs, Status};

/// What stays the same on all ways.
#[derive(Debug, Clone)]
pub(super) struct Rules {
    pub(super) bodies: Bodies,
    pub(super) moves: Vec<Move>,
    pub(super) limits: Limits,
}

/// A solved device and its inputs.
#[derive(Debug, Clone)]
pub(super) struct State {
    pub(super) manipulator: Manipulator,
    pub(super) inputs: Inputs,
}

impl State {
    pub(super) fn outputs(&self) -> &Outputs {
        self.manipulator.outputs()
    }

    pub(super) fn freedoms(&self, rules: &Rules) -> Vec<Freedom> {
        freedoms(&rules.moves, &rules.limits, &self.inputs)
    }

    /// The state after a step, or what forbids it.
    pub(super) fn stepped(
        &self,
        rules: &Rules,
        freedoms: &[Freedom],
        step: &DVector<f64>,
    ) -> Result<Result<Self, Limit>, Error> {
        let mut inputs = moved(&self.inputs, freedoms, step);
        let magnet = rules.bodies.magnet.as_ref().and(inputs.sources.get_mut(MAGNET));
        if let (Some([low, high]), Some(magnet)) = (&rules.limits.workspace, magnet) {
            // A step that ends on a face of the box ends there to rounding.
            let place = &mut magnet.pose.position;
            *place = place.zip_zip_map(low, high, |at, low, high| {
                if at < low && low - at < FACE_ROUNDING {
                    low
                } else if at > high && at - high < FACE_ROUNDING {
                    high
                } else {
                    at
                }
            });
        }
        self.at(rules, inputs)
    }

    /// The state at other inputs, followed from here, or what forbids it.
    pub(super) fn at(&self, rules: &Rules, inputs: Inputs) -> Result<Result<Self, Limit>, Error> {
        if let Some(limit) = rules.forbids(&inputs) {
            return Ok(Err(limit));
        }

        let mut next = Self { manipulator: self.manipulator.clone(), inputs };
        let snaps = self.outputs().snaps;
        let outputs = next.manipulator.solve(&next.inputs)?;

        if outputs.status == Status::NotSolved {
            return Ok(Err(Limit::NoShape(outputs.outcome)));
        }
        if outputs.snaps != snaps || outputs.stable == Some(false) {
            return Ok(Err(Limit::Snap));
        }

        if rules.bodies.gap(&next.inputs, outputs) < rules.limits.distance {
            return Ok(Err(Limit::Distance));
        }

        // The margin is bounded at every step, and computed only where it may be below its limit.
        let least = rules.limits.margin;
        if least > 0.0 && outputs.stability_margin < NEAR_MARGIN * least {
            let margin = next.manipulator.measure_margin().stability_margin;
            if margin < least {
                return Ok(Err(Limit::Margin));
            }
        }

        Ok(Ok(next))
    }

    /// Gradient of the stability margin by the freedoms, from the margins of the equilibria a little on both sides; `None` where one
    /// of them does not exist.
    pub(super) fn margin_gradient(&self, freedoms: &[Freedom]) -> Result<Option<DVector<f64>>, Error> {
        let snaps = self.outputs().snaps;
        let mut gradient = DVector::zeros(freedoms.len());
        for (index, rate) in gradient.iter_mut().enumerate() {
            let mut margins = [0.0; 2];
            for (margin, by) in margins.iter_mut().zip([-MARGIN_DIFFERENCE, MARGIN_DIFFERENCE]) {
                let mut step = DVector::zeros(freedoms.len());
                step[index] = by;
                let mut beside = self.manipulator.clone();
                let outputs = beside.solve(&moved(&self.inputs, freedoms, &step))?;
                if outputs.status == Status::NotSolved || outputs.snaps != snaps {
                    return Ok(None);
                }
                *margin = beside.measure_margin().stability_margin;
            }
            *rate = (margins[1] - margins[0]) / (2.0 * MARGIN_DIFFERENCE);
        }
        Ok(Some(gradient))
    }

    /// The least margin as a bound, where it is near.
    pub(super) fn margin_bound(&self, rules: &Rules, freedoms: &[Freedom]) -> Result<Option<Bound>, Error> {
        let (least, margin) = (rules.limits.margin, self.outputs().stability_margin);
        if least <= 0.0 || margin >= NEAR_MARGIN * least {
            return Ok(None);
        }
        let gradient = self.margin_gradient(freedoms)?;
        Ok(gradient.map(|gradient| Bound { limit: Limit::Margin, slack: margin - least, gradient }))
    }
}

impl Rules {
    /// The limit that these inputs exceed before anything is solved.
    fn forbids(&self, inputs: &Inputs) -> Option<Limit> {
        if let (Some([low, high]), Some(magnet)) = (&self.limits.workspace, self.bodies.placed(inputs)) {
            let place = magnet.position;
            let inside = |axis: usize| (low[axis]..=high[axis]).contains(&place[axis]);
            if !(0..3).all(inside) {
                return Some(Limit::Workspace);
            }
        }
        if self.limits.field.is_some_and(|most| inputs.uniform_field.norm() > most * (1.0 + 1e-9)) {
            return Some(Limit::Field);
        }
        (!(0.0..=1.0).contains(&inputs.insertion)).then_some(Limit::Insertion)
    }
}

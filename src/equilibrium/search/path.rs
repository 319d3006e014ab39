//! Paths of inputs that a solve follows, and the steps along them.

use super::evaluator::Aim;
use crate::equilibrium::model::Inputs;

/// Part of a step over which the tangent of a branch is found by a difference.
pub(super) const TANGENT: f64 = 1e-3;

/// Growth factor of the step length after a step that needed a descent.
const FURTHER: f64 = 4.0;

/// A step from an equilibrium to the next one.
#[derive(Debug, Clone, Copy)]
pub(super) struct Step<'a> {
    /// The inputs of the equilibrium where it begins.
    pub(super) before: &'a Inputs,
    /// The inputs where it ends.
    pub(super) inputs: &'a Inputs,
    pub(super) aim: Aim,
    /// Whether the shape where it begins was adopted from another model: no branch leads on from it yet.
    pub(super) adopted: bool,
}

impl<'a> Step<'a> {
    /// A step along a branch.
    pub(super) fn between([before, inputs]: [&'a Inputs; 2], aim: Aim) -> Self {
        Self { before, inputs, aim, adopted: false }
    }
}

/// A straight path of inputs.
#[derive(Debug, Clone)]
pub(super) struct Stage {
    pub(super) from: Inputs,
    pub(super) to: Inputs,
    /// The range of progress that it covers in the whole solve.
    pub(super) progress: [f64; 2],
    pub(super) first: FirstStep,
}

/// The part of a stage that is tried first.
#[derive(Debug, Clone, Copy)]
pub(super) enum FirstStep {
    Part(f64),
    /// As much as the last factorisation predicts to be short enough.
    Predicted,
}

impl Stage {
    /// The inputs at a part of the way.
    pub(super) fn at(&self, part: f64) -> Inputs {
        if part >= 1.0 { self.to.clone() } else { self.from.between(&self.to, part) }
    }

    /// Inputs a small part of the step `from` one part of the way `to` another away from where that begins.
    pub(super) fn nearby(&self, [from, to]: [f64; 2]) -> Inputs {
        self.at(from + TANGENT * (to - from))
    }

    /// Progress of the whole solve at a part of the way.
    pub(super) fn progress_at(&self, part: f64) -> f64 {
        let [from, to] = self.progress;
        from + part * (to - from)
    }
}

/// Length of the next step, as a part of a stage: halved where no shape is found, and doubled where one is.
#[derive(Debug)]
pub(super) struct StepLength {
    part: f64,
    /// The smallest part, and the present bound of the halving.
    smallest: f64,
    floor: f64,
    /// Whether it was halved since the last step that was done.
    halved: bool,
}

impl StepLength {
    pub(super) fn new(first: f64, smallest: f64) -> Self {
        Self { part: first, smallest, floor: smallest, halved: false }
    }

    /// Where a step from `done` ends.
    pub(super) fn end(&self, done: f64) -> f64 {
        f64::min(1.0, done + self.part)
    }

    /// Halves it, unless it is as short as it may be; returns whether it was.
    pub(super) fn halve(&mut self) -> bool {
        let longer = self.part > self.floor;
        if longer {
            (self.part, self.halved) = (0.5 * self.part, true);
        }
        longer
    }

    /// Grows after a step along the branch.
    pub(super) fn grow(&mut self) {
        self.floor = self.smallest;
        self.lengthen();
    }

    /// Grows after a step that needed a descent. Repeated descents mean that the branch is steep or nearly neutral: shorter steps do
    /// not help.
    pub(super) fn grow_past_descent(&mut self) {
        self.floor *= FURTHER;
        self.lengthen();
    }

    /// A length that has just failed is not tried again at once.
    fn lengthen(&mut self) {
        self.part = self.floor.max(if self.halved { self.part } else { 2.0 * self.part });
        self.halved = false;
    }
}

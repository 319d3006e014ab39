//! Evaluations of the potential in a search: the shape they are at, and what they may cost.

use super::deadline::Deadline;
use super::outcome::Budget;
use crate::equilibrium::contact::VesselContact;
use crate::equilibrium::model::{
    FreeTurn, Inputs, Model, PairQuadrature, Potential, Surroundings, Workspace,
};
use crate::numerics::trust_region::{Region, distance};

/// Distance to the root (radian norm) within which the Hessian of the next shape suffices for all further steps.
pub(super) const NEARLY: f64 = 1e-4;

/// Step length (radian norm) below which rounding, not Newton's method, determines the step.
pub(super) const ROUNDING: f64 = 1e-9;

/// Residual (radian norm) at which a shape on the way to the target counts as solved, and a descent there ends: the bottom
/// of a nearly neutral valley is only sought at the final inputs.
pub(super) const PASSING: f64 = 1e-5;

/// First radius of the trust region past a fold, in the radian norm: small, so that the path of descent is followed.
const FIRST_RADIUS: f64 = 0.1;

/// What a shape is sought for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Aim {
    /// It is on the way to the target and need not be exact.
    Pass,
    /// It is the one that was asked for.
    Rest,
}

/// How far the shape evaluated last is from equilibrium.
#[derive(Debug, Clone, Copy)]
pub(super) struct Balance {
    /// Dual norm of the gradient in the radian norm.
    pub(super) residual: f64,
    /// Potential energy, J.
    pub(super) energy: f64,
}

/// A model with its workspace, for the length of one solve.
pub(super) struct Evaluator<'a> {
    pub(super) model: Model<'a>,
    pub(super) work: &'a mut Workspace,
    pub(super) rules: &'a mut PairQuadrature,
    pub(super) contact: Option<&'a mut VesselContact>,
    pub(super) deadline: &'a Deadline,
    /// Newton iterations of this solve so far.
    pub(super) iterations: u32,
    pub(super) balance: Balance,
}

impl Evaluator<'_> {
    pub(super) fn potential<'b>(&'b mut self, inputs: &'b Inputs) -> Potential<'b> {
        let around = self.contact.as_deref_mut().map(|contact| contact as &mut dyn Surroundings);
        self.model.potential(inputs, self.rules, around, self.work)
    }

    /// Chooses the quadrature rules for a shape.
    pub(super) fn choose_rules(&mut self, inputs: &Inputs, unknowns: &[f64]) {
        self.work.place(self.model.chain, inputs, unknowns);
        self.choose_rules_here();
    }

    /// Chooses the quadrature rules for the shape evaluated last; returns whether any has changed.
    pub(super) fn choose_rules_here(&mut self) -> bool {
        self.rules.choose(self.model.chain, &self.work.nodes)
    }

    /// The unit of steps and residuals, in the elastic norm.
    pub(super) fn unit(&self) -> f64 {
        self.model.chain.radian_norm()
    }

    /// Distance of two shapes in the elastic norm.
    pub(super) fn distance(&self, a: &[f64], b: &[f64]) -> f64 {
        distance(self.model.metric, a, b)
    }

    /// Residual at which a correction ends.
    pub(super) fn tolerance(&self, aim: Aim) -> f64 {
        let tolerance = self.model.settings.tolerance;
        if aim == Aim::Pass { tolerance.max(PASSING) } else { tolerance }
    }

    /// Residual at which a descent ends.
    pub(super) fn resting(&self, aim: Aim) -> f64 {
        if aim == Aim::Pass { PASSING } else { self.model.settings.tolerance.max(ROUNDING) }
    }

    /// Distance to the root (radian norm) at which a shape counts as nearly solved: at least as far as other quadrature rules
    /// move it.
    pub(super) fn nearly(&self) -> f64 {
        NEARLY.max(self.model.settings.pair_accuracy)
    }

    /// The trust region of a descent that ends at this residual (radian norm).
    pub(super) fn region(&self, tolerance: f64) -> Region {
        let unit = self.unit();
        Region {
            radius: FIRST_RADIUS * unit,
            largest: unit,
            tolerance: tolerance * unit,
            iterations: self.left(),
        }
    }
}

/// The budget.
impl Evaluator<'_> {
    /// Remaining iterations of this solve.
    pub(super) fn left(&self) -> u32 {
        self.model.settings.iterations.saturating_sub(self.iterations)
    }

    /// Whether iterations and time are left.
    pub(super) fn may_go_on(&self) -> bool {
        self.spent().is_none()
    }

    /// What is used up, if anything is.
    pub(super) fn spent(&self) -> Option<Budget> {
        if self.left() == 0 {
            return Some(Budget::Iterations);
        }
        self.deadline.has_passed().then_some(Budget::Time)
    }
}

/// The free turn of a device and loads that are symmetric about the axis of the clamp.
impl Evaluator<'_> {
    /// Holds the free turn of the last shape for the way to `target`, unless the loads there are not symmetric.
    pub(super) fn take_up_turn(&mut self, turn: Option<FreeTurn>, target: &Inputs) {
        self.work.free_turn = turn.filter(|_| self.is_symmetric(target));
        if self.work.free_turn != turn {
            self.work.factorisation = None;
        }
    }

    /// Holds the free turn of a shape from now on, if there is one; returns whether there is.
    pub(super) fn hold_turn(&mut self, inputs: &Inputs, unknowns: &[f64]) -> bool {
        let (chain, metric) = (self.model.chain, self.model.metric);
        let symmetric = self.is_symmetric(inputs);
        self.work.free_turn = if symmetric { FreeTurn::of(chain, metric, unknowns) } else { None };
        self.work.free_turn.is_some()
    }

    /// Whether the loads at `inputs` leave a turn free that is held, if any; else it is no longer held.
    pub(super) fn is_still_free(&mut self, inputs: &Inputs) -> bool {
        let free = self.work.free_turn.is_none() || self.is_symmetric(inputs);
        if !free {
            (self.work.free_turn, self.work.factorisation) = (None, None);
        }
        free
    }

    /// Whether device and loads are symmetric about the axis of the clamp.
    pub(super) fn is_symmetric(&mut self, inputs: &Inputs) -> bool {
        let root = inputs.root();
        self.model.chain.axisymmetric
            && self.contact.as_deref().is_none_or(|contact| contact.is_symmetric_about(&root))
            && self.potential(inputs).terms.are_symmetric_about(&root)
    }
}

//! Search for an equilibrium: the state that its steps share.

use super::chain::Chain;
use super::deadline::Deadline;
use super::inputs::Inputs;
use super::outcome::Budget;
use super::pair_quadrature::PairQuadrature;
use super::potential::{EigenSearch, Potential};
use super::report::Report;
use super::settings::Settings;
use super::surface::InVessel;
use super::terms::Terms;
use super::workspace::Workspace;
use crate::magnetics::Sources;

/// Distance to the root (radian norm) within which the Hessian of the next shape suffices for all further steps.
pub(super) const NEARLY: f64 = 1e-4;

/// Step length (radian norm) below which rounding, not Newton's method, determines the step.
pub(super) const ROUNDING: f64 = 1e-9;

/// Residual (radian norm) at which a shape on the way to the target counts as solved, and a descent there ends: the bottom
/// of a nearly neutral valley is only sought at the final inputs.
pub(super) const PASSING: f64 = 1e-5;

/// Maximum number of Newton corrections for one part of an input change.
pub(super) const CORRECTIONS: usize = 12;

/// The parts of a model that do not change from solve to solve.
#[derive(Debug, Clone, Copy)]
pub(super) struct Model<'a> {
    pub(super) chain: &'a Chain,
    /// Diagonal elastic stiffness of all unknowns.
    pub(super) metric: &'a [f64],
    pub(super) settings: &'a Settings,
    pub(super) sources: &'a Sources,
    pub(super) around: Option<&'a InVessel>,
}

impl<'a> Model<'a> {
    /// Distance to the root (radian norm) at which a shape counts as nearly solved: at least as far as other quadrature rules
    /// move it.
    pub(super) fn nearly(&self) -> f64 {
        NEARLY.max(self.settings.pair_accuracy)
    }

    /// The potential at `inputs` with the quadrature rules chosen last.
    pub(super) fn potential(
        &self,
        inputs: &'a Inputs,
        rules: &'a PairQuadrature,
        work: &'a mut Workspace,
    ) -> Potential<'a> {
        let Self { chain, metric, settings, sources, around } = *self;
        let vessel = around.map(|around| &around.vessel);
        let mut terms = Terms::new(chain, settings, sources, vessel, inputs, rules);
        terms.magnets = terms.magnets.seen_by(chain, settings.pair_accuracy);
        let surface = around.map(|around| &around.surface);
        Potential { chain, metric, settings, inputs, terms, rules, surface, work }
    }
}

/// Buffers of a solve, kept so that a step along the branch allocates nothing.
#[derive(Debug, Clone)]
pub(super) struct Scratch {
    pub(super) last: Vec<f64>,
    pub(super) trial: Vec<f64>,
    /// Difference of two shapes, and the step back.
    pub(super) between: Vec<f64>,
    /// Steps with one factorisation.
    pub(super) steps: Vec<Vec<f64>>,
    pub(super) eigen: EigenSearch,
}

impl Scratch {
    pub(super) fn new(chain: &Chain) -> Self {
        let zeros = vec![0.0; chain.freedoms()];
        Self {
            last: zeros.clone(),
            trial: zeros.clone(),
            between: zeros.clone(),
            steps: vec![zeros; CORRECTIONS],
            eigen: EigenSearch::default(),
        }
    }
}

/// A search for the equilibrium at given inputs, in progress.
pub(super) struct Search<'a> {
    pub(super) model: Model<'a>,
    pub(super) work: &'a mut Workspace,
    pub(super) rules: &'a mut PairQuadrature,
    pub(super) scratch: &'a mut Scratch,
    pub(super) report: Report,
    pub(super) deadline: &'a Deadline,
    /// The last equilibrium on the way to the target.
    pub(super) reached: Option<(Inputs, Vec<f64>)>,
    /// Stability margin at the last assessment, of all directions but a free turn, and the direction of least stiffness.
    pub(super) margin: f64,
    pub(super) softest: Vec<f64>,
    /// Largest drift of loads and shape from the last factorisation for which that counts as valid.
    pub(super) reach: f64,
    /// Whether the shape in search is one on the way to the target: it need not be exact.
    pub(super) passing: bool,
    /// Whether the last correction ended so close to the last factorisation that its stability result is still valid.
    pub(super) kept: bool,
}

impl Search<'_> {
    pub(super) fn potential<'b>(&'b mut self, inputs: &'b Inputs) -> Potential<'b> {
        self.model.potential(inputs, self.rules, self.work)
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

    /// Residual at which a descent to the target ends.
    pub(super) fn resting(&self) -> f64 {
        self.model.settings.tolerance.max(ROUNDING)
    }

    /// Remaining iterations of this solve.
    pub(super) fn left(&self) -> u32 {
        self.model.settings.iterations.saturating_sub(self.report.iterations)
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

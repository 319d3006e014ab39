//! What a model consists of, and its potential.

use super::chain::Chain;
use super::inputs::Inputs;
use super::pair_quadrature::PairQuadrature;
use super::potential::Potential;
use super::settings::Settings;
use super::surroundings::Surroundings;
use super::terms::Terms;
use super::workspace::Workspace;
use crate::magnetics::Sources;

/// The parts of a model that do not change from solve to solve.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Model<'a> {
    pub(crate) chain: &'a Chain,
    /// Diagonal elastic stiffness of all unknowns.
    pub(crate) metric: &'a [f64],
    pub(crate) settings: &'a Settings,
    pub(crate) sources: &'a Sources,
}

impl<'a> Model<'a> {
    /// The potential at `inputs` with the quadrature rules chosen last, of a chain that `around` may surround.
    pub(crate) fn potential(
        &self,
        inputs: &'a Inputs,
        rules: &'a PairQuadrature,
        around: Option<&'a mut dyn Surroundings>,
        work: &'a mut Workspace,
    ) -> Potential<'a> {
        let Self { chain, metric, settings, sources } = *self;
        let mut terms = Terms::new(chain, settings, sources, inputs, rules);
        terms.magnets = terms.magnets.seen_by(chain, settings.pair_accuracy);
        Potential { chain, metric, settings, inputs, terms, rules, around, work }
    }
}

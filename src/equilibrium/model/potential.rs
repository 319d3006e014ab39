//! Potential energy of the whole chain, with exact gradient and Hessian.

use nalgebra::Vector3;

use super::chain::Chain;
use super::condensation::Condensation;
use super::elastic_norm::ElasticNorm;
use super::free_turn::{FreeTurn, direction};
use super::inputs::Inputs;
use super::pair_quadrature::PairQuadrature;
use super::settings::Settings;
use super::surroundings::Surroundings;
use super::terms::Terms;
use super::workspace::{PlacedLoads, Workspace};
use crate::numerics::arnoldi::smallest_real_part;
use crate::numerics::eigenvalue::{Deflation, Lanczos, Search};
use crate::numerics::trust_region::{Objective, spread};
use crate::rod::{ElementLoads, Order};

/// Number of Arnoldi vectors for the eigenvalues of a non-symmetric matrix.
const ARNOLDI: usize = 48;

/// Weight of the second softest direction in the guess for the next search, which finds it once it is the softest.
const SECOND: f64 = 0.5;

/// Weight of all directions that are mixed into the last softest direction before the next search.
pub(crate) const EVERY_DIRECTION: f64 = 0.3;

/// Search effort for the stability margin when the user asks for it: nine digits where the second softest direction is a hundredth
/// stiffer.
pub(crate) const THOROUGH: Search = Search { vectors: 120, settled: 3e-6 };

/// Storage of the searches for the stability margin, kept so that they do not allocate.
#[derive(Debug, Clone, Default)]
pub(crate) struct EigenSearch {
    pub(crate) lanczos: Lanczos,
    /// The norm at the shape of the last search.
    pub(crate) norm: ElasticNorm,
}

/// The potential at given inputs.
#[derive(Debug)]
pub(crate) struct Potential<'a> {
    pub(crate) chain: &'a Chain,
    /// Diagonal elastic stiffness of all unknowns.
    pub(crate) metric: &'a [f64],
    pub(crate) settings: &'a Settings,
    pub(crate) inputs: &'a Inputs,
    pub(crate) terms: Terms<'a>,
    pub(crate) rules: &'a PairQuadrature,
    /// The vessel, if there is one.
    pub(crate) around: Option<&'a mut dyn Surroundings>,
    pub(crate) work: &'a mut Workspace,
}

impl Potential<'_> {
    /// Stability margin: smallest eigenvalue of the last factorised Hessian in the elastic norm at the shape placed last, an
    /// upper bound found by `search`. It is positive where the shape is stable and NaN where none is found. `softest` is the
    /// initial guess and then that of the next search: the eigenvector with a share of the second softest one.
    ///
    /// For non-conservative forces it is the smallest real part of the eigenvalues: where that is negative, the shape
    /// diverges in overdamped motion. Flutter, a pair of complex eigenvalues of the undamped motion, is not covered: it
    /// depends on masses and damping, which are not part of statics.
    pub(crate) fn margin(&mut self, eigen: &mut EigenSearch, softest: &mut [f64], search: Search) -> f64 {
        let EigenSearch { lanczos, norm } = eigen;
        norm.update(self.chain, &self.work.configurations);
        // A free turn is an eigenvector of its own: the others are orthogonal to it.
        let turn = self.work.free_turn.map(|_| direction(self.chain, &self.work.placed));
        let without_turn = turn.map(|turn| Deflation::new(norm, turn));
        let symmetric = self.terms.have_potential();
        let mut solve = |x: &mut [f64]| {
            self.solve(x);
            if let Some(deflation) = &without_turn {
                deflation.apply(x);
            }
        };
        if let Some(deflation) = &without_turn {
            deflation.apply(softest);
        }

        if !symmetric {
            return smallest_real_part(norm, softest, ARNOLDI, solve).unwrap_or(f64::NAN);
        }
        let margin = lanczos.smallest(norm, 0.0, softest, search, &mut solve);
        lanczos.add_second(SECOND, softest);
        margin
    }

    /// Stability margin of the shape factorised last, to about nine digits; `near` is a guess of the softest direction.
    pub(crate) fn measured_margin(&mut self, near: &[f64]) -> f64 {
        let mut softest = near.to_vec();
        // With a share of all directions, so that a mode orthogonal to the guess is not missed.
        spread(self.metric, &mut softest, EVERY_DIRECTION);
        self.margin(&mut EigenSearch::default(), &mut softest, THOROUGH)
    }

    /// Whether the shape factorised last is stable, as far as its factorisation tells; see [`Potential::margin`]. Where
    /// the symmetric part is positive definite, no displacement gains energy, conservative forces or not.
    pub(crate) fn is_stable(&mut self) -> bool {
        if self.work.factorisation.as_ref().is_some_and(|factorisation| factorisation.definite) {
            return true;
        }
        self.measured_margin(&vec![0.0; self.metric.len()]) > 0.0
    }

    /// Removes from the gradient at `unknowns` its part along a free turn.
    pub(crate) fn leave_out_turn(&mut self, unknowns: &[f64]) {
        if self.work.free_turn.is_some() {
            FreeTurn::project(self.chain, self.metric, unknowns, &mut self.work.gradient);
        }
    }

    /// Adds to `x` the Newton step from the last gradient with the last factorisation; the gradient is overwritten.
    pub(crate) fn add_newton_step(&mut self, x: &mut [f64]) {
        let mut step = std::mem::take(&mut self.work.gradient);
        self.solve(&mut step);
        x.iter_mut().zip(&step).for_each(|(x, s)| *x -= s);
        self.work.gradient = step;
    }

    /// Computes the gradient recursively from the tip to the base and, where storage for the condensations is given, the
    /// element Hessians.
    pub(crate) fn backward(
        &mut self,
        unknowns: &[f64],
        mut condensations: Option<&mut [Condensation]>,
    ) -> bool {
        let order = if condensations.is_some() { Order::Hessian } else { Order::Gradient };
        let mut force = Vector3::zeros();
        let mut moment = Vector3::zeros();
        for (k, element) in self.chain.elements.iter().enumerate().rev() {
            let load = &self.work.node_loads[k + 1];
            force += load.force;
            moment += load.moment();

            let axes = self.work.nodes[k].rotation;
            let tangent = &mut self.work.derivatives[k];
            let PlacedLoads { loads: placed, couplings, .. } = &self.work.placed_loads[k];
            let loads = ElementLoads {
                stations: &self.work.station_loads[k],
                placed,
                couplings,
                end: (axes.tr_mul(&force), axes.tr_mul(&moment)),
            };
            let amplitudes = self.chain.part(k, unknowns);
            tangent.assemble(element, &self.work.configurations[k], amplitudes, &loads, order);

            // In the axes of the world, as the load on the element before.
            let g = &tangent.gradient;
            force = axes * Vector3::new(g[0], g[1], g[2]);
            moment = axes * Vector3::new(g[3], g[4], g[5]);
            self.work.gradient[self.chain.first[k]..self.chain.first[k + 1]].copy_from_slice(&g[6..]);

            let linearised = condensations.as_deref_mut().is_none_or(|all| self.linearise_element(k, all));
            if !linearised {
                return false;
            }
        }

        let base = &self.work.node_loads[0];
        self.work.base = (force + base.force, moment + base.moment());
        self.work.gradient.iter().all(|entry| entry.is_finite())
    }

    /// Condenses an element whose Hessian was assembled last, and mixes it with the rings that act on it; returns whether it could be.
    fn linearise_element(&mut self, k: usize, condensations: &mut [Condensation]) -> bool {
        if !condensations[k].linearise(&self.work.configurations[k], &self.work.derivatives[k]) {
            return false;
        }
        if self.terms.spans.act() {
            self.mix(k);
        }
        true
    }
}

//! Equilibrium of one manipulator: solve it, then read poses and wrenches.

use std::sync::Arc;

use nalgebra::DMatrix;

use super::corrector::Corrector;
use super::deadline::Deadline;
use super::evaluator::{Balance, Evaluator};
use super::follow::Search;
use super::history::History;
use super::report::Report;
use super::scratch::Scratch;
use super::solution::Solution;
use super::solve::KEPT;
use super::stability::Stability;
use crate::design::Design;
use crate::equilibrium::contact::VesselContact;
use crate::equilibrium::model::{
    Chain, ElasticNorm, Inputs, Interaction, Model, PairQuadrature, Potential, Settings, ShapePoint,
    Surroundings, Terms, Workspace, arc_lengths, point_at,
};
use crate::error::Error;
use crate::geometry::Pose;
use crate::magnetics::Sources;
use crate::numerics::trust_region::Objective;
use crate::rod::Row;
use crate::vessel::Vessel;

/// Ratio by which a shaft must become shorter in a step for the margin to be measured anew.
const PULLED_OUT: f64 = 1.02;

/// Equilibrium of a manipulator, with the branch that it follows.
///
/// A clone is a full snapshot: its further solves agree bit for bit with those of the original.
#[derive(Debug, Clone)]
pub struct Equilibrium {
    pub(crate) chain: Arc<Chain>,
    /// Diagonal elastic stiffness of all unknowns at the inputs of the last evaluation.
    pub(crate) metric: Vec<f64>,
    pub(crate) settings: Settings,
    pub(crate) sources: Arc<Sources>,
    /// The vessel around it, if there is one.
    pub(crate) contact: Option<VesselContact>,
    pub(crate) shape: Arc<Vec<ShapePoint>>,
    pub(crate) branch: History,
    pub(crate) work: Workspace,
    pub(crate) rules: PairQuadrature,
    scratch: Scratch,
    /// Growth of the shaft for which the shape points are placed.
    laid_out: f64,
}

impl Equilibrium {
    /// Creates the straight, unloaded manipulator; `shape_points` is the number of centreline points, at least 2.
    ///
    /// # Errors
    /// [`Error::Range`] for settings or a number of points out of range, [`Error::Unsupported`] for
    /// [`Interaction::Auto`], which needs several models.
    pub fn new(
        design: &Design,
        sources: impl Into<Sources>,
        settings: Settings,
        shape_points: usize,
    ) -> Result<Self, Error> {
        Self::shared(design, &Arc::new(sources.into()), settings, shape_points)
    }

    /// As [`Self::new`], for sources that several models share.
    pub(crate) fn shared(
        design: &Design,
        sources: &Arc<Sources>,
        settings: Settings,
        shape_points: usize,
    ) -> Result<Self, Error> {
        Self::of_checked(design, sources, settings.checked()?, shape_points)
    }

    /// As [`Self::new`], for settings that are already checked; their degree may exceed the range that users may set.
    pub(crate) fn of_checked(
        design: &Design,
        sources: &Arc<Sources>,
        settings: Settings,
        shape_points: usize,
    ) -> Result<Self, Error> {
        if settings.interaction == Interaction::Auto {
            return Err(Error::Unsupported(
                "an equilibrium of one model has no level `auto`: a manipulator has".into(),
            ));
        }

        let arc_lengths = arc_lengths(design.length(), shape_points)?;
        let chain = Chain::shared(design, &settings)?;
        let shape = arc_lengths.map(|s| point_at(&chain, 0.0, s));
        let (work, rules) = (Workspace::new(&chain, &settings), PairQuadrature::new(&chain, &settings));

        let mut out = Self {
            metric: chain.metric.clone(),
            settings,
            sources: Arc::clone(sources),
            contact: None,
            shape: Arc::new(shape.collect()),
            branch: History::new(&chain),
            work,
            rules,
            scratch: Scratch::new(&chain),
            laid_out: f64::NAN,
            chain,
        };
        out.reset();
        Ok(out)
    }

    /// This manipulator, unsolved, in a vessel.
    #[must_use]
    pub fn in_vessel(mut self, vessel: &Vessel) -> Self {
        self.contact = Some(VesselContact::new(vessel, &self.chain));
        self.reset();
        self
    }

    /// Whether both use the same tables of modes and quadratures in memory: all models of one design and discretisation that
    /// live in a process do.
    ///
    /// ```
    /// use mcm::equilibrium::Equilibrium;
    /// use mcm::manipulator::Scene;
    /// let scene = Scene::parse("[model]\ninteraction = \"rings\"", "doc")?;
    /// let made = || Equilibrium::new(&scene.design()?, None, scene.settings, 2);
    /// let (first, second) = (made()?, made()?);
    /// assert!(first.shares_tables_with(&second));
    /// # Ok::<(), mcm::error::Error>(())
    /// ```
    #[must_use]
    pub fn shares_tables_with(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.chain, &other.chain)
    }

    /// Returns to the straight shape at the origin and forgets the branch.
    pub fn reset(&mut self) {
        let straight = Inputs::unloaded(0);
        self.branch = History::new(&self.chain);
        self.work.forget();
        if let Some(contact) = &mut self.contact {
            contact.forget();
        }
        self.lay_out(&straight);
        self.work.place(&self.chain, &straight, &self.branch.unknowns);
    }

    /// Evaluates the last good shape again, from which results are read: a solve that fails leaves its last trial.
    fn go_back(&mut self) {
        let Some(inputs) = self.branch.inputs.clone() else { return self.reset() };
        let unknowns = self.branch.unknowns.clone();
        self.lay_out(&inputs);
        // It was evaluated when it was found.
        let _ = self.potential(&inputs, &unknowns).slope(&unknowns);
    }

    /// Fraction of the closed section's stiffness that the windings of each core have reached, 0 (open) to 1, whether or
    /// not the model has the bending stop.
    pub(crate) fn closed_windings(&self) -> impl Iterator<Item = f64> + '_ {
        let stops = self.chain.cores.iter().map(|(first, _)| self.chain.elements[*first].stop.as_ref());
        self.core_angles().zip(stops).map(|(angle, stop)| stop.map_or(0.0, |stop| stop.closed(angle)))
    }

    /// Number that tells the quadrature rules of the last shape from others.
    pub(crate) fn quadrature_fingerprint(&self) -> u32 {
        self.rules.fingerprint()
    }

    /// The settings of the model and its solver.
    #[must_use]
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// Sets the residual at which a solve ends.
    pub(crate) fn set_tolerance(&mut self, tolerance: f64) {
        self.settings.tolerance = tolerance;
    }

    /// Follows the branch to `inputs`.
    ///
    /// A solve that fails keeps the last good shape with all that is read of it; one whose budget ends keeps the last equilibrium
    /// on the way, at [`Self::inputs`]. Before the first shape that is the straight, unloaded one.
    ///
    /// # Errors
    /// [`Error::Range`] or [`Error::Count`] for inputs that are not finite or not of the right length; the branch is then
    /// unchanged. A solve that fails is not an error: see [`Report::solved`].
    pub fn solve(&mut self, inputs: &Inputs) -> Result<Report, Error> {
        self.solve_before(&Deadline::new(self.settings.time_budget), inputs)
    }

    /// As [`Self::solve`], within a time budget that other solves may share.
    pub(crate) fn solve_before(&mut self, deadline: &Deadline, inputs: &Inputs) -> Result<Report, Error> {
        self.check(inputs)?;
        self.lay_out(inputs);
        // Steps are measured by the longest shaft on the way: by one that is all but pulled out, none would be short.
        let longest = self.branch.inputs.as_ref().map_or(0.0, |last| last.insertion).max(inputs.insertion);
        let pulled_out = self.chain.shaft > 0 && longest > PULLED_OUT * inputs.insertion;
        if pulled_out {
            self.chain.stiffness_at(longest, &mut self.metric);
        }
        let mut report = self.search(deadline, inputs);
        if pulled_out {
            self.chain.stiffness_at(inputs.insertion, &mut self.metric);
            if report.solved()
                && let Some(margin) = self.margin()
            {
                (report.margin, self.branch.margin) = (margin, margin);
            }
        }
        if !report.solved() {
            self.go_back();
        }
        Ok(report)
    }

    fn search(&mut self, deadline: &Deadline, inputs: &Inputs) -> Report {
        let Self { chain, metric, settings, sources, contact, branch, work, rules, scratch, .. } = self;
        let Scratch { last, buffers, eigen } = scratch;
        let evaluator = Evaluator {
            model: Model { chain, metric, settings, sources },
            work,
            rules,
            contact: contact.as_mut(),
            deadline,
            iterations: 0,
            balance: Balance { residual: f64::INFINITY, energy: 0.0 },
        };
        let drift = KEPT * if branch.stable.is_some() { branch.margin } else { 1.0 };
        let mut search = Search {
            corrector: Corrector { evaluator, buffers, drift },
            stability: Stability {
                margin: branch.margin,
                softest: std::mem::take(&mut branch.softest),
                eigen,
            },
            progress: 0.0,
            snaps: 0,
            reached: None,
        };

        let report = search.solve(branch, inputs, last);
        branch.softest = search.stability.softest;
        report
    }

    /// Checks the numbers of inputs.
    ///
    /// # Errors
    /// As [`Self::solve`].
    pub(crate) fn check(&self, inputs: &Inputs) -> Result<(), Error> {
        inputs.check(self.chain.rings.len())?;
        inputs.check_sources(&self.sources, self.branch.inputs.as_ref())
    }

    /// The inputs of the last solved shape.
    #[must_use]
    pub fn inputs(&self) -> Option<&Inputs> {
        self.branch.inputs.as_ref()
    }

    /// Number of unknowns.
    #[must_use]
    pub fn freedoms(&self) -> usize {
        self.chain.freedoms()
    }

    /// Strain mode amplitudes of the present shape.
    #[must_use]
    pub fn unknowns(&self) -> &[f64] {
        &self.branch.unknowns
    }

    /// Diagonal elastic stiffness `K` with respect to the unknowns, about the straight shape, at the last inputs.
    #[must_use]
    pub fn metric(&self) -> &[f64] {
        &self.metric
    }

    /// Elastic norm `K` of a variation of the unknowns at any shape: `x^T K x` is the integral of `du^T K_bt du + dv^T K_se dv` over
    /// the variations of its curvature and stretch.
    pub fn elastic_norm(&mut self, inputs: &Inputs, unknowns: &[f64]) -> DMatrix<f64> {
        let mut norm = ElasticNorm::default();
        let potential = self.potential(inputs, unknowns);
        norm.update(potential.chain, &potential.work.configurations);
        norm.to_dense()
    }

    /// Energy (J) and its gradient with respect to the unknowns at any shape; `None` where bodies touch.
    pub fn gradient(&mut self, inputs: &Inputs, unknowns: &[f64]) -> Option<(f64, Vec<f64>)> {
        let mut potential = self.potential(inputs, unknowns);
        let energy = potential.linearise(unknowns)?;
        Some((energy, potential.gradient().to_vec()))
    }

    /// Solves `(H + shift K) y = rhs` with the Hessian at any shape; `None` where it is not positive definite.
    pub fn solve_at(
        &mut self,
        inputs: &Inputs,
        unknowns: &[f64],
        shift: f64,
        rhs: &[f64],
    ) -> Option<Vec<f64>> {
        let mut potential = self.potential(inputs, unknowns);
        potential.linearise(unknowns)?;
        let mut solution = rhs.to_vec();
        let solved = potential.factorise(shift).then(|| {
            potential.solve(&mut solution);
            solution
        });
        self.work.factorisation = None; // it does not belong to the branch
        solved
    }

    pub(crate) fn potential<'a>(&'a mut self, inputs: &'a Inputs, unknowns: &[f64]) -> Potential<'a> {
        self.chain.stiffness_at(inputs.insertion, &mut self.metric);
        self.work.place(&self.chain, inputs, unknowns);
        self.rules.choose(&self.chain, &self.work.nodes);
        self.potential_as_ruled(inputs)
    }

    /// The potential with the quadrature rules chosen last.
    pub(crate) fn potential_as_ruled<'a>(&'a mut self, inputs: &'a Inputs) -> Potential<'a> {
        let Self { chain, metric, settings, sources, contact, work, rules, .. } = self;
        let around = contact.as_mut().map(|contact| contact as &mut dyn Surroundings);
        Model { chain, metric, settings, sources }.potential(inputs, rules, around, work)
    }

    /// Copy of the branch with its own workspace, whose evaluations do not change the original.
    pub(crate) fn apart(&self) -> Self {
        Self {
            chain: Arc::clone(&self.chain),
            metric: self.metric.clone(),
            settings: self.settings,
            sources: Arc::clone(&self.sources),
            contact: self.contact.clone(),
            shape: Arc::clone(&self.shape),
            branch: self.branch.clone(),
            work: Workspace::new(&self.chain, &self.settings),
            rules: self.rules.clone(),
            scratch: Scratch::new(&self.chain),
            laid_out: self.laid_out,
        }
    }

    pub(crate) fn vessel(&self) -> Option<&Vessel> {
        self.contact.as_ref().map(VesselContact::vessel)
    }

    /// All energy terms at `inputs`, with the quadrature rules chosen last.
    pub(crate) fn terms<'a>(&'a self, inputs: &'a Inputs) -> Terms<'a> {
        Terms::new(&self.chain, &self.settings, &self.sources, inputs, &self.rules)
    }

    /// Adapts stiffness and shape points to the inserted length of a shaft.
    pub(crate) fn lay_out(&mut self, inputs: &Inputs) {
        let length = self.chain.growth(inputs.insertion);
        if self.chain.shaft == 0 || self.laid_out.to_bits() == length.to_bits() {
            return;
        }
        self.laid_out = length;
        self.chain.stiffness_at(inputs.insertion, &mut self.metric);
        let whole = self.chain.inserted(length) + self.chain.length();
        let count = self.shape.len() - 1;
        let places = (0..=count).map(|i| point_at(&self.chain, length, whole * i as f64 / count as f64));
        self.shape = Arc::new(places.collect());
    }

    pub(crate) fn on_element(&self, element: usize, row: &Row) -> Pose {
        let unknowns = self.chain.part(element, &self.branch.unknowns);
        let local = self.work.configurations[element].pose_at(&self.chain.elements[element], row, unknowns);
        self.work.nodes[element].compose(&local)
    }
}

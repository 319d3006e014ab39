//! The equilibrium by a comparison method, with the interface of [`crate::equilibrium::Equilibrium`].

use std::sync::Arc;

use nalgebra::{Matrix3, Vector3, Vector6};

use super::engine::Engine;
use super::line::Line;
use super::method::Method;
use super::plane::Plane;
use super::settings::Settings;
use super::shape::Shape;
use super::surroundings::Surroundings;
use super::trace::{Totals, Trace};
use crate::design::Design;
use crate::equilibrium::{
    self, Contact, Inputs, Interaction, Outcome, PairQuadrature, Placed, Report, Solution, TermWrenches,
    Terms, arc_lengths,
};
use crate::error::Error;
use crate::geometry::Pose;
use crate::magnetics::{Sources, Wrench};
use crate::rod::Order;

/// Largest number of changes of the pair quadrature at a solved shape.
const RULE_CHOICES: u32 = 3;

/// The equilibrium of a manipulator by a comparison method.
///
/// The first solve starts from the straight shape, later ones from the last solution. Where the whole change of the inputs does
/// not converge, parts of it are tried ([`Settings::smallest_part`]). A clone is a full snapshot.
///
/// ```
/// use mcm::design::{Design, Specification};
/// use mcm::equilibrium::{self, Inputs, Interaction, Solution};
/// use mcm::methods::{Comparison, Method, Settings};
/// let design = Design::new(Specification::paper(1))?;
/// let model = equilibrium::Settings { interaction: Interaction::None, ..Default::default() };
/// let settings = Settings { method: Method::ShootingExact, ..Settings::default() };
/// let mut shooting = Comparison::new(&design, None, model, settings, 11)?;
/// let mut inputs = Inputs::unloaded(2);
/// inputs.uniform_field.y = 0.02;
/// assert!(shooting.solve(&inputs)?.solved());
/// let angle = shooting.tip().axis().angle(&nalgebra::Vector3::z());
/// assert!((angle.to_degrees() - 30.50).abs() < 0.01);
/// # Ok::<(), mcm::error::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Comparison {
    line: Arc<Line>,
    model: equilibrium::Settings,
    settings: Settings,
    sources: Sources,
    arc_lengths: Arc<Vec<f64>>,
    rules: PairQuadrature,
    state: SolvedState,
}

/// The part of the state that a solve changes.
#[derive(Debug, Clone)]
struct SolvedState {
    engine: Engine,
    inputs: Option<Inputs>,
    shape: Shape,
    /// Wrenches of the external loads, and that of the clamp.
    wrenches: TermWrenches,
    clamp: Wrench,
}

impl Comparison {
    /// Creates the straight manipulator; `shape_points` is the number of centreline points, at least 2.
    ///
    /// Model settings that concern the potential method alone (strain modes, branch following) are ignored.
    ///
    /// # Errors
    /// [`Error::Range`] for settings or a number of points out of range, [`Error::Unsupported`] for a method that cannot
    /// solve the model asked for.
    pub fn new(
        design: &Design,
        sources: impl Into<Sources>,
        model: equilibrium::Settings,
        settings: Settings,
        shape_points: usize,
    ) -> Result<Self, Error> {
        let (model, settings) = (model.checked()?, settings.checked()?);
        let arc_lengths = arc_lengths(design.length(), shape_points)?;
        let (own, other) = (settings.method.name(), Method::Potential.name());

        if design.guidewire().is_some() {
            let reason = format!("method \"{own}\" has no guidewire: choose method \"{other}\"");
            return Err(Error::Unsupported(reason));
        }
        if !settings.method.supports(model.interaction) {
            let level = model.interaction.name();
            let [none, rings] = [Interaction::None, Interaction::Rings].map(Interaction::name);
            return Err(Error::Unsupported(format!(
                "method \"{own}\" has no interaction \"{level}\": choose \"{none}\" or \"{rings}\", or method \"{other}\""
            )));
        }

        let line = Line::new(design, &model)?;
        let state = SolvedState::straight(&line, &settings)?;
        Ok(Self {
            rules: PairQuadrature::new(&line.chain, &model),
            sources: sources.into(),
            arc_lengths: Arc::new(arc_lengths.collect()),
            line: Arc::new(line),
            model,
            settings,
            state,
        })
    }

    /// Resets to the straight shape at the origin; the last solution is discarded.
    pub fn reset(&mut self) {
        if let Ok(state) = SolvedState::straight(&self.line, &self.settings) {
            self.state = state;
        }
    }

    /// The settings of the model.
    #[must_use]
    pub fn model(&self) -> &equilibrium::Settings {
        &self.model
    }

    /// The settings of the method.
    #[must_use]
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// Solves at `inputs`, from the last solution or the straight shape; stability is not computed.
    ///
    /// # Errors
    /// [`Error::Range`] or [`Error::Count`] for inputs that are not finite or not of the right length, [`Error::Unsupported`]
    /// for inputs that do not lie in a plane, if the method requires that. The last solution is kept then, as it is when a
    /// solve fails, which is not an error: see [`Report::solved`].
    pub fn solve(&mut self, inputs: &Inputs) -> Result<Report, Error> {
        inputs.check(self.line.chain.rings.len())?;
        inputs.check_sources(&self.sources, self.state.inputs.as_ref())?;
        if self.settings.method == Method::Planar {
            Plane::of(inputs, &self.sources)?;
        }

        let before = self.state.clone();
        let start = self.state.inputs.clone().unwrap_or_else(|| inputs.without_loads());
        let smallest = self.settings.smallest_part;
        let mut report = Report::start();
        let (mut done, mut part) = (0.0, 1.0);

        // Loads come in parts: halved where a part fails, doubled after each success.
        while done < 1.0 && part >= smallest {
            let next = f64::min(1.0, done + part);
            let target = if next >= 1.0 { inputs.clone() } else { start.between(inputs, next) };
            if self.attempt(&target, &mut report) {
                (done, part) = (next, 2.0 * part);
            } else {
                part *= 0.5;
            }
        }

        let answers = if done >= 1.0 { self.answers(inputs) } else { None };
        let contact = self.contact(inputs);
        let (Some((energy, wrenches, clamp)), None) = (answers, contact) else {
            self.state = before;
            (report.outcome, report.progress) = (contact.map_or(report.outcome, Outcome::Contact), done);
            return Ok(report);
        };

        self.state.inputs = Some(inputs.clone());
        (self.state.wrenches, self.state.clamp) = (wrenches, clamp);
        (report.outcome, report.progress, report.energy) = (Outcome::Solved, 1.0, energy);
        Ok(report)
    }

    /// The deepest contact of the present shape.
    fn contact(&self, inputs: &Inputs) -> Option<Contact> {
        let (chain, shape) = (&self.line.chain, &self.state.shape);
        let placed = Placed { chain, nodes: &shape.nodes };
        let mut start = 0.0;
        let mut starts = Vec::with_capacity(chain.elements.len());
        for element in &chain.elements {
            starts.push(start + element.offset);
            start += element.offset + element.length;
        }
        placed.contact(&self.model, &self.sources, inputs, |k, s| shape.trace.pose(starts[k] + s))
    }

    /// One solve without subdivision of the input change; whether it succeeded.
    fn attempt(&mut self, inputs: &Inputs, report: &mut Report) -> bool {
        let settings = self.settings;
        let mut state = self.state.clone();
        self.rules.choose(&self.line.chain, &state.shape.nodes);
        for _ in 0..=RULE_CHOICES {
            let around = self.around(inputs);
            let end = state.engine.solve(&around, &settings);
            report.iterations += end.iterations;
            report.residual = end.residual;
            if !end.converged {
                return false;
            }
            let Some(shape) = state.engine.shape(&around, &settings) else { return false };
            state.shape = shape;
            // The quadrature must be that of the solved shape, or the result would depend on the path to it.
            if !self.rules.choose(&self.line.chain, &state.shape.nodes) {
                break;
            }
        }
        self.state = state;
        true
    }

    fn around<'a>(&'a self, inputs: &'a Inputs) -> Surroundings<'a> {
        Surroundings {
            line: &self.line,
            inputs,
            sources: &self.sources,
            terms: Terms::new(&self.line.chain, &self.model, &self.sources, inputs, &self.rules),
        }
    }

    /// Energy (J) of a shape, the wrenches of the external loads and that of the clamp.
    fn answers(&self, inputs: &Inputs) -> Option<(f64, TermWrenches, Wrench)> {
        let around = self.around(inputs);
        let shape = &self.state.shape;
        let Totals { mut wrenches, mut energy } = shape.trace.totals(&around)?;
        let (loads, totals) = around.nodes(&shape.nodes, Order::Gradient)?;
        energy += loads.iter().map(|load| load.energy).sum::<f64>();
        wrenches.add(&around.node_wrenches(&shape.nodes)?, 1.0);
        Some((energy, wrenches, wrench(&(totals[0] - shape.base))))
    }
}

impl Solution for Comparison {
    fn tip(&self) -> Pose {
        let nodes = &self.state.shape.nodes;
        nodes[nodes.len() - 1].advanced(self.line.chain.tip_offset)
    }

    fn rings(&self) -> impl Iterator<Item = Pose> + '_ {
        let nodes = &self.state.shape.nodes;
        self.line.chain.rings.iter().map(|body| body.centre(&nodes[body.node]))
    }

    fn core_angles(&self) -> impl Iterator<Item = f64> + '_ {
        self.state.shape.trace.core_angles(&self.line).into_iter()
    }

    fn shape(&self) -> impl Iterator<Item = (f64, Vector3<f64>)> + '_ {
        self.arc_lengths.iter().map(|s| (*s, self.state.shape.trace.pose(*s).position))
    }

    fn shape_strains(&self) -> impl Iterator<Item = (Matrix3<f64>, Vector3<f64>)> + '_ {
        self.arc_lengths.iter().map(|s| self.state.shape.trace.strain(*s))
    }

    fn base_reaction(&self) -> Wrench {
        self.state.clamp
    }

    fn magnetic_wrench(&self) -> Wrench {
        self.state.wrenches.magnetic()
    }

    fn sources(&self) -> &Sources {
        &self.sources
    }

    fn source_reaction(&self, number: usize, inputs: &Inputs) -> Wrench {
        self.state.wrenches.on_source(number, inputs)
    }

    fn field_at(&self, inputs: &Inputs, point: &Vector3<f64>) -> Option<Vector3<f64>> {
        self.around(inputs).terms.field_at(point)
    }
}

impl SolvedState {
    fn straight(line: &Line, settings: &Settings) -> Result<Self, Error> {
        let engine = Engine::new(line, settings).ok_or_else(|| {
            Error::Unsupported("the potential method is not one of the other methods".into())
        })?;
        let (trace, nodes) = Trace::straight(line);
        Ok(Self {
            engine,
            inputs: None,
            shape: Shape { nodes, base: Vector6::zeros(), trace },
            wrenches: TermWrenches::none(),
            clamp: Wrench::NONE,
        })
    }
}

/// Force and torque of a column.
fn wrench(column: &Vector6<f64>) -> Wrench {
    Wrench { force: column.fixed_rows::<3>(0).into_owned(), torque: column.fixed_rows::<3>(3).into_owned() }
}

//! The manipulator: a design, an external magnet and the last solved shape.

use serde::{Deserialize, Serialize};

use super::hierarchy::{self, Hierarchy};
use super::measured_margin::MeasuredMargin;
use super::outputs::Resolution;
use super::tolerance::TipTolerance;
use super::way::Way;
use super::{Inputs, Jacobian, Outputs, Status};
use crate::design::Design;
use crate::equilibrium::{Equilibrium, Report, Settings, Solution};
use crate::error::Error;
use crate::magnetics::Sources;
use crate::vessel::Vessel;

/// A manipulator solved by the potential method; it keeps its shape from one solve to the next.
///
/// A clone is a full snapshot: it gives bit for bit the same answers as the original.
///
/// ```
/// use mcm::design::{Design, Specification};
/// use mcm::equilibrium::Settings;
/// use mcm::manipulator::{Inputs, Manipulator, Status};
/// let design = Design::new(Specification::paper(1))?;
/// let mut manipulator = Manipulator::new(&design, None, Settings::default(), 11)?;
/// let mut inputs = Inputs::unloaded(2);
/// inputs.uniform_field.y = 0.02;
/// let outputs = manipulator.solve(&inputs)?;
/// assert_eq!(outputs.status, Status::Solved);
/// assert!((outputs.tip_angle.to_degrees() - 34.78).abs() < 0.01);
/// inputs.uniform_field.y = f64::NAN;
/// assert!(manipulator.solve(&inputs).is_err());
/// # Ok::<(), mcm::error::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Manipulator {
    pub(super) hierarchy: Hierarchy,
    measured: Option<MeasuredMargin>,
    pub(super) outputs: Outputs,
    /// Whether the outputs belong to a solved shape.
    has_shape: bool,
    /// What is solved before the first inputs.
    way: Way,
}

/// Serializable state of a manipulator.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Snapshot {
    models: hierarchy::HierarchySnapshot,
    outputs: Outputs,
    has_shape: bool,
}

impl Manipulator {
    /// Creates an unsolved manipulator of `design` near these field sources (`None`: no external magnet).
    ///
    /// `shape_points` is the number of centreline points in the outputs, at least 2.
    ///
    /// # Errors
    /// [`Error`] for settings out of range.
    pub fn new(
        design: &Design,
        sources: impl Into<Sources>,
        settings: Settings,
        shape_points: usize,
    ) -> Result<Self, Error> {
        let hierarchy = Hierarchy::new(design, sources.into(), settings, shape_points)?;
        let outputs = Outputs::straight(hierarchy.present(), resolution(&hierarchy));
        Ok(Self { hierarchy, measured: None, outputs, has_shape: false, way: Way::default() })
    }

    /// This manipulator, unsolved, in a vessel.
    #[must_use]
    pub fn in_vessel(mut self, vessel: &Vessel) -> Self {
        self.hierarchy = self.hierarchy.in_vessel(vessel);
        self.reset();
        self
    }

    /// This manipulator, unsolved, which comes to its first inputs on a way, also after a reset.
    #[must_use]
    pub fn on_way(mut self, way: Way) -> Self {
        self.way = way;
        self.reset();
        self
    }

    /// Follows the equilibrium branch from the last inputs to `inputs`; the first call starts from the unloaded shape, and comes to
    /// `inputs` on the manipulator's way, if it has one. Jumps to another branch on that way are not counted.
    ///
    /// A failed solve is not an error: it reports [`Status::NotSolved`] and keeps the last good outputs.
    ///
    /// # Errors
    /// [`Error::Range`] or [`Error::Count`] for inputs that are not finite or not of the right length; the
    /// state is then untouched.
    pub fn solve(&mut self, inputs: &Inputs) -> Result<&Outputs, Error> {
        if !self.has_shape && !self.way.is_empty() {
            let came = self.come(inputs);
            if !matches!(came, Ok(true)) {
                self.hierarchy.reset();
                self.has_shape = false;
                return came.map(|_| &self.outputs);
            }
        }
        self.solve_next(inputs)
    }

    /// Comes along the way that leads to these inputs; whether all of it is solved.
    fn come(&mut self, inputs: &Inputs) -> Result<bool, Error> {
        let points = self.way.points(inputs)?;
        for (number, point) in points.iter().enumerate() {
            let outputs = self.solve_next(point)?;
            if outputs.status == Status::NotSolved {
                let progress = outputs.progress;
                self.outputs.progress = (number as f64 + progress) / (points.len() + 1) as f64;
                return Ok(false);
            }
        }
        self.outputs.snaps = 0;
        Ok(true)
    }

    fn solve_next(&mut self, inputs: &Inputs) -> Result<&Outputs, Error> {
        let report = match inputs.feed_force {
            Some(push) => self.hierarchy.solve_pushed(inputs, push)?,
            None => self.hierarchy.solve(inputs)?,
        };
        if report.solved() {
            self.has_shape = true;
            let model = self.hierarchy.present();
            self.outputs.read(model, model.inputs().unwrap_or(inputs), resolution(&self.hierarchy));
        } else if !self.has_shape {
            self.outputs.interaction = self.hierarchy.present().settings().interaction;
        }
        self.outputs.record(&report, self.hierarchy.fold_margin());
        Ok(&self.outputs)
    }

    /// The outputs of the last solve; before the first solve, those of the straight unloaded shape at the origin.
    #[must_use]
    pub fn outputs(&self) -> &Outputs {
        &self.outputs
    }

    /// Whether a solve has succeeded since creation or reset; until then the outputs are not a solution.
    #[must_use]
    pub fn has_shape(&self) -> bool {
        self.has_shape
    }

    /// Follows the equilibrium branch along the points of `path`, reported as one solve.
    ///
    /// The status is [`Status::Snapped`] if the count of jumps ends above `snaps`. If a point is not solved, the branch and all
    /// outputs except how the solve ended are restored to those before the path; all points count equally in
    /// [`Outputs::progress`].
    ///
    /// # Errors
    /// As [`Manipulator::solve`].
    pub fn follow(&mut self, path: &[Inputs], snaps: u32) -> Result<&Outputs, Error> {
        let before = (path.len() > 1).then(|| self.clone());
        let mut iterations = 0;
        for (number, inputs) in path.iter().enumerate() {
            let solved = self.solve(inputs).map(|out| (out.status, out.residual, out.outcome, out.progress));
            iterations += self.outputs.iterations;
            if let Ok((Status::Solved | Status::NearFold | Status::Snapped, ..)) = solved {
                continue;
            }
            if let Some(before) = before {
                *self = before;
            }
            let (status, residual, outcome, progress) = solved?;
            (self.outputs.status, self.outputs.residual) = (status, residual);
            self.outputs.outcome = outcome;
            self.outputs.progress = (number as f64 + progress) / path.len() as f64;
            break;
        }
        self.outputs.iterations = iterations;
        if self.outputs.status != Status::NotSolved && self.outputs.snaps > snaps {
            self.outputs.status = Status::Snapped;
        }
        Ok(&self.outputs)
    }

    /// Solves for each of `inputs` on all cores (rayon's), every time from this manipulator's present state: from the unloaded
    /// shape if nothing is solved yet, otherwise along the branch from the last shape.
    ///
    /// The answers are those of one clone after the other, bit for bit, in the order of `inputs`; this manipulator stays as it
    /// is.
    ///
    /// ```
    /// use mcm::manipulator::Scene;
    /// let scene = Scene::parse("[design]\nsegments = 1\n[field]", "example")?;
    /// let mut fields = vec![scene.inputs.clone(); 8];
    /// (0..8).for_each(|number| fields[number].uniform_field.y = 1e-3 * number as f64);
    /// let answers = scene.manipulator(2)?.solve_many(&fields)?;
    /// assert!(answers.windows(2).all(|pair| pair[0].tip_angle < pair[1].tip_angle));
    /// # Ok::<(), mcm::error::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`Manipulator::solve`], for the first of `inputs` that is refused; none is then solved.
    #[cfg(feature = "parallel")]
    pub fn solve_many(&self, inputs: &[Inputs]) -> Result<Vec<Outputs>, Error> {
        use rayon::prelude::*;
        for each in inputs {
            each.check(self.outputs.rings.len())?;
        }
        inputs.par_iter().map(|inputs| self.clone().solve(inputs).cloned()).collect()
    }

    /// The state, from which another manipulator of the same design continues with bit-identical results.
    #[must_use]
    pub fn snapshot(&self) -> Snapshot {
        let (models, outputs) = (self.hierarchy.snapshot(), self.outputs.clone());
        Snapshot { models, outputs, has_shape: self.has_shape }
    }

    /// Restores the state of another manipulator of the same design, magnet, vessel and settings.
    ///
    /// # Errors
    /// [`Error::Unsupported`] for a snapshot that is not of this design and vessel; the manipulator is then reset.
    pub fn restore(&mut self, snapshot: &Snapshot) -> Result<(), Error> {
        self.reset();
        let lengths = |out: &Outputs| {
            [out.rings.len(), out.core_angles.len(), out.shape.len(), out.shape_arc_length.len()]
        };
        if lengths(&snapshot.outputs) != lengths(&self.outputs) {
            return Err(Error::Unsupported("the snapshot is not of this design".into()));
        }
        self.hierarchy.restore(&snapshot.models)?;
        (self.outputs, self.has_shape) = (snapshot.outputs.clone(), snapshot.has_shape);
        Ok(())
    }

    /// Computes the stability margin of the last solved shape and stores it in the outputs.
    ///
    /// A solve alone gives an upper bound. The next solve is not affected, and a shape that has not changed is not measured again.
    pub fn measure_margin(&mut self) -> &Outputs {
        let model = self.hierarchy.present();
        self.measured =
            self.measured.take().filter(|last| last.is_of(model)).or_else(|| MeasuredMargin::of(model));
        if let Some(measured) = &self.measured {
            self.outputs.stability_margin = measured.value;
        }
        &self.outputs
    }

    /// Computes the wrench of the magnets and coils on one another at the last solved inputs and stores it in the outputs, unless it
    /// is there already.
    ///
    /// ```
    /// use mcm::manipulator::Scene;
    /// let scene = Scene::parse("[[magnet]]\n[[magnet]]\nposition_mm = [0.0, 150.0, 23.0]", "example")?;
    /// let mut manipulator = scene.manipulator(2)?;
    /// manipulator.solve(&scene.inputs)?;
    /// let [first, second] = manipulator.measure_mutual_wrenches()?.mutual_wrenches[..] else { panic!() };
    /// assert!((first.force + second.force).norm() < 1e-12 && first.force.norm() > 0.01);
    /// # Ok::<(), mcm::error::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`Sources::mutual_wrenches`]: sources that almost touch.
    pub fn measure_mutual_wrenches(&mut self) -> Result<&Outputs, Error> {
        let model = self.hierarchy.present();
        if let Some(inputs) = model.inputs().filter(|_| self.outputs.mutual_wrenches.is_empty()) {
            self.outputs.mutual_wrenches = inputs.mutual_wrenches(model.sources())?;
        }
        Ok(&self.outputs)
    }

    /// Derivatives of all outputs with respect to all inputs at the last solved shape; see [`Jacobian`].
    ///
    /// The state is not changed, and neither is the next solve. Example: the actuation Jacobian of a magnet held by a robot
    /// arm, tip twist with respect to magnet twist:
    ///
    /// ```
    /// use mcm::manipulator::Scene;
    /// let scene = Scene::parse("[design]\nsegments = 3\n[magnet]", "example")?;
    /// let mut manipulator = scene.manipulator(11)?;
    /// assert!(manipulator.jacobian().is_err()); // nothing is solved yet
    /// manipulator.solve(&scene.inputs)?;
    /// let jacobian = manipulator.jacobian()?.tip_by_source(0).expect("the magnet");
    /// // The magnet comes nearer by 1 mm, along y: the tip moves towards it or away, and turns about x.
    /// let tip = jacobian.column(1) * 1e-3;
    /// assert!(tip[1].abs() > 1e-6 && tip[3].abs() > 1e-4);
    /// # Ok::<(), mcm::error::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::NoDerivatives`] when the last solve failed, before the first, at a fold, and where a part lies
    /// inside the external magnet; see [`crate::equilibrium::Equilibrium::jacobian`].
    pub fn jacobian(&self) -> Result<Jacobian, Error> {
        if self.outputs.status == Status::NotSolved {
            return Err(Error::NoDerivatives("the last inputs are not solved".into()));
        }
        let equilibrium = self.hierarchy.present();
        let jacobian = equilibrium.jacobian()?;
        let pushed = equilibrium.inputs().is_some_and(|inputs| inputs.feed_force.is_some());
        Ok(if pushed { jacobian.at_given_push() } else { jacobian })
    }

    /// The model of the last shape.
    pub(super) fn model(&self) -> &Equilibrium {
        self.hierarchy.present()
    }

    /// This device with its present model replaced by another one of the same discretisation, and what was read from that.
    #[cfg(feature = "fit")]
    pub(super) fn with_model(&self, model: Equilibrium, outputs: Outputs) -> Self {
        let mut hierarchy = self.hierarchy.clone();
        hierarchy.replace_present(model);
        Self { hierarchy, measured: None, outputs, has_shape: true, way: self.way.clone() }
    }

    /// What is read from the shape of another model of the same discretisation.
    pub(super) fn outputs_of(&self, model: &Equilibrium, inputs: &Inputs) -> Outputs {
        let mut out = self.outputs.clone();
        out.read(model, inputs, resolution(&self.hierarchy));
        if self.outputs.has_strains() {
            out.read_strains(model);
        }
        out
    }

    /// Outputs of a model after a solve of it.
    pub(super) fn outputs_of_solve(&self, model: &Equilibrium, inputs: &Inputs, report: &Report) -> Outputs {
        let mut out = self.outputs_of(model, inputs);
        out.record(report, self.hierarchy.fold_margin());
        out
    }

    /// Sets the tolerances of the tip relative to the converged model, from the next solve on.
    ///
    /// # Errors
    /// As [`TipTolerance::checked`].
    pub fn set_tolerance(&mut self, tolerance: TipTolerance) -> Result<(), Error> {
        self.hierarchy.set_tolerance(tolerance.checked()?);
        Ok(())
    }

    /// Sets the coefficient of Coulomb friction between the device and the wall of its vessel, from the next solve on; without
    /// effect where there is none.
    ///
    /// # Errors
    /// [`Error::Range`] unless it is from 0 to 10.
    pub fn set_friction(&mut self, coefficient: f64) -> Result<(), Error> {
        self.measured = None;
        self.hierarchy.set_friction(coefficient)
    }

    /// Processor time that a solve may take, s.
    #[must_use]
    pub fn time_budget(&self) -> f64 {
        self.hierarchy.time_budget()
    }

    /// Sets the processor time that a solve may take, s, from the next solve on; nothing is left for a search with 0.
    pub fn set_time_budget(&mut self, seconds: f64) {
        self.hierarchy.set_time_budget(seconds);
    }

    /// Forgets the shape but not the count of snaps: the next solve starts from the unloaded shape.
    pub fn start_anew(&mut self) {
        let snaps = self.outputs.snaps;
        self.reset();
        self.outputs.snaps = snaps;
    }

    /// Resets the shape and the count of snaps.
    pub fn reset(&mut self) {
        self.hierarchy.reset();
        self.measured = None;
        self.outputs = Outputs::straight(self.hierarchy.present(), resolution(&self.hierarchy));
        self.has_shape = false;
    }
}

/// Interaction level, degree and error estimate of the model in use.
fn resolution(hierarchy: &Hierarchy) -> Resolution {
    let settings = hierarchy.present().settings();
    Resolution {
        interaction: settings.interaction,
        degree: settings.degree,
        error_estimate: hierarchy.error_estimate(),
        beyond_tolerance: hierarchy.is_beyond_tolerance(),
    }
}

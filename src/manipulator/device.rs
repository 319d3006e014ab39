//! The manipulator: a design, an external magnet, and the last shape.

use serde::{Deserialize, Serialize};

use super::hierarchy::{self, Hierarchy};
use super::outputs::Resolution;
use super::{Inputs, Jacobian, Outputs, Status};
use crate::design::Design;
use crate::equilibrium::{Settings, TipDeviation};
use crate::error::Error;
use crate::magnetics::Assembly;
use crate::methods::Method;

/// A manipulator that remembers its shape from one solve to the next.
///
/// A clone is a full snapshot: it answers bit for bit as the original would.
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
    hierarchy: Hierarchy,
    outputs: Outputs,
    /// Whether the outputs are those of a shape that was found.
    has_shape: bool,
}

/// What a manipulator remembers of its past, in numbers.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Snapshot {
    models: hierarchy::HierarchySnapshot,
    outputs: Outputs,
    has_shape: bool,
}

impl Manipulator {
    /// A manipulator of `design` near `magnet` (`None`: no external magnet), unsolved.
    ///
    /// `shape_points` is the number of centreline points in the outputs, at least 2.
    ///
    /// # Errors
    /// [`Error`] for settings out of range.
    pub fn new(
        design: &Design,
        magnet: Option<&Assembly>,
        settings: Settings,
        shape_points: usize,
    ) -> Result<Self, Error> {
        let hierarchy = Hierarchy::new(design, magnet, settings, shape_points)?;
        let outputs = Outputs::straight(hierarchy.present(), resolution(&hierarchy));
        Ok(Self { hierarchy, outputs, has_shape: false })
    }

    /// Follows the equilibrium from the last inputs to `inputs` (the first time: from the unloaded shape).
    ///
    /// A solve that fails is no error: it says [`Status::NotSolved`] and keeps the last good outputs.
    ///
    /// # Errors
    /// [`Error::Range`] or [`Error::Count`] for inputs that are not finite or not of the right length; the
    /// state is then untouched.
    pub fn solve(&mut self, inputs: &Inputs) -> Result<&Outputs, Error> {
        let report = self.hierarchy.solve(inputs)?;
        if report.solved() {
            self.has_shape = true;
            self.outputs.read(self.hierarchy.present(), inputs, resolution(&self.hierarchy));
        }
        self.outputs.record(&report, self.hierarchy.fold_margin());
        Ok(&self.outputs)
    }

    /// The outputs of the last solve; before the first, those of the straight unloaded shape at the origin.
    #[must_use]
    pub fn outputs(&self) -> &Outputs {
        &self.outputs
    }

    /// Whether any solve has succeeded since it was made or reset: before, the outputs are no answer.
    #[must_use]
    pub fn has_shape(&self) -> bool {
        self.has_shape
    }

    /// Follows the equilibrium along `path`, one point after the other; what happens on the way counts as one solve.
    ///
    /// It has snapped if there were more jumps than `snaps` in the end. If a point is not solved, the branch and all
    /// outputs but how it ended are those from before the path; in [`Outputs::progress`] all points count equally.
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

    /// What it remembers: from it another manipulator of the same design goes on bit for bit.
    #[must_use]
    pub fn snapshot(&self) -> Snapshot {
        let (models, outputs) = (self.hierarchy.snapshot(), self.outputs.clone());
        Snapshot { models, outputs, has_shape: self.has_shape }
    }

    /// Remembers what another manipulator of the same design, magnet and settings did.
    ///
    /// # Errors
    /// [`Error::Unsupported`] for a snapshot that is not of this design; the manipulator is then reset.
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

    /// Measures the stability margin of the last solved shape, which a solve alone bounds from above, and puts
    /// it into the outputs. The next solve is the same with and without.
    pub fn measure_margin(&mut self) -> &Outputs {
        if let Some(margin) = self.hierarchy.present().margin() {
            self.outputs.stability_margin = margin;
        }
        &self.outputs
    }

    /// Derivatives of all outputs by all inputs at the last solved shape; see [`Jacobian`].
    ///
    /// Nothing changes: the next solve is the one that would have been. The actuation Jacobian of a magnet that a
    /// robot arm holds, tip twist by magnet twist:
    ///
    /// ```
    /// use mcm::manipulator::Scene;
    /// let scene = Scene::parse("[design]\nsegments = 3\n[magnet]", "example")?;
    /// let mut manipulator = scene.manipulator(11)?;
    /// assert!(manipulator.jacobian().is_err()); // nothing is solved yet
    /// manipulator.solve(&scene.inputs)?;
    /// let jacobian = manipulator.jacobian()?.tip_by_magnet();
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
        self.hierarchy.present().jacobian()
    }

    /// How far the tip may be, and be turned, from the converged answer of the model, m and rad; from the next solve on.
    ///
    /// # Errors
    /// [`Error::Range`] unless both are positive.
    pub fn set_tolerances(&mut self, position: f64, angle: f64) -> Result<(), Error> {
        let settings =
            Settings { tolerance_position: position, tolerance_angle: angle, ..Settings::default() };
        settings.checked()?;
        self.hierarchy.set_tolerance(TipDeviation { distance: position, angle });
        Ok(())
    }

    /// Forgets the shape and the count of snaps.
    pub fn reset(&mut self) {
        self.hierarchy.reset();
        self.outputs = Outputs::straight(self.hierarchy.present(), resolution(&self.hierarchy));
        self.has_shape = false;
    }
}

/// How much model answers.
fn resolution(hierarchy: &Hierarchy) -> Resolution {
    let settings = hierarchy.present().settings();
    Resolution {
        interaction: settings.interaction,
        degree: settings.degree,
        method: Method::Potential,
        error_estimate: hierarchy.error_estimate(),
    }
}

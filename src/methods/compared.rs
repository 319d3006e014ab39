//! A manipulator solved by a comparison method instead of the potential method.

use super::{Comparison, Settings};
use crate::design::Design;
use crate::equilibrium;
use crate::error::Error;
use crate::magnetics::Sources;
use crate::manipulator::{Followed, Inputs, Outputs, Resolution, Snapshot};

/// A manipulator solved by a comparison method; it keeps its shape from one solve to the next.
///
/// It provides no stability margin, error estimate, derivatives or snapshots.
#[derive(Debug, Clone)]
pub struct Compared {
    comparison: Comparison,
    outputs: Outputs,
}

impl Compared {
    /// Creates an unsolved manipulator of `design` near these field sources (`None`: no external magnet).
    ///
    /// # Errors
    /// As [`Comparison::new`].
    pub fn new(
        design: &Design,
        sources: impl Into<Sources>,
        model: equilibrium::Settings,
        settings: Settings,
        shape_points: usize,
    ) -> Result<Self, Error> {
        let comparison = Comparison::new(design, sources, model, settings, shape_points)?;
        let outputs = Outputs::straight(&comparison, resolution(&comparison));
        Ok(Self { comparison, outputs })
    }

    /// The settings of the method.
    #[must_use]
    pub fn settings(&self) -> &Settings {
        self.comparison.settings()
    }

    /// Resets the shape and the count of snaps.
    pub fn reset(&mut self) {
        self.comparison.reset();
        self.outputs = Outputs::straight(&self.comparison, resolution(&self.comparison));
    }

    /// Computes tangents and curvatures of the shape.
    pub fn measure_strains(&mut self) -> &Outputs {
        self.outputs.read_strains(&self.comparison);
        &self.outputs
    }
}

impl Followed for Compared {
    fn solve(&mut self, inputs: &Inputs) -> Result<&Outputs, Error> {
        let report = self.comparison.solve(inputs)?;
        if report.solved() {
            self.outputs.read(&self.comparison, inputs, resolution(&self.comparison));
        }
        self.outputs.record(&report, self.comparison.model().fold_margin);
        Ok(&self.outputs)
    }

    fn outputs(&self) -> &Outputs {
        &self.outputs
    }

    fn start_anew(&mut self) {
        let snaps = self.outputs.snaps;
        self.reset();
        self.outputs.snaps = snaps;
    }

    fn time_budget(&self) -> f64 {
        f64::INFINITY
    }

    fn set_time_budget(&mut self, _: f64) {}

    fn measure_margin(&mut self) -> &Outputs {
        &self.outputs
    }

    fn snapshot(&self) -> Option<Snapshot> {
        None
    }

    fn restore(&mut self, _: &Snapshot) -> Result<(), Error> {
        Err(Error::Unsupported("this method has no snapshots".into()))
    }
}

/// Interaction level and degree of the model; the method estimates no error.
fn resolution(comparison: &Comparison) -> Resolution {
    let model = comparison.model();
    Resolution {
        interaction: model.interaction,
        degree: model.degree,
        error_estimate: 0.0,
        beyond_tolerance: false,
    }
}

//! A manipulator solved by a comparison method instead of the potential method.

use super::outputs::{Outputs, Resolution};
use super::solve::Solve;
use super::{Inputs, Jacobian};
use crate::design::Design;
use crate::equilibrium::Settings;
use crate::error::Error;
use crate::magnetics::Sources;
use crate::methods::{self, Comparison, Method};

/// A manipulator solved by a comparison method; it keeps its shape from one solve to the next.
///
/// It provides no stability margin, error estimate or derivatives.
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
        model: Settings,
        settings: methods::Settings,
        shape_points: usize,
    ) -> Result<Self, Error> {
        let comparison = Comparison::new(design, sources, model, settings, shape_points)?;
        let outputs = Outputs::straight(&comparison, Self::resolution(&comparison));
        Ok(Self { comparison, outputs })
    }

    fn resolution(comparison: &Comparison) -> Resolution {
        let model = comparison.model();
        Resolution {
            interaction: model.interaction,
            degree: model.degree,
            method: comparison.settings().method,
            error_estimate: 0.0,
            beyond_tolerance: false,
        }
    }
}

impl Solve for Compared {
    fn solve(&mut self, inputs: &Inputs) -> Result<&Outputs, Error> {
        let report = self.comparison.solve(inputs)?;
        if report.solved() {
            self.outputs.read(&self.comparison, inputs, Self::resolution(&self.comparison));
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

    fn reset(&mut self) {
        self.comparison.reset();
        self.outputs = Outputs::straight(&self.comparison, Self::resolution(&self.comparison));
    }

    fn measure_margin(&mut self) -> &Outputs {
        &self.outputs
    }

    fn measure_strains(&mut self) -> &Outputs {
        self.outputs.read_strains(&self.comparison);
        &self.outputs
    }

    fn jacobian(&self) -> Result<Jacobian, Error> {
        let (own, other) = (self.comparison.settings().method.name(), Method::Potential.name());
        Err(Error::NoDerivatives(format!("method \"{own}\" has no derivatives: choose \"{other}\"")))
    }

    fn duplicate(&self) -> Box<dyn Solve> {
        Box::new(self.clone())
    }
}

impl From<Compared> for Box<dyn Solve> {
    fn from(compared: Compared) -> Self {
        Box::new(compared)
    }
}

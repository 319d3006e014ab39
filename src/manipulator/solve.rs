//! Interface that the potential method and the comparison methods have in common.

use std::fmt;

use super::{Inputs, Jacobian, Manipulator, Outputs, Snapshot};
use crate::error::Error;

/// A manipulator solved by any method; see [`super::Scene::device`].
pub trait Solve: fmt::Debug {
    /// As [`Manipulator::solve`].
    ///
    /// # Errors
    /// As [`Manipulator::solve`].
    fn solve(&mut self, inputs: &Inputs) -> Result<&Outputs, Error>;

    /// As [`Manipulator::outputs`].
    fn outputs(&self) -> &Outputs;

    /// Resets the shape and the count of snaps.
    fn reset(&mut self);

    /// Forgets the shape but not the count of snaps: the next solve starts from the unloaded shape.
    fn start_anew(&mut self);

    /// Processor time that a solve may take, s; without a limit for a method that has none.
    fn time_budget(&self) -> f64 {
        f64::INFINITY
    }

    /// Sets the processor time that a solve may take, s; without effect for a method that has no limit.
    fn set_time_budget(&mut self, _: f64) {}

    /// As [`Manipulator::measure_margin`]; methods without a stability margin leave the outputs unchanged.
    fn measure_margin(&mut self) -> &Outputs;

    /// As [`Manipulator::measure_strains`].
    fn measure_strains(&mut self) -> &Outputs;

    /// As [`Manipulator::jacobian`].
    ///
    /// # Errors
    /// As [`Manipulator::jacobian`]; [`Error::NoDerivatives`] for any other method.
    fn jacobian(&self) -> Result<Jacobian, Error>;

    /// As [`Manipulator::snapshot`]; `None` for any other method.
    fn snapshot(&self) -> Option<Snapshot> {
        None
    }

    /// As [`Manipulator::restore`].
    ///
    /// # Errors
    /// As [`Manipulator::restore`]; [`Error::Unsupported`] for any other method.
    fn restore(&mut self, _: &Snapshot) -> Result<(), Error> {
        Err(Error::Unsupported("this method has no snapshots".into()))
    }

    /// The manipulator itself, which alone has sensitivities; `None` for any other method.
    fn manipulator(&self) -> Option<&Manipulator> {
        None
    }

    /// A full copy, which gives bit for bit the same answers as the original.
    fn duplicate(&self) -> Box<dyn Solve>;
}

impl Solve for Manipulator {
    fn solve(&mut self, inputs: &Inputs) -> Result<&Outputs, Error> {
        Self::solve(self, inputs)
    }

    fn outputs(&self) -> &Outputs {
        Self::outputs(self)
    }

    fn reset(&mut self) {
        Self::reset(self);
    }

    fn start_anew(&mut self) {
        Self::start_anew(self);
    }

    fn time_budget(&self) -> f64 {
        Self::time_budget(self)
    }

    fn set_time_budget(&mut self, seconds: f64) {
        Self::set_time_budget(self, seconds);
    }

    fn measure_margin(&mut self) -> &Outputs {
        Self::measure_margin(self)
    }

    fn measure_strains(&mut self) -> &Outputs {
        Self::measure_strains(self)
    }

    fn jacobian(&self) -> Result<Jacobian, Error> {
        Self::jacobian(self)
    }

    fn snapshot(&self) -> Option<Snapshot> {
        Some(Self::snapshot(self))
    }

    fn restore(&mut self, snapshot: &Snapshot) -> Result<(), Error> {
        Self::restore(self, snapshot)
    }

    fn manipulator(&self) -> Option<&Manipulator> {
        Some(self)
    }

    fn duplicate(&self) -> Box<dyn Solve> {
        Box::new(self.clone())
    }
}

impl Clone for Box<dyn Solve> {
    fn clone(&self) -> Self {
        self.duplicate()
    }
}

impl From<Manipulator> for Box<dyn Solve> {
    fn from(manipulator: Manipulator) -> Self {
        Box::new(manipulator)
    }
}

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

    /// As [`Manipulator::measure_margin`]; methods without a stability margin leave the outputs unchanged.
    fn measure_margin(&mut self) -> &Outputs;

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

    fn measure_margin(&mut self) -> &Outputs {
        Self::measure_margin(self)
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

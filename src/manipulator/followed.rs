//! What a branch asks of the manipulator that it follows.

use super::{Inputs, Manipulator, Outputs, Snapshot};
use crate::error::Error;

/// A manipulator that [`super::Branch`] can follow; a clone gives bit for bit the same answers as the original.
pub trait Followed: Clone {
    /// Solves at `inputs`, from the last shape.
    ///
    /// # Errors
    /// As [`Manipulator::solve`].
    fn solve(&mut self, inputs: &Inputs) -> Result<&Outputs, Error>;

    /// Outputs of the last solve.
    fn outputs(&self) -> &Outputs;

    /// Forgets the shape but not the count of snaps: the next solve starts from the unloaded shape.
    fn start_anew(&mut self);

    /// Processor time that a solve may take, s; infinite where there is no limit.
    fn time_budget(&self) -> f64;

    /// Sets the processor time that a solve may take, s; without effect where there is no limit.
    fn set_time_budget(&mut self, seconds: f64);

    /// Computes the stability margin of the outputs; without effect for a method that has none.
    fn measure_margin(&mut self) -> &Outputs;

    /// The state, from which [`Followed::restore`] goes on; `None` for a method that has none.
    fn snapshot(&self) -> Option<Snapshot>;

    /// Goes on from the state of another manipulator of this design and model.
    ///
    /// # Errors
    /// As [`Manipulator::restore`]; [`Error::Unsupported`] for a method without snapshots.
    fn restore(&mut self, snapshot: &Snapshot) -> Result<(), Error>;
}

impl Followed for Manipulator {
    fn solve(&mut self, inputs: &Inputs) -> Result<&Outputs, Error> {
        Self::solve(self, inputs)
    }

    fn outputs(&self) -> &Outputs {
        Self::outputs(self)
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

    fn snapshot(&self) -> Option<Snapshot> {
        Some(Self::snapshot(self))
    }

    fn restore(&mut self, snapshot: &Snapshot) -> Result<(), Error> {
        Self::restore(self, snapshot)
    }
}

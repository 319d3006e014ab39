//! The manipulator: a design, an external magnet, and the last shape.

use super::{Inputs, Outputs};
use crate::design::Design;
use crate::equilibrium::Settings;
use crate::error::Error;
use crate::magnetics::Assembly;

/// A manipulator that remembers its shape from one solve to the next.
///
/// A clone is a full snapshot: it answers bit for bit as the original would.
#[derive(Debug, Clone)]
pub struct Manipulator {
    outputs: Outputs,
}

impl Manipulator {
    /// A manipulator of `design` near `magnet` (`None`: no external magnet), unsolved.
    ///
    /// `shape_points` is the number of centreline points in the outputs, at least 2.
    ///
    /// # Errors
    /// [`Error`] for settings out of range.
    pub fn new(
        _design: &Design,
        _magnet: Option<&Assembly>,
        _settings: Settings,
        _shape_points: usize,
    ) -> Result<Self, Error> {
        Err(Error::Unsupported("unfinished".into()))
    }

    /// Follows the equilibrium from the last inputs to `inputs` (the first time: from the unloaded shape).
    ///
    /// A solve that fails is no error: it says [`super::Status::NotSolved`] and keeps the last good outputs.
    ///
    /// # Errors
    /// [`Error::Range`] or [`Error::Count`] for inputs that are not finite or not of the right length; the state is then untouched.
    pub fn solve(&mut self, _inputs: &Inputs) -> Result<&Outputs, Error> {
        Err(Error::Unsupported("unfinished".into()))
    }

    /// The outputs of the last solve; before the first, those of the straight unloaded shape at the origin.
    #[must_use]
    pub fn outputs(&self) -> &Outputs {
        &self.outputs
    }

    /// Forgets the shape and the count of snaps.
    pub fn reset(&mut self) {}
}

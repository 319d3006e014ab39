//! The solid parts of a source.

use nalgebra::Vector3;

use crate::constants::VACUUM_PERMEABILITY;
use crate::magnetics::overlap::Outline;

/// A solid part of a source, in its frame: what others must not overlap, and what pictures and pages draw.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Part {
    /// Its shape, with the axes of the source's frame.
    pub outline: Outline,
    /// Its centre, m.
    pub centre: Vector3<f64>,
    /// Remanence of a magnet of this shape with the same dipole moment, T; of a coil at one ampere.
    pub remanence: Vector3<f64>,
}

impl Part {
    /// The winding of a coil about the frame's `z`, whose moment at one ampere is given, A m2.
    pub(super) fn winding(outline: Outline, moment: &Vector3<f64>) -> Self {
        let remanence = moment * VACUUM_PERMEABILITY / outline.volume();
        Self { outline, centre: Vector3::zeros(), remanence }
    }
}

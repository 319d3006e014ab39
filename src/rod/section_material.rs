//! Section material: that of a station, or of a section per length.

use super::moments::SectionMoments;
use crate::design::{Direction, Span};

/// Material with mass and magnetic moment at one arc length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SectionMaterial {
    /// Moments of the material.
    pub moments: SectionMoments,
    /// Magnetisation of the material, A/m.
    pub magnetisation: f64,
    /// Direction of the magnetisation, in the directors.
    pub direction: Direction,
    /// Density of the material, kg/m3.
    pub density: f64,
    /// Mass on the centreline (the backbone), kg.
    pub line_mass: f64,
}

impl SectionMaterial {
    /// Material of a length `weight` (m) of `span` with these moments, at arc length `s` (m) from its start.
    pub(super) fn new(span: &Span, s: f64, moments: SectionMoments, weight: f64) -> Self {
        Self {
            moments,
            magnetisation: span.magnetisation,
            direction: span.direction_at(s),
            density: span.density,
            line_mass: span.line_density * weight,
        }
    }

    /// Material per length of the section of `span` at arc length `s` (m) from its start.
    #[must_use]
    pub fn section(span: &Span, s: f64) -> Self {
        let mut moments = SectionMoments::zero();
        moments.add_section(span, s, 1.0);
        Self::new(span, s, moments, 1.0)
    }

    /// This material averaged around the centreline.
    #[must_use]
    pub fn axisymmetric(&self) -> Self {
        Self { moments: self.moments.axisymmetric(), ..*self }
    }
}

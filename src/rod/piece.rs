//! The pieces that an element is made of.

use crate::design::Span;

/// A span, or a part of one, inside an element.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Piece<'a> {
    /// The span.
    pub span: &'a Span,
    /// Arc length from the span's start at which the part begins, m; 0 where the span is the same all along.
    pub from: f64,
    /// Length of the part, m.
    pub length: f64,
    /// Whether it counts as bonded to the rigid body before the span, and to the one behind it: these do not act on it.
    pub bonded: [bool; 2],
}

impl<'a> Piece<'a> {
    /// The part of a span of this length (m) that begins at arc length `from` (m).
    #[must_use]
    pub fn part(span: &'a Span, from: f64, length: f64) -> Self {
        // Equal parts of a uniform span are equal, and share their tables.
        let from = if span.varies() { from } else { 0.0 };
        Self { span, from, length, bonded: [false; 2] }
    }

    /// Length, and outer radii with a spiral at the start and at the end, m.
    #[must_use]
    pub fn skin(&self) -> (f64, [f64; 2]) {
        let spiral = self.span.spiral.map_or(0.0, |spiral| spiral.outer_radius);
        let radius = |s: f64| self.span.radii_at(s)[1].max(spiral);
        (self.length, [radius(self.from), radius(self.from + self.length)])
    }

    /// A whole span.
    #[must_use]
    pub fn whole(span: &'a Span) -> Self {
        Self::part(span, 0.0, span.length)
    }
}

//! The pieces that an element is made of.

use crate::design::Span;

/// A span, or a part of one, inside an element.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Piece<'a> {
    /// The span.
    pub span: &'a Span,
    /// Length of the part, m.
    pub length: f64,
}

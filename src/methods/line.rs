//! The chain as a domain of differential equations: rigid offset and spans of each element, in sequence.

use crate::design::{Design, Span, SpanKind};
use crate::equilibrium::{Chain, Interaction, Settings};
use crate::error::Error;

/// A span of the chain by its numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct SpanIndex {
    /// Index of the element.
    pub(super) element: usize,
    /// Index of the span in the element.
    pub(super) piece: usize,
}

/// A place on the deformable part of the chain.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct MaterialPoint {
    /// Index of the element.
    pub(super) element: usize,
    /// Index of the span in the element.
    pub(super) piece: usize,
    /// Arc length from the span's start, m.
    pub(super) s: f64,
}

/// Nodes and rings of the chain with the spans between them.
#[derive(Debug, Clone)]
pub(super) struct Line {
    /// Nodes and rings; its strain modes are not used.
    pub(super) chain: Chain,
    /// Spans of each element, base to tip.
    pub(super) spans: Vec<Vec<Span>>,
    /// Length of an element, the unit of lengths, m.
    pub(super) length: f64,
    /// Moment that bends an element by one radian, the unit of moments, N m.
    pub(super) moment: f64,
}

impl Line {
    pub(super) fn new(design: &Design, settings: &Settings) -> Result<Self, Error> {
        let plain =
            Settings { interaction: Interaction::None, degree: 0, bending_stop: Some(false), ..*settings };
        let chain = Chain::new(design, &plain)?;
        let spans: Vec<Vec<Span>> = design
            .segments()
            .iter()
            .zip(&chain.cores)
            .flat_map(|(segment, (first, last))| {
                let parts = last - first + 1;
                let part = |span: &Span| Span { length: span.length / parts as f64, ..span.clone() };
                vec![segment.spans.iter().map(part).collect(); parts]
            })
            .collect();
        let (length, moment) = (chain.elements[0].length, chain.radian_norm().powi(2));
        Ok(Self { chain, spans, length, moment })
    }

    /// Number of elements.
    pub(super) fn count(&self) -> usize {
        self.spans.len()
    }

    /// Index of an element's core among its spans; 0 for a plain rod.
    pub(super) fn core(&self, element: usize) -> usize {
        self.spans[element].iter().position(|span| span.kind == SpanKind::Core).unwrap_or(0)
    }

    /// Units of force (N) and moment (N m): those that bend an element by one radian.
    pub(super) fn wrench_units(&self) -> [f64; 6] {
        let force = self.moment / self.length;
        [force, force, force, self.moment, self.moment, self.moment]
    }

    /// Units of a displacement (m) and a rotation (rad).
    pub(super) fn pose_units(&self) -> [f64; 6] {
        [self.length, self.length, self.length, 1.0, 1.0, 1.0]
    }
}

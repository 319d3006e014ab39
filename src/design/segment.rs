//! A segment of the chain: what bends, and the rigid bodies at its end.

use super::section::{Ring, Span};

/// The deformable spans between two rigid parts (or between base and tip), and the rigid part at their distal end.
#[derive(Debug, Clone, PartialEq)]
pub struct Segment {
    /// The deformable spans, base to tip.
    pub spans: Vec<Span>,
    /// The rigid bodies at the distal end, welded to one another, base to tip: one ring, none, or rigid sections in a row.
    pub rings: Vec<Ring>,
}

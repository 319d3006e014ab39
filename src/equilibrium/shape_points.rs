//! Points of the centreline at which the shape is reported.

use super::chain::Chain;
use crate::rod::Row;

/// Point of the centreline at which the shape is reported.
#[derive(Debug, Clone)]
pub(super) struct ShapePoint {
    pub(super) arc_length: f64,
    pub(super) place: Site,
}

/// Where it is.
#[derive(Debug, Clone)]
pub(super) enum Site {
    /// On the rigid part after a node, at this distance (m) from the node.
    Rigid(usize, f64),
    /// On an element, at this row of mode values.
    Elastic(usize, Row),
}

/// Finds the node or element at unstrained arc length `s` (m) from the base; the elements of the shaft have grown by `growth`.
pub(super) fn point_at(chain: &Chain, growth: f64, s: f64) -> ShapePoint {
    let mut start = 0.0;
    for (k, element) in chain.elements.iter().enumerate() {
        let growth = if k < chain.shaft { growth } else { 1.0 };
        if s < start + element.offset {
            return ShapePoint { arc_length: s, place: Site::Rigid(k, s - start) };
        }
        start += element.offset;
        if growth > 0.0 && s <= start + growth * element.length {
            let along = (s - start) / growth;
            // The tables pay where the points move with the insertion.
            let row = if chain.shaft > 0 { chain.tables()[k].row_at(along) } else { element.row(along) };
            return ShapePoint { arc_length: s, place: Site::Elastic(k, row) };
        }
        start += growth * element.length;
    }
    let last = chain.elements.len();
    ShapePoint { arc_length: s, place: Site::Rigid(last, (s - start).min(chain.tip_offset)) }
}

//! Points of the centreline at which the shape is reported.

use std::borrow::Cow;

use super::chain::Chain;
use crate::rod::Row;

/// Distance of a shape point from a joint of two sections, relative to the length of the device, up to which it counts as at the
/// joint: a million roundings of an arc length.
const AT_JOINT: f64 = 1e-10;

/// Point of the centreline at which the shape is reported.
#[derive(Debug, Clone)]
pub(crate) struct ShapePoint {
    pub(crate) arc_length: f64,
    pub(crate) place: Site,
}

/// Where it is.
#[derive(Debug, Clone)]
pub(crate) enum Site {
    /// On the rigid part after a node, at this distance (m) from the node.
    Rigid(usize, f64),
    /// On an element, at this row of mode values.
    Elastic(usize, Row),
}

/// Finds the node or element at unstrained arc length `s` (m) from the base; the elements of the shaft have grown by `growth`.
pub(crate) fn point_at(chain: &Chain, growth: f64, s: f64) -> ShapePoint {
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

/// The element and row at which the strain of a shape point is read: at a joint, of the section towards the tip. `None` on a rigid
/// part.
pub(crate) fn strained<'a>(chain: &Chain, point: &'a ShapePoint) -> Option<(usize, Cow<'a, Row>)> {
    let slack = AT_JOINT * chain.length();
    let start = |k: usize| (k, Cow::Owned(chain.elements[k].row(0.0)));
    match &point.place {
        Site::Rigid(node, distance) => match chain.elements.get(*node) {
            Some(next) => (next.offset - distance < slack).then(|| start(*node)),
            // A free end, whose arc length may be rounded up.
            None if chain.tip_offset < slack => {
                let last = node.checked_sub(1)?;
                let element = &chain.elements[last];
                Some((last, Cow::Owned(element.row(element.length))))
            }
            None => None,
        },
        Site::Elastic(k, row) => {
            let element = &chain.elements[*k];
            if row.arc_length < element.length - slack {
                let beyond = element.row_beyond(row.arc_length, slack);
                return Some((*k, beyond.map_or(Cow::Borrowed(row), Cow::Owned)));
            }
            match chain.elements.get(k + 1) {
                Some(next) => (next.offset < slack).then(|| start(k + 1)),
                None => (chain.tip_offset < slack).then_some((*k, Cow::Borrowed(row))),
            }
        }
    }
}

//! The surface of the chain: where its elements may touch a wall.

use super::chain::Chain;
use crate::rod::{Element, Row, RowTable};
use crate::vessel::Vessel;

/// Largest distance between two places at which the clearance of an element is looked at, m, where it is not longer than
/// [`MOST_PLACES`] times that. Between them it is a cubic.
const SPACING: f64 = 1.5e-3;

/// Most intervals of a piece.
const MOST_PLACES: usize = 12;

/// A vessel around a chain.
#[derive(Debug, Clone)]
pub(super) struct InVessel {
    pub(super) vessel: Vessel,
    pub(super) surface: Surface,
}

/// The surfaces of all elements.
#[derive(Debug, Clone)]
pub(super) struct Surface {
    pub(super) elements: Vec<ElementSurface>,
}

/// The surface of one element.
#[derive(Debug, Clone)]
pub(super) struct ElementSurface {
    /// The strain modes at any arc length.
    pub(super) table: RowTable,
    pub(super) pieces: Vec<Skin>,
}

/// The surface of a piece of constant radius.
#[derive(Debug, Clone)]
pub(super) struct Skin {
    /// Outer radius, m.
    pub(super) radius: f64,
    /// The modes at equally spaced places from its start to its end.
    pub(super) places: Vec<Row>,
}

impl Surface {
    pub(super) fn new(chain: &Chain) -> Self {
        let elements = chain.elements.iter().zip(&chain.skins);
        Self { elements: elements.map(|(element, skin)| ElementSurface::new(element, skin)).collect() }
    }
}

impl ElementSurface {
    fn new(element: &Element, skin: &[[f64; 2]]) -> Self {
        let table = RowTable::new(element);
        let mut start = 0.0;
        let pieces = skin.iter().enumerate().map(|(piece, [length, radius])| {
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small count")]
            let parts = ((length / SPACING).ceil() as usize).clamp(1, MOST_PLACES);
            let places = (0..=parts).map(|i| table.row(piece, start + length * i as f64 / parts as f64));
            let places = places.collect();
            start += length;
            Skin { radius: *radius, places }
        });
        let pieces = pieces.collect();
        Self { table, pieces }
    }
}

//! The surface of the chain: where its elements may touch a wall.

use super::chain::Chain;
use crate::rod::{Row, RowTable};
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
        let elements = chain.tables().iter().zip(&chain.skins);
        Self { elements: elements.map(|(table, skin)| ElementSurface::new(table, skin)).collect() }
    }
}

impl ElementSurface {
    fn new(table: &RowTable, skin: &[[f64; 2]]) -> Self {
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
        Self { pieces }
    }
}

//! The surface of the chain: where its elements may touch a wall.

use crate::equilibrium::model::Chain;
use crate::rod::{Row, RowTable};

/// Largest distance between two places at which the clearance of an element is looked at, m, where it is not longer than
/// [`MOST_PLACES`] times that. Between them it is a cubic.
const SPACING: f64 = 1.5e-3;

/// Most intervals of a piece.
const MOST_PLACES: usize = 12;

/// The surfaces of all elements, by element and piece.
#[derive(Debug, Clone)]
pub(crate) struct Surface {
    pub(crate) elements: Vec<Vec<Skin>>,
}

/// The surface of a piece of constant radius.
#[derive(Debug, Clone)]
pub(crate) struct Skin {
    /// Outer radius, m.
    pub(crate) radius: f64,
    /// The modes at equally spaced places from its start to its end.
    pub(crate) places: Vec<Row>,
}

impl Surface {
    pub(crate) fn new(chain: &Chain) -> Self {
        let elements = chain.tables().iter().zip(&chain.skins);
        Self { elements: elements.map(|(table, pieces)| skins(table, pieces)).collect() }
    }
}

/// The surfaces of an element's pieces, each of this length and radius (m).
fn skins(table: &RowTable, pieces: &[[f64; 2]]) -> Vec<Skin> {
    let mut start = 0.0;
    let skin = |(piece, [length, radius]): (usize, &[f64; 2])| {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small count")]
        let parts = ((length / SPACING).ceil() as usize).clamp(1, MOST_PLACES);
        let places = (0..=parts).map(|i| table.row(piece, start + length * i as f64 / parts as f64));
        let places = places.collect();
        start += length;
        Skin { radius: *radius, places }
    };
    pieces.iter().enumerate().map(skin).collect()
}

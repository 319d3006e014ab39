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

/// The surface of a piece.
#[derive(Debug, Clone)]
pub(crate) struct Skin {
    /// Outer radii at its start and its end, m.
    radii: [f64; 2],
    /// The modes at equally spaced places from its start to its end.
    pub(crate) places: Vec<Row>,
}

impl Surface {
    pub(crate) fn new(chain: &Chain) -> Self {
        let elements = chain.tables().iter().zip(&chain.skins);
        Self { elements: elements.map(|(table, pieces)| skins(table, pieces)).collect() }
    }
}

impl Skin {
    /// Largest outer radius, m.
    pub(crate) fn widest(&self) -> f64 {
        self.radii[0].max(self.radii[1])
    }

    /// Change of the outer radius per arc length.
    pub(crate) fn slope(&self) -> f64 {
        let [start, end] = self.radii;
        let [first, last] = [self.places.first(), self.places.last()];
        let length = first.zip(last).map_or(0.0, |(first, last)| last.arc_length - first.arc_length);
        if start.to_bits() == end.to_bits() { 0.0 } else { (end - start) / length }
    }

    /// Outer radius at arc length `s` from the element's start, m.
    pub(crate) fn radius_at(&self, s: f64) -> f64 {
        let from = self.places.first().map_or(s, |place| place.arc_length);
        self.radii[0] + self.slope() * (s - from)
    }
}

/// The surfaces of an element's pieces, each of this length and these radii (m).
fn skins(table: &RowTable, pieces: &[(f64, [f64; 2])]) -> Vec<Skin> {
    let mut start = 0.0;
    let skin = |(piece, (length, radii)): (usize, &(f64, [f64; 2]))| {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small count")]
        let parts = ((length / SPACING).ceil() as usize).clamp(1, MOST_PLACES);
        let places = (0..=parts).map(|i| table.row(piece, start + length * i as f64 / parts as f64));
        let places = places.collect();
        start += length;
        Skin { radii: *radii, places }
    };
    pieces.iter().enumerate().map(skin).collect()
}

//! Tables of the strain modes at any arc length of an element, interpolated exactly.

use super::element::Element;
use super::row::Row;
use crate::numerics::lagrange;
use crate::numerics::quadrature::gauss_legendre;

/// The rows of all pieces of an element as polynomials: much cheaper than [`Element::row`], and equal to rounding.
#[derive(Debug, Clone)]
pub struct RowTable(Vec<PieceRows>);

/// The rows of one piece at as many nodes as determine them.
#[derive(Debug, Clone)]
struct PieceRows {
    start: f64,
    length: f64,
    nodes: Vec<f64>,
    rows: Vec<Row>,
}

impl RowTable {
    /// The table of an element.
    #[must_use]
    pub fn new(element: &Element) -> Self {
        let mut start = 0.0;
        let pieces = (0..element.pieces()).map(|piece| {
            let (length, points) = element.piece(piece);
            // Positions have as high a degree as there are stations, integrals one more than the modes.
            let (nodes, _) = gauss_legendre(points + 2);
            let at = |x: &f64| element.row_in(piece, start, start + 0.5 * length * (1.0 + x));
            let rows = nodes.iter().map(at).collect();
            start += length;
            PieceRows { start: start - length, length, nodes, rows }
        });
        Self(pieces.collect())
    }

    /// The row at arc length `s` (m) from the element's start, clamped to the element.
    #[must_use]
    pub fn row_at(&self, s: f64) -> Row {
        let end = |piece: &PieceRows| piece.start + piece.length;
        let piece = self.0.iter().position(|piece| s <= end(piece)).unwrap_or(self.0.len() - 1);
        self.row(piece, s.clamp(0.0, end(&self.0[piece])))
    }

    /// Derivatives of the mode values by arc length (1/m2), by degree of freedom, at arc length `s` (m) from the element's start.
    #[must_use]
    pub fn rate_slopes(&self, s: f64) -> Vec<f64> {
        let end = |piece: &PieceRows| piece.start + piece.length;
        let piece = self.0.iter().position(|piece| s <= end(piece)).unwrap_or(self.0.len() - 1);
        let PieceRows { start, length, nodes, rows } = &self.0[piece];
        let slopes = lagrange::slopes(nodes, 2.0 * (s - start) / length - 1.0);
        let mut sum = vec![0.0; rows[0].rate.len()];
        for (slope, row) in slopes.iter().zip(rows) {
            sum.iter_mut().zip(&row.rate).for_each(|(sum, own)| *sum += 2.0 / length * slope * own);
        }
        sum
    }

    /// The row at arc length `s` (m) from the element's start, which is within this piece.
    #[must_use]
    pub fn row(&self, piece: usize, s: f64) -> Row {
        let PieceRows { start, length, nodes, rows } = &self.0[piece];
        let values = lagrange::values(nodes, 2.0 * (s - start) / length - 1.0);
        let mix = |part: fn(&Row) -> &Vec<f64>| {
            let mut sum = vec![0.0; part(&rows[0]).len()];
            for (value, row) in values.iter().zip(rows) {
                sum.iter_mut().zip(part(row)).for_each(|(sum, own)| *sum += value * own);
            }
            sum
        };
        let (first, rest_rate) = (&rows[0], rows[0].rest_rate);
        Row {
            arc_length: s,
            rate: mix(|row| &row.rate),
            integral: mix(|row| &row.integral),
            position: mix(|row| &row.position),
            rest_rate,
            rest_angle: first.rest_angle + rest_rate * (s - first.arc_length),
        }
    }
}

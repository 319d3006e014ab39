//! An element: the deformable spans between two nodes, with tables of its modes and stations.

use core::ops::Range;
use std::sync::Arc;

use nalgebra::{Vector2, Vector3};

use super::basis::{Compliance, Ends, Modes, Part};
use super::bending_stop::BendingStop;
use super::fine_points::fine_points;
use super::moments::SectionMoments;
use super::piece::Piece;
use super::row::{COMPONENTS, Row};
use super::section_material::SectionMaterial;
use super::source_geometry::SourceGeometry;
use crate::design::{SpanKind, Stiffness};
use crate::numerics::{lagrange, quadrature::gauss_legendre};

/// Gauss points per disc, whose strain is some percent of the core's, and minimum number of Gauss points of a core or rod
/// beyond the number of modes.
const POINTS: (usize, usize) = (2, 1);

/// Gauss points per disc, and of a core or rod beyond the number of modes, of references. What limits the others is the spiral, whose
/// third moments four points a section leave out.
const FINE_POINTS: (usize, usize) = (6, 12);

/// Share of an element's compliance from which the strain along a disc is resolved as that along the core.
const LONG: f64 = 0.02;

/// Additional points of the polynomials that stand for the rows of a piece whose compliance changes along it.
const TAPERED: usize = 8;

/// Size below which a coefficient of the projection between elements is dropped as rounding.
const NEGLIGIBLE: f64 = 1e-13;

/// Resolution of an element: degree of the modes and quadrature.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Resolution {
    /// Polynomial degree of the strain modes; at least two more Gauss points are taken.
    pub degree: usize,
    /// Geometry of the nearest ring whose field the Gauss points must resolve; `None` where no ring acts on the element.
    pub nearest: Option<SourceGeometry>,
    /// Whether touching windings may stiffen a core (bending stop), which the bending modes beside the core must follow.
    pub bending_stop: bool,
    /// Whether there are as many Gauss points as a reference needs.
    pub fine: bool,
}

/// A Gauss point of an element.
#[derive(Debug, Clone)]
pub struct Station {
    /// Mode values and position weights.
    pub row: Row,
    /// Quadrature weight, m.
    pub weight: f64,
    /// Section stiffness.
    pub stiffness: Stiffness,
    /// Material represented by this station.
    pub material: SectionMaterial,
    /// Centroid and four-point rule for fields that are linear and quadratic over the section, m.
    pub points: ([Vector2<f64>; 1], [Vector2<f64>; 4]),
    /// Mean square distance of the material from its centroid, m2.
    pub spread: f64,
}

/// Tables of one element.
///
/// The unknowns are the mode amplitudes: first the six constant modes, which are determined by the end poses, then the others.
#[derive(Debug, Clone)]
pub struct Element {
    /// Distance from the node before (proximal face of its ring) to the element's start, m.
    pub offset: f64,
    /// Length, m.
    pub length: f64,
    /// Gauss points.
    pub stations: Vec<Station>,
    /// Elastic stiffness of each degree of freedom about the straight shape: J/rad2 and J/m2.
    pub metric: Vec<f64>,
    /// Strain component of each degree of freedom, 0 to 5.
    pub component: Vec<usize>,
    /// The components as runs: component and range of degrees of freedom.
    pub runs: Vec<(usize, Range<usize>)>,
    /// Mode tables at the ends of the core (or of the whole element, for a plain rod).
    pub core_ends: [Arc<Row>; 2],
    /// The bending stop of the core; `None` without windings.
    pub stop: Option<BendingStop>,
    /// Rotation vector of the end without loads, rad.
    pub rest_angle: Vector3<f64>,
    modes: [Modes; COMPONENTS],
    pieces: Vec<PieceTable>,
}

/// The table of a piece.
#[derive(Debug, Clone)]
struct PieceTable {
    /// Length, m.
    length: f64,
    /// Gauss nodes on [-1, 1].
    nodes: Vec<f64>,
    /// Number of the first station.
    first: usize,
    /// Curvature without loads, 1/m.
    rest_rate: Vector3<f64>,
    /// Whether its compliance changes along it.
    tapered: bool,
}

impl Element {
    /// Tables for a chain of pieces.
    #[must_use]
    pub fn new(offset: f64, pieces: &[Piece<'_>], resolution: &Resolution) -> Self {
        let degree = resolution.degree;
        let bend = |piece: &Piece<'_>| piece.length / piece.span.stiffness.bending;
        let core = core_of(pieces, bend);
        let before: f64 = pieces.iter().take(core).map(|piece| piece.length).sum();
        let core_length = pieces.get(core).map_or(0.0, |piece| piece.length);
        let resolved = resolution.nearest.map_or(0, |ring| ring.along(ring.distance + before, core_length));
        let (disc_points, extra) = if resolution.fine { FINE_POINTS } else { POINTS };
        let core_points = resolved.max(degree + 1 + extra);

        let all: f64 = pieces.iter().map(bend).sum();
        let is_long = |number: usize, piece: &Piece<'_>| number != core && bend(piece) > LONG * all;
        let modes = |stiffness: fn(&Stiffness) -> f64, ends: Ends| {
            let mut start = 0.0;
            let parts = pieces.iter().enumerate().map(|(number, piece)| {
                start += piece.length;
                let compliance = Compliance::of(piece, stiffness);
                let long = is_long(number, piece);
                Part { start: start - piece.length, length: piece.length, compliance, long }
            });
            Modes::new(parts.collect(), core, degree, ends)
        };

        let stop = BendingStop::new(pieces);
        let jumps = resolution.bending_stop && stop.is_some();
        let bending = modes(|k| k.bending, if jumps { Ends::Jump } else { Ends::Linear });
        let shear = modes(|k| k.shear, Ends::Constant);
        let (torsion, axial) = (modes(|k| k.torsion, Ends::Constant), modes(|k| k.axial, Ends::Constant));

        // The six strains u1, u2 (bending), u3 (twist), v1, v2 (shear), v3 (stretch).
        let modes = [bending.clone(), bending, torsion, shear.clone(), shear, axial];
        let numbered: [(usize, &Modes); COMPONENTS] = core::array::from_fn(|c| (c, &modes[c]));
        let component: Vec<usize> = order(numbered.map(|(c, mode)| vec![c; mode.count()]));

        let runs = runs(&component);
        let metric = component.iter().map(|c| modes[*c].stiffness()).collect();

        // A piece that bends as a core does is resolved as one.
        let mut tables = Vec::new();
        let mut first = 0;
        for (number, piece) in pieces.iter().enumerate() {
            let short = number != core && !is_long(number, piece);
            let points = if short { disc_points } else { core_points };
            tables.push(PieceTable {
                length: piece.length,
                nodes: gauss_legendre(points).0,
                first,
                rest_rate: piece.span.rest_curvature,
                tapered: piece.span.taper.is_some(),
            });
            first += points;
        }

        let length = pieces.iter().map(|piece| piece.length).sum();
        let empty = Arc::new(Row::empty());
        let mut element = Self {
            offset,
            length,
            stations: Vec::new(),
            metric,
            component,
            runs,
            core_ends: [empty.clone(), empty],
            stop,
            rest_angle: tables.iter().map(|piece| piece.rest_rate * piece.length).sum(),
            modes,
            pieces: tables,
        };

        // The rows need the tables of the pieces, which are in the element by now.
        element.core_ends = [before, before + core_length].map(|s| Arc::new(element.row(s)));
        for (index, piece) in pieces.iter().enumerate() {
            element.add_stations(index, piece);
        }
        element
    }

    /// Number of degrees of freedom.
    #[must_use]
    pub fn freedoms(&self) -> usize {
        self.metric.len()
    }

    /// Whether an element of the same pieces has the same modes.
    #[must_use]
    pub fn has_modes_of(&self, other: &Self) -> bool {
        self.modes.iter().zip(&other.modes).all(|(own, other)| own.are_built_as(other))
    }

    /// Projection of the modes of `other`, an element of the same pieces: own and other degree of freedom with coefficient.
    ///
    /// The coefficient is the own amplitude per unit amplitude of the other: the same strains where the degree is at least as
    /// high, else the nearest.
    #[must_use]
    pub fn projection(&self, other: &Self) -> Vec<(usize, usize, f64)> {
        let of = |element: &Self, c: usize| -> Vec<usize> {
            (0..element.freedoms()).filter(|i| element.component[*i] == c).collect()
        };
        let mut out = Vec::new();
        for c in 0..COMPONENTS {
            let (own, others) = (of(self, c), of(other, c));
            for (i, row) in own.iter().zip(self.modes[c].projection(&other.modes[c])) {
                out.extend(others.iter().zip(row).map(|(j, value)| (*i, *j, value)));
            }
        }
        out.retain(|entry| entry.2.abs() > NEGLIGIBLE);
        out
    }

    /// Tables at arc length `s` from the element's start, clamped to the element.
    #[must_use]
    pub fn row(&self, s: f64) -> Row {
        let mut start = 0.0;
        let mut piece = 0;
        while piece + 1 < self.pieces.len() && s > start + self.pieces[piece].length {
            start += self.pieces[piece].length;
            piece += 1;
        }
        self.row_in(piece, start, s.clamp(0.0, self.length))
    }

    /// Tables of the piece towards the tip at the joint of two pieces within `slack` (m) of arc length `s`; `None` where there is no
    /// joint. Mode values jump there, as the stiffness does.
    #[must_use]
    pub fn row_beyond(&self, s: f64, slack: f64) -> Option<Row> {
        let mut joint = 0.0;
        for (piece, own) in self.pieces.iter().enumerate().take(self.pieces.len() - 1) {
            joint += own.length;
            if (s - joint).abs() <= slack {
                return Some(self.row_in(piece + 1, joint, joint));
            }
        }
        None
    }

    /// Tables within a piece that begins at `start`.
    pub(super) fn row_in(&self, piece: usize, start: f64, s: f64) -> Row {
        let rate = order(self.modes.each_ref().map(|mode| mode.values(piece, s)));
        let integral = order(self.modes.each_ref().map(|mode| mode.integrals(piece, s)));
        let (mut position, mut rest_angle) = (Vec::new(), Vector3::zeros());
        for PieceTable { length, nodes, rest_rate, .. } in &self.pieces[..piece] {
            position.extend(lagrange::integrals(nodes, 1.0).iter().map(|weight| 0.5 * length * weight));
            rest_angle += rest_rate * *length;
        }
        let PieceTable { length, nodes, rest_rate, .. } = &self.pieces[piece];
        let x = (2.0 * (s - start) / length - 1.0).clamp(-1.0, 1.0);
        position.extend(lagrange::integrals(nodes, x).iter().map(|weight| 0.5 * length * weight));
        let total = self.pieces.iter().map(|piece| piece.nodes.len()).sum();
        position.resize(total, 0.0);
        rest_angle += rest_rate * (s - start);
        Row { arc_length: s, rate, integral, position, rest_rate: *rest_rate, rest_angle }
    }

    /// Number of pieces.
    pub(super) fn pieces(&self) -> usize {
        self.pieces.len()
    }

    /// Length (m) of a piece, and the largest degree of the polynomials that its rows are.
    pub(super) fn piece(&self, piece: usize) -> (f64, usize) {
        let PieceTable { length, nodes, tapered, .. } = &self.pieces[piece];
        let degree = self.modes.iter().map(Modes::count).max().unwrap_or(0);
        (*length, nodes.len().max(degree) + if *tapered { TAPERED } else { 0 })
    }

    /// Gauss nodes on [-1, 1] of a piece, and its first station.
    pub(super) fn nodes(&self, piece: usize) -> (&[f64], usize) {
        let PieceTable { nodes, first, .. } = &self.pieces[piece];
        (nodes, *first)
    }

    fn add_stations(&mut self, index: usize, piece: &Piece<'_>) {
        let start: f64 = self.pieces[..index].iter().map(|piece| piece.length).sum();
        let span = piece.span;
        let nodes = self.pieces[index].nodes.clone();
        let weights = lagrange::integrals(&nodes, 1.0);

        // The spiral turns along the piece faster than the modes: its moments are integrated on finer points
        // and assigned to the stations by their Lagrange polynomials.
        let mut materials = vec![SectionMoments::zero(); nodes.len()];
        for (x, fine, polynomials) in fine_points(&nodes) {
            let along = 0.5 * piece.length * (1.0 + x);
            for (material, value) in materials.iter_mut().zip(polynomials) {
                material.add_section(span, piece.from + along, 0.5 * piece.length * fine * value);
            }
        }

        for ((x, weight), material) in nodes.iter().zip(weights).zip(materials) {
            let weight = 0.5 * piece.length * weight;
            let along = 0.5 * piece.length * (1.0 + x);
            let row = self.row_in(index, start, start + along);
            self.stations.push(Station {
                row,
                weight,
                stiffness: span.stiffness_at(piece.from + along),
                material: SectionMaterial::new(span, piece.from + along, material, weight),
                points: ([material.centroid()], material.points()),
                spread: material.spread(),
            });
        }
    }
}

/// The number of the piece that deforms most: the core with its spiral or, of others, that with the largest compliance `bend`.
fn core_of(pieces: &[Piece<'_>], bend: impl Fn(&Piece<'_>) -> f64) -> usize {
    let core = pieces.iter().position(|piece| piece.span.kind == SpanKind::Core);
    let softest = || (0..pieces.len()).max_by(|a, b| bend(&pieces[*a]).total_cmp(&bend(&pieces[*b])));
    core.or_else(softest).unwrap_or(0)
}

/// Arranges a table by mode in the order of the degrees of freedom: the first modes of all components, the other rotation
/// modes, the other strain modes.
fn order<T>(tables: [Vec<T>; COMPONENTS]) -> Vec<T> {
    let mut columns = tables.map(Vec::into_iter);
    let mut out: Vec<T> = columns.iter_mut().filter_map(Iterator::next).collect();
    for column in columns {
        out.extend(column);
    }
    out
}

/// Neighbouring degrees of freedom of one component: the loops of the derivatives run over adjacent entries.
fn runs(component: &[usize]) -> Vec<(usize, Range<usize>)> {
    let mut runs: Vec<(usize, Range<usize>)> = Vec::new();
    for (i, c) in component.iter().enumerate() {
        match runs.last_mut() {
            Some((last, run)) if last == c => run.end = i + 1,
            _ => runs.push((*c, i..i + 1)),
        }
    }
    runs
}

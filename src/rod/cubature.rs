//! Quadrature over an element's material for the field of a ring, with as few points as its distance allows.
//!
//! The field is smooth over the material, unlike the helical spiral. Along the arc length and around the centreline the spiral
//! is therefore integrated exactly against polynomials and harmonics through the points (product integration), so that their
//! number depends on the field alone.

use core::f64::consts::TAU;

use nalgebra::{Complex, Vector2};

use super::element::Element;
use super::fine_points::{Fine, fine_points};
use super::moments::SectionMoments;
use super::piece::Piece;
use super::source_geometry::SourceGeometry;
use crate::design::{Direction, SectorKind, Spiral};
use crate::numerics::{lagrange, quadrature::gauss_legendre};

/// A point of a section with its share of the volume.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SectionPoint {
    /// Position along `d1`, `d2`, m.
    pub position: Vector2<f64>,
    /// Volume, m3; may be negative for a single point.
    pub volume: f64,
}

/// Quadrature points of one station.
#[derive(Debug, Clone, PartialEq)]
pub struct StationQuadrature {
    /// Index of the station.
    pub station: usize,
    /// Magnetisation, A/m.
    pub magnetisation: f64,
    /// Direction of the magnetisation, in the directors.
    pub direction: Direction,
    /// Distance from the ring's facing side along the straight manipulator, m.
    pub distance: f64,
    /// Points of the section.
    pub points: Vec<SectionPoint>,
}

impl Element {
    /// Quadrature points for the energy of this element, made of `pieces`, in the field of a ring.
    #[must_use]
    pub fn samples(&self, pieces: &[Piece<'_>], geometry: &SourceGeometry) -> Vec<StationQuadrature> {
        let mut out = Vec::new();
        let mut start = 0.0;
        for (index, piece) in pieces.iter().enumerate() {
            // The ring stands at the element's start, or beyond its end: distances are counted from there.
            let before = if geometry.beyond { self.length - start - piece.length } else { start };
            start += piece.length;

            if geometry.bonded && piece.bonded[usize::from(geometry.beyond)] {
                continue;
            }

            let (nodes, first) = self.nodes(index);
            let distance = geometry.distance + before;
            let chosen = subset(nodes, geometry.interpolated(distance, piece.length));
            let own: Vec<f64> = chosen.iter().map(|i| nodes[*i]).collect();
            let fine: Vec<Fine> = fine_points(&own).collect();

            for (i, station) in chosen.iter().enumerate() {
                let x = if geometry.beyond { -nodes[*station] } else { nodes[*station] };
                let at = distance + 0.5 * piece.length * (1.0 + x);
                let points = Section { piece, nodes: &own, fine: &fine, node: i }.points(geometry, at);

                out.push(StationQuadrature {
                    station: first + station,
                    magnetisation: piece.span.magnetisation,
                    direction: self.stations[first + station].material.direction,
                    distance: at,
                    points,
                });
            }
        }
        out
    }
}

/// Selects at least `count` of the nodes, symmetric and distributed like that many Gauss points.
fn subset(nodes: &[f64], count: usize) -> Vec<usize> {
    let even = nodes.len().is_multiple_of(2);
    // A centre node exists only if the number of nodes is odd.
    let count = if even { count.next_multiple_of(2) } else { count };
    if count >= nodes.len() {
        return (0..nodes.len()).collect();
    }
    let mut free: Vec<usize> = (0..nodes.len()).collect();
    let mut chosen: Vec<usize> = Vec::new();
    for x in gauss_legendre(count).0.into_iter().take(count.div_ceil(2)) {
        let nearest = (0..free.len())
            .min_by(|a, b| (nodes[free[*a]] - x).abs().total_cmp(&(nodes[free[*b]] - x).abs()));
        let Some(station) = nearest.map(|place| free.remove(place)) else { break };
        let mirrored = nodes.len() - 1 - station;
        chosen.push(station);
        if mirrored != station {
            free.retain(|other| *other != mirrored);
            chosen.push(mirrored);
        }
    }
    chosen.sort_unstable();
    chosen
}

/// Section of a piece at one of the nodes that represent it.
struct Section<'a> {
    piece: &'a Piece<'a>,
    nodes: &'a [f64],
    fine: &'a [Fine],
    node: usize,
}

impl Section<'_> {
    fn points(&self, geometry: &SourceGeometry, distance: f64) -> Vec<SectionPoint> {
        let span = self.piece.span;
        let harmonics = |radius| geometry.harmonics(distance, radius);
        let circle = span.radii_at(self.along_span(self.nodes[self.node]));
        if harmonics(geometry.radius) <= 1
            && let Some(points) = self.moments()
        {
            return points;
        }
        let mut out = Vec::new();
        self.add_circle(&mut out, circle, TAU, geometry.radial(distance, circle), harmonics);
        if let Some(spiral) = &span.spiral {
            let sector = [spiral.inner_radius, spiral.outer_radius];
            let radial = geometry.radial(distance, sector);
            match spiral.kind {
                SectorKind::Axisymmetric => {
                    self.add_circle(&mut out, sector, spiral.sector_angle, radial, harmonics);
                }
                // The odd harmonics are not polynomials of the squared radius.
                SectorKind::RightHanded | SectorKind::LeftHanded => {
                    self.add_spiral(&mut out, spiral, radial.max(2), harmonics);
                }
            }
        }
        out
    }

    /// Arc length from the span's start at `x` from -1 to 1 along the piece, m.
    fn along_span(&self, x: f64) -> f64 {
        self.piece.from + 0.5 * self.piece.length * (1.0 + x)
    }

    /// Passes the arc length from the span's start and weight (m) of this node for each fine point of the integral along the piece to `value`.
    fn along(&self, mut value: impl FnMut(f64, f64)) {
        let half = 0.5 * self.piece.length;
        for (x, weight, polynomials) in self.fine {
            value(self.along_span(*x), half * weight * polynomials[self.node]);
        }
    }

    /// The four-point rule with the moments of the section; `None` for a node with a negative weight, which may have no such
    /// points of equal volume.
    fn moments(&self) -> Option<Vec<SectionPoint>> {
        let mut moments = SectionMoments::zero();
        self.along(|s, weight| moments.add_section(self.piece.span, s, weight));
        let volume = moments.volume / 4.0;
        let points = || moments.points().map(|position| SectionPoint { position, volume }).to_vec();
        moments.are_of_material().then(points)
    }

    /// Adds the points of an annulus of which `filled` (rad) is material, averaged around it.
    fn add_circle(
        &self,
        out: &mut Vec<SectionPoint>,
        bounds: [f64; 2],
        filled: f64,
        radial: usize,
        harmonics: impl Fn(f64) -> usize,
    ) {
        let weight = 0.5 * self.piece.length * lagrange::integrals(self.nodes, 1.0)[self.node];
        for (radius, area) in radii(bounds, radial) {
            let points = harmonics(radius) + 2;
            let volume = weight * filled * area / points as f64;
            out.extend((0..points).map(|k| SectionPoint { position: direction(k, points) * radius, volume }));
        }
    }

    /// Adds the points of the helical sector, which integrate the harmonics around the centreline exactly.
    fn add_spiral(
        &self,
        out: &mut Vec<SectionPoint>,
        spiral: &Spiral,
        radial: usize,
        harmonics: impl Fn(f64) -> usize,
    ) {
        for (radius, area) in radii([spiral.inner_radius, spiral.outer_radius], radial) {
            let points = 2 * harmonics(radius) + 2;
            let shares = self.shares(spiral, points);
            out.extend(shares.iter().enumerate().map(|(k, share)| SectionPoint {
                position: direction(k, points) * radius,
                volume: share * area,
            }));
        }
    }

    /// Integral along the piece (m rad) of the sector's angle, distributed to so many points around the centreline.
    ///
    /// The share of a point is the integral over the sector of the trigonometric polynomial that is one there and zero at
    /// the others.
    fn shares(&self, spiral: &Spiral, points: usize) -> Vec<f64> {
        let (mut whole, mut harmonics) = (0.0, vec![Complex::<f64>::ZERO; points / 2]);
        self.along(|s, weight| {
            whole += weight * spiral.sector_angle;
            let sector = spiral.sector(s, self.piece.span.length);
            let ends = sector.map(|angle| Complex::from_polar(1.0, angle));
            let mut powers = ends;
            for (m, harmonic) in (1..).zip(&mut harmonics) {
                *harmonic += (powers[1] - powers[0]) * (weight / f64::from(m));
                powers = [powers[0] * ends[0], powers[1] * ends[1]];
            }
        });
        let around: Vec<_> = (0..points).map(|k| direction(k, points)).collect();
        let share = |k: usize| {
            let polynomial = harmonics.iter().zip(1..).map(|(harmonic, m)| {
                let turned = around[k * m % points];
                harmonic.im * turned.x - harmonic.re * turned.y
            });
            (whole + 2.0 * polynomial.sum::<f64>()) / points as f64
        };
        (0..points).map(share).collect()
    }
}

fn direction(k: usize, points: usize) -> Vector2<f64> {
    let (sine, cosine) = (TAU * k as f64 / points as f64).sin_cos();
    Vector2::new(cosine, sine)
}

/// Gauss points in the squared radius, as radius and area per radian.
fn radii(bounds: [f64; 2], points: usize) -> impl Iterator<Item = (f64, f64)> {
    let [inner, outer] = bounds.map(|r| r * r);
    let (nodes, weights) = gauss_legendre(points);
    nodes.into_iter().zip(weights).map(move |(x, w)| {
        let square = 0.5 * (inner + outer + x * (outer - inner));
        (square.sqrt(), 0.25 * w * (outer - inner))
    })
}

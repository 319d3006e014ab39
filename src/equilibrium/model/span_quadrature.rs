//! Quadrature of the material of each element in the field of each ring, by their distance and the bend between them.
//!
//! Sections far from the ring see its multipoles. Their number is chosen for the straight manipulator and the bend; a ring
//! that has come nearer than a bend alone explains acts exactly.

use super::ring_body::RingBody;
use super::settings::{Interaction, Settings};
use crate::design::Direction;
use crate::geometry::Pose;
use crate::magnetics::{DipoleSheet, FieldAccuracy};
use crate::rod::{Element, Piece, SectionPoint, SourceGeometry, StationQuadrature};

/// Largest bends for which each of the samples is made, rad; the last sample is also used beyond.
const BENDS: [f64; 5] = [0.08, 0.16, 0.32, 0.64, 1.28];

/// Accuracy between a ring and a span, relative to that of the pairs: the errors of all spans of a ring add up.
pub(crate) const SPAN_SHARE: f64 = 0.3;

/// Largest bend for which the distances of the last samples hold, rad.
const MOST_BENT: f64 = 2.4;

/// Ratio of the least distance of a section from a ring to the chord of an arc: attracted axially, soft helices contract by
/// several percent.
const SLACK: f64 = 0.85;

/// Accuracy of multipoles relative to that between two rings, or a ring and a span.
pub(crate) const MULTIPOLE_SHARE: f64 = 0.03;

/// Accuracy of the pairs from which on the fields need not be exact.
const ROUGH: f64 = 1e-6;

/// How the field of a near ring is evaluated.
pub(crate) fn field_accuracy(pair_accuracy: f64) -> FieldAccuracy {
    if pair_accuracy >= ROUGH { FieldAccuracy::Rough } else { FieldAccuracy::Exact }
}

/// A section of an element with the dipoles that represent its material for a ring.
#[derive(Debug, Clone)]
pub(crate) struct SectionSample {
    /// Index of the station.
    pub(crate) station: usize,
    pub(crate) sheet: DipoleSheet,
    /// Direction of the dipoles, in the directors.
    pub(crate) direction: Direction,
    /// How the field is evaluated, and how near the ring.
    accuracy: [FieldAccuracy; 2],
}

impl SectionSample {
    /// How the ring's field is evaluated; `near`: nearer than a bend of the chain explains.
    pub(crate) fn accuracy(&self, near: bool) -> FieldAccuracy {
        self.accuracy[usize::from(near)]
    }

    /// The pose of the section with the direction of the dipoles instead of its normal.
    pub(crate) fn directed(&self, section: Pose) -> Pose {
        Pose { rotation: self.direction.sheet(&section.rotation), ..section }
    }

    /// The sample for the bend number `level` between the element and a ring.
    fn new(quadrature: &StationQuadrature, level: usize, body: &RingBody, settings: &Settings) -> Self {
        let dipole = |point: &SectionPoint| (point.position, point.volume * quadrature.magnetisation);
        let dipoles: Vec<_> = quadrature.points.iter().map(dipole).collect();
        let near = field_accuracy(settings.pair_accuracy);
        let (chord, tilt) = (chord(level), (0.5 * bend(level)).sin());
        let distance = chord * (quadrature.distance + body.half_length());
        let radius = quadrature.points.iter().map(|point| point.position.norm()).fold(0.0, f64::max);
        let least2 = distance * (distance - 2.0 * radius * tilt) + radius * radius;
        let ratio2 = body.extent().powi(2) / least2;
        let allowed = MULTIPOLE_SHARE * SPAN_SHARE * settings.pair_accuracy;
        let far = FieldAccuracy::far(ratio2, allowed).unwrap_or(near);
        let (station, direction) = (quadrature.station, quadrature.direction);
        Self { station, sheet: DipoleSheet::new(&dipoles), direction, accuracy: [far, near] }
    }
}

/// Bend for which the samples number `level` are made, rad.
fn bend(level: usize) -> f64 {
    if level + 1 < BENDS.len() { BENDS[level] } else { MOST_BENT }
}

/// Least distance over an arc length along which the chain is bent by so much.
fn chord(level: usize) -> f64 {
    let half = 0.5 * bend(level);
    SLACK * half.sin() / half
}

/// The quadrature samples of an element for one ring, one for each bend.
#[derive(Debug, Clone)]
struct SpanQuadrature {
    /// An element of this kind.
    element: usize,
    geometry: SourceGeometry,
    samples: [Vec<SectionSample>; BENDS.len()],
}

/// The quadrature samples of all elements for all rings; equal ones are stored once.
#[derive(Debug, Clone)]
pub(crate) struct SpanQuadratures {
    quadratures: Vec<SpanQuadrature>,
    /// Index into `quadratures` by element and ring; `None` where the ring does not act.
    places: Vec<Vec<Option<usize>>>,
    /// Arc length of every node along the straight chain, m.
    arc_length: Vec<f64>,
}

impl SpanQuadratures {
    /// Makes the samples of elements that consist of `pieces`.
    pub(crate) fn new(
        elements: &[Element],
        pieces: &[Vec<Piece<'_>>],
        rings: &[RingBody],
        settings: &Settings,
    ) -> Self {
        let mut quadratures: Vec<SpanQuadrature> = Vec::new();
        let mut place = |element: usize, body: &RingBody| {
            if pieces[element].iter().all(|piece| piece.span.magnetisation == 0.0) {
                return None;
            }
            if body.ring.remanence == 0.0 {
                return None;
            }

            // Elements that are alike, with rings at like places, share their samples.
            let geometry = source_geometry(elements, element, (body, rings), settings)?;
            let same =
                |own: &SpanQuadrature| own.geometry == geometry && pieces[own.element] == pieces[element];
            Some(quadratures.iter().position(same).unwrap_or_else(|| {
                let samples = core::array::from_fn(|level| {
                    let geometry = SourceGeometry { bend: BENDS[level], ..geometry };
                    let sections = elements[element].samples(&pieces[element], &geometry);
                    sections.iter().map(|own| SectionSample::new(own, level, body, settings)).collect()
                });
                quadratures.push(SpanQuadrature { element, geometry, samples });
                quadratures.len() - 1
            }))
        };
        let places = (0..elements.len()).map(|k| rings.iter().map(|body| place(k, body)).collect()).collect();

        let mut arc_length = vec![0.0];
        for element in elements {
            arc_length.push(arc_length[arc_length.len() - 1] + element.offset + element.length);
        }
        Self { quadratures, places, arc_length }
    }

    /// The samples of an element for a ring at a level of [`Self::level`], and whether the ring is nearer than they assume.
    pub(crate) fn samples(&self, element: usize, ring: usize, level: usize) -> (&[SectionSample], bool) {
        let (bend, near) = (level % BENDS.len(), level >= BENDS.len());
        (self.places[element][ring].map_or(&[], |place| &self.quadratures[place].samples[bend]), near)
    }

    /// Number of levels: by bend, for rings as far as a bend leaves them, and for nearer ones.
    pub(crate) const LEVELS: usize = 2 * BENDS.len();

    /// The level for the poses of all nodes, by the bend between a ring and an element and by their distance.
    pub(crate) fn level(&self, element: usize, body: &RingBody, nodes: &[Pose]) -> usize {
        let (ring, ends) = (&nodes[body.node], [element, element + 1]);
        let least = ends.map(|end| ring.axis().dot(&nodes[end].axis())).into_iter().fold(1.0, f64::min);
        let bend = least.clamp(-1.0, 1.0).acos();
        let level = BENDS.iter().position(|most| bend <= *most).unwrap_or(BENDS.len() - 1);
        let centre = body.centre(ring);
        let near = ends.into_iter().any(|end| {
            let straight = self.arc_length[end] - self.arc_length[body.node] - body.to_centre();
            (nodes[end].position - centre.position).norm() < chord(level) * straight.abs()
        });
        level + if near { BENDS.len() } else { 0 }
    }
}

/// Geometry of a ring as seen from element `k` of the straight chain, if it acts there.
fn source_geometry(
    elements: &[Element],
    k: usize,
    (body, rings): (&RingBody, &[RingBody]),
    settings: &Settings,
) -> Option<SourceGeometry> {
    let beyond = body.node > k;
    let acts = match settings.interaction {
        Interaction::None | Interaction::Rings | Interaction::Auto => false,
        Interaction::Preceding => !beyond,
        Interaction::Full => true,
    };
    let between = if beyond { &elements[k + 1..body.node] } else { &elements[body.node..k] };
    let lengths: f64 = between.iter().map(|element| element.offset + element.length).sum();
    // An element's offset contains the rigid part before its start: this ring itself, or what it faces.
    let distance = lengths + if beyond { body.start } else { elements[k].offset - body.end() };
    // Of rigid bodies, the nearest one on either side is bonded to the spans.
    let nearest = |other: &&RingBody| (other.node > k) == beyond;
    let bonded = if beyond { rings.iter().find(nearest) } else { rings.iter().rev().find(nearest) };
    acts.then(|| SourceGeometry {
        distance,
        beyond,
        bonded: bonded
            .is_some_and(|own| (own.node, own.start.to_bits()) == (body.node, body.start.to_bits())),
        radius: body.ring.outer_radius,
        bend: 0.0,
        accuracy: SPAN_SHARE * settings.pair_accuracy,
    })
}

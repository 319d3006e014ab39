//! Quadrature of the material of each element in the field of each ring, by their distance and the bend between them.

use super::ring_body::RingBody;
use super::settings::{Interaction, Settings};
use crate::geometry::Pose;
use crate::rod::{Element, Piece, SourceGeometry, StationQuadrature};

/// Largest bends for which each of the samples is made, rad; the last sample is also used beyond.
const BENDS: [f64; 5] = [0.08, 0.16, 0.32, 0.64, 1.28];

/// Accuracy between a ring and a span, relative to that of the pairs: the errors of all spans of a ring add up.
pub(super) const SPAN_SHARE: f64 = 0.3;

/// The quadrature samples of an element for one ring, one for each bend.
#[derive(Debug, Clone)]
struct SpanQuadrature {
    /// An element of this kind.
    element: usize,
    geometry: SourceGeometry,
    samples: [Vec<StationQuadrature>; BENDS.len()],
}

/// The quadrature samples of all elements for all rings; equal ones are stored once.
#[derive(Debug, Clone)]
pub(super) struct SpanQuadratures {
    quadratures: Vec<SpanQuadrature>,
    /// Index into `quadratures` by element and ring; `None` where the ring does not act.
    places: Vec<Vec<Option<usize>>>,
}

impl SpanQuadratures {
    /// Makes the samples of elements that consist of `pieces`.
    pub(super) fn new(
        elements: &[Element],
        pieces: &[Vec<Piece<'_>>],
        rings: &[RingBody],
        settings: &Settings,
    ) -> Self {
        let mut quadratures: Vec<SpanQuadrature> = Vec::new();
        let mut place = |element: usize, body: &RingBody| {
            let geometry = source_geometry(elements, element, body, settings)?;
            let same =
                |own: &SpanQuadrature| own.geometry == geometry && pieces[own.element] == pieces[element];
            Some(quadratures.iter().position(same).unwrap_or_else(|| {
                let at =
                    |bend| elements[element].samples(&pieces[element], &SourceGeometry { bend, ..geometry });
                quadratures.push(SpanQuadrature { element, geometry, samples: BENDS.map(at) });
                quadratures.len() - 1
            }))
        };
        let places = (0..elements.len()).map(|k| rings.iter().map(|body| place(k, body)).collect()).collect();
        Self { quadratures, places }
    }

    /// The samples of an element for a ring, at a level of [`Self::level`].
    pub(super) fn samples(&self, element: usize, ring: usize, level: usize) -> &[StationQuadrature] {
        self.places[element][ring].map_or(&[], |place| &self.quadratures[place].samples[level])
    }

    /// Number of levels.
    pub(super) const LEVELS: usize = BENDS.len();

    /// The level for the bend between a ring and an element with ends at two nodes.
    pub(super) fn level(ring: &Pose, ends: [&Pose; 2]) -> usize {
        let least = ends.map(|end| ring.axis().dot(&end.axis())).into_iter().fold(1.0, f64::min);
        let bend = least.clamp(-1.0, 1.0).acos();
        BENDS.iter().position(|most| bend <= *most).unwrap_or(BENDS.len() - 1)
    }
}

/// Geometry of a ring as seen from element `k` of the straight chain, if it acts there.
fn source_geometry(
    elements: &[Element],
    k: usize,
    body: &RingBody,
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
    // An element's offset contains the ring before its start: this ring itself, or the one that it faces.
    let distance = lengths + if beyond { 0.0 } else { elements[k].offset - body.ring.length };
    acts.then(|| SourceGeometry {
        distance,
        beyond,
        bonded: body.node == k || body.node == k + 1,
        radius: body.ring.outer_radius,
        bend: 0.0,
        accuracy: SPAN_SHARE * settings.pair_accuracy,
    })
}

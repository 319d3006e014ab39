//! The discretised chain: nodes joined by elements, with rings on nodes.

use std::sync::{Arc, OnceLock};

use nalgebra::Vector3;

use crate::design::{Design, RigidShape};
use crate::error::{Error, check};
use crate::geometry::Pose;
use crate::magnetics::PairTable;
use crate::rod::{Configuration, Element, Piece, Resolution, RowTable, SourceGeometry};

use super::division::divide;
use super::guidewire::Lining;
use super::ring_body::RingBody;
use super::settings::{Interaction, Settings};
use super::span_quadrature::{SPAN_SHARE, SpanQuadratures};

/// Number of elements that share the inserted length of a shaft.
const SHAFT_ELEMENTS: usize = 16;

/// Least inserted length of a shaft, m: below it the shaft counts as this long.
const SHORTEST: f64 = 1e-9;

/// Degrees added to the setting's where rings act on spans: their field varies over less than a core.
const EXTRA_DEGREES: usize = 4;

/// Arc lengths (m) of `points` equally spaced points on a centreline of `length` (m).
///
/// # Errors
/// [`Error::Range`] for fewer than two points, the two ends.
pub(crate) fn arc_lengths(length: f64, points: usize) -> Result<impl Iterator<Item = f64>, Error> {
    check("number of shape points", points as f64, |v| (2.0..=1e5).contains(&v), "from 2 to 100000")?;
    Ok((0..points).map(move |i| length * i as f64 / (points - 1) as f64))
}

/// Nodes, elements and rings of a design.
///
/// Node 0 is the base; element `k` leads from node `k` to node `k + 1`. The frame of a node is at the proximal face of
/// its ring, or where two elements meet.
#[derive(Debug, Clone)]
pub(crate) struct Chain {
    pub(crate) elements: Vec<Element>,
    pub(crate) rings: Vec<RingBody>,
    /// Distance from the last node to the tip, m.
    pub(crate) tip_offset: f64,
    /// Place of the tip in the frame of the base, without a shaft and loads, m; `None` for a device that is straight then.
    pub(crate) tip_at_rest: Option<Vector3<f64>>,
    /// Whether all bodies are symmetric about their axes.
    pub(crate) axisymmetric: bool,
    /// Number of elements of the shaft, which come first.
    pub(crate) shaft: usize,
    /// Index of the first unknown of each element, then the number of unknowns.
    pub(crate) first: Vec<usize>,
    /// Diagonal elastic stiffness of all unknowns, for a shaft as long as its tables.
    pub(crate) metric: Vec<f64>,
    /// First and last element of each segment's core.
    pub(crate) cores: Vec<(usize, usize)>,
    /// Outer radius of each element, m: the largest of its discs and windings.
    pub(crate) radii: Vec<f64>,
    /// Length of each element's pieces, and their outer radii at the start and at the end, m.
    pub(crate) skins: Vec<Vec<(f64, [f64; 2])>>,
    /// Quadratures of the elements in the fields of the rings.
    pub(crate) span_quadratures: SpanQuadratures,
    /// Rules for pairs of rings, one table for each ring; equal rings share theirs.
    pub(crate) pair_tables: Vec<Arc<PairTable>>,
    /// The guidewire inside, if there is one.
    pub(crate) lining: Option<Lining>,
    tables: OnceLock<Vec<RowTable>>,
    made_from: (Design, Discretisation),
}

/// The settings that a chain depends on.
type Discretisation = (Interaction, usize, usize, f64, bool);

fn discretisation(settings: &Settings) -> Discretisation {
    let Settings { interaction, degree, cylinder_elements, pair_accuracy, .. } = *settings;
    (interaction, degree, cylinder_elements, pair_accuracy, settings.has_bending_stop())
}

impl Chain {
    #[cfg(feature = "methods")]
    pub(crate) fn new(design: &Design, settings: &Settings) -> Result<Self, Error> {
        Self::beside(design, settings, &[])
    }

    /// The chain of a design, with the tables of `others` as far as they have those of its rings.
    pub(crate) fn beside(design: &Design, settings: &Settings, others: &[Arc<Self>]) -> Result<Self, Error> {
        let mut rings = Vec::new();
        let shaft = design.shaft().map_or(0, |_| SHAFT_ELEMENTS);
        let mut offset = 0.0;
        for ring in design.base_rings() {
            rings.push(RingBody::new(ring, shaft, offset)?);
            offset += ring.length;
        }
        let spans = settings.interaction.acts_on_spans();
        let resolution = Resolution {
            degree: settings.degree + if spans { EXTRA_DEGREES } else { 0 },
            nearest: design.rings().next().filter(|_| spans).map(|ring| SourceGeometry {
                distance: 0.0,
                beyond: false,
                bonded: true,
                radius: ring.outer_radius,
                bend: 0.0,
                accuracy: SPAN_SHARE * settings.pair_accuracy,
            }),
            bending_stop: settings.has_bending_stop(),
            fine: settings.fine_stations,
        };
        let (mut elements, mut cores, mut chains): (Vec<Element>, _, Vec<Vec<Piece<'_>>>) =
            (Vec::new(), Vec::new(), Vec::new());
        if let Some(span) = design.shaft() {
            let pieces = vec![Piece::part(span, 0.0, span.length / shaft as f64)];
            elements = vec![
                Element::new(
                    0.0,
                    &pieces,
                    &Resolution { degree: settings.degree, nearest: None, ..resolution }
                );
                shaft
            ];
            chains = vec![pieces; shaft];
        }
        for segment in design.segments() {
            let first = elements.len();
            let before = rings.last().map(|body: &RingBody| body.ring);
            for pieces in divide(segment, before.as_ref(), settings.cylinder_elements) {
                // The segments of most designs are alike.
                let alike = elements
                    .iter()
                    .zip(&chains)
                    .find(|(own, of)| own.offset.to_bits() == offset.to_bits() && **of == pieces);
                let element =
                    alike.map_or_else(|| Element::new(offset, &pieces, &resolution), |(own, _)| own.clone());
                elements.push(element);
                chains.push(pieces);
                offset = 0.0;
            }
            cores.push((first, elements.len() - 1));
            for ring in &segment.rings {
                rings.push(RingBody::new(ring, elements.len(), offset)?);
                offset += ring.length;
            }
        }
        let mut first = vec![0];
        for element in &elements {
            first.push(first[first.len() - 1] + element.freedoms());
        }
        let metric = elements.iter().flat_map(|element| element.metric.iter().copied()).collect();
        let span_quadratures = SpanQuadratures::new(&elements, &chains, &rings, settings);
        let skins: Vec<Vec<_>> =
            chains.iter().map(|pieces| pieces.iter().map(Piece::skin).collect()).collect();
        let radii =
            skins.iter().map(|own| own.iter().flat_map(|piece| piece.1).fold(0.0, f64::max)).collect();
        let pair_tables = pair_tables(&rings, settings.pair_accuracy, others);
        let made_from = (design.clone(), discretisation(settings));
        let tip_offset = offset;
        let lining = design.guidewire().map(|wire| Lining::new(wire, &elements, shaft));
        Ok(Self {
            tip_at_rest: tip_at_rest(&elements[shaft..], tip_offset),
            elements,
            rings,
            tip_offset,
            axisymmetric: design.is_axisymmetric(),
            shaft,
            first,
            metric,
            cores,
            radii,
            skins,
            span_quadratures,
            pair_tables,
            lining,
            tables: OnceLock::new(),
            made_from,
        })
    }

    /// What it was made from.
    pub(crate) fn made_from(&self) -> &impl core::fmt::Debug {
        &self.made_from
    }

    /// Whether it is what [`Self::new`] makes of this.
    pub(crate) fn is_of(&self, design: &Design, settings: &Settings) -> bool {
        self.made_from.1 == discretisation(settings) && self.made_from.0 == *design
    }

    /// Unstrained length without the shaft, m.
    pub(crate) fn length(&self) -> f64 {
        let own = &self.elements[self.shaft..];
        own.iter().map(|element| element.offset + element.length).sum::<f64>() + self.tip_offset
    }

    /// Length of the shaft's elements relative to that of their tables, for an inserted length (m); 1 without a shaft.
    pub(crate) fn growth(&self, insertion: f64) -> f64 {
        if self.shaft == 0 { 1.0 } else { insertion.max(SHORTEST) / self.inserted(1.0) }
    }

    /// Length of the shaft (m) at that growth.
    pub(crate) fn inserted(&self, growth: f64) -> f64 {
        growth * self.elements[..self.shaft].iter().map(|element| element.length).sum::<f64>()
    }

    /// The strain modes at any arc length of each element.
    pub(crate) fn tables(&self) -> &[RowTable] {
        self.tables.get_or_init(|| self.elements.iter().map(RowTable::new).collect())
    }

    /// Writes the diagonal elastic stiffness of all unknowns for an inserted length (m).
    pub(crate) fn stiffness_at(&self, insertion: f64, metric: &mut [f64]) {
        let (growth, shaft) = (self.growth(insertion), self.first[self.shaft]);
        for (unknown, (own, stiffness)) in metric.iter_mut().zip(&self.metric).enumerate() {
            *own = if unknown < shaft { stiffness / growth } else { *stiffness };
        }
    }

    /// Radius (m) of the round end of a chain that ends without a ring.
    pub(crate) fn round_end(&self) -> Option<f64> {
        let (_, [_, end]) = self.skins.last()?.last()?;
        (self.tip_offset == 0.0).then_some(*end)
    }

    /// Number of unknowns.
    pub(crate) fn freedoms(&self) -> usize {
        self.metric.len()
    }

    /// The unknowns of one element.
    pub(crate) fn part<'a>(&self, element: usize, unknowns: &'a [f64]) -> &'a [f64] {
        &unknowns[self.first[element]..self.first[element + 1]]
    }

    /// Radian norm: elastic norm of a change that turns one element's end by one radian, the unit of steps and residuals.
    pub(crate) fn radian_norm(&self) -> f64 {
        self.elements[self.shaft..].iter().map(|element| element.metric[0]).fold(0.0, f64::max).sqrt()
    }
}

/// Place of the tip (m) of unloaded elements in the frame of the first one's start; `None` where all of them are straight.
fn tip_at_rest(elements: &[Element], tip_offset: f64) -> Option<Vector3<f64>> {
    let bent =
        |element: &Element| element.stations.iter().any(|station| station.row.rest_rate.xy().norm() > 0.0);
    if !elements.iter().any(bent) {
        return None;
    }
    let ends = elements.iter().map(|element| Configuration::straight(element).end);
    Some(ends.fold(Pose::identity(), |node, end| node.compose(&end)).advanced(tip_offset).position)
}

/// Rules for pairs of `rings` to a relative accuracy, one table for each; those that `others` have are not made again.
fn pair_tables(rings: &[RingBody], accuracy: f64, others: &[Arc<Chain>]) -> Vec<Arc<PairTable>> {
    let alike = |chain: &&Arc<Chain>| chain.made_from.1.3.to_bits() == accuracy.to_bits();
    let known: Vec<_> = others.iter().filter(alike).flat_map(|chain| &chain.pair_tables).collect();
    let mut tables: Vec<Arc<PairTable>> = Vec::new();
    for body in rings {
        let (inner, outer, length) = (body.ring.inner_radius, body.ring.outer_radius, body.ring.length);
        if body.ring.shape == RigidShape::Ball {
            tables.push(Arc::new(PairTable::of_ball(outer)));
            continue;
        }
        let axial = body.direction.is_axial();
        let equal = |table: &&Arc<PairTable>| table.is_of(inner, outer, length, axial);
        let equal = tables.iter().find(equal).or_else(|| known.iter().copied().find(equal)).cloned();
        let new = if axial { PairTable::new } else { PairTable::of_any_direction };
        tables.push(equal.unwrap_or_else(|| Arc::new(new(inner, outer, length, accuracy))));
    }
    tables
}

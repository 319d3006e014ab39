//! Interaction of rings with spans.

use nalgebra::Matrix6;

use super::super::chain::Chain;
use super::super::pair_quadrature::PairQuadrature;
use super::super::ring_field::{RingField, SectionBatch};
use super::super::settings::Interaction;
use super::super::span_quadrature::SectionSample;
use super::pair::PairLoad;
use crate::geometry::Pose;

/// All rings with all spans, except the discs bonded to their faces.
#[derive(Debug, Clone, Copy)]
pub(crate) struct RingsOnSpans<'a> {
    chain: &'a Chain,
    interaction: Interaction,
    rules: &'a PairQuadrature,
}

/// Mixed second derivative of the energy of a ring and a station: rows of the ring's node, columns of the station, in
/// fixed axes.
#[derive(Debug, Clone)]
pub(crate) struct Mixed {
    pub(crate) station: usize,
    pub(crate) node: usize,
    pub(crate) matrix: Matrix6<f64>,
}

impl<'a> RingsOnSpans<'a> {
    pub(crate) fn new(chain: &'a Chain, interaction: Interaction, rules: &'a PairQuadrature) -> Self {
        Self { chain, interaction, rules }
    }

    /// Whether rings act on spans at this level.
    pub(crate) fn act(&self) -> bool {
        self.interaction.acts_on_spans()
    }

    /// Whether spans act back on the rings.
    pub(crate) fn are_mutual(&self) -> bool {
        self.interaction == Interaction::Full
    }

    /// Ring number `ring` with its node at `node`, as a field source for spans.
    pub(crate) fn source(&self, ring: usize, node: &Pose) -> RingField<'a> {
        RingField::new(&self.chain.rings[ring], node)
    }

    /// The quadrature samples of an element for a ring, and whether multipoles are too inaccurate for all of them.
    pub(crate) fn samples(&self, element: usize, ring: usize) -> (&'a [SectionSample], bool) {
        self.chain.span_quadratures.samples(element, ring, self.rules.span(element, ring))
    }

    /// The energy of a ring with its node at `node` and of a section of `batch` as loads on both, after
    /// [`Source::on_samples`].
    pub(crate) fn load(source: &RingField<'_>, node: &Pose, batch: &SectionBatch, number: usize) -> PairLoad {
        let (axes, centre) = (source.axes(), source.centre() - node.position);
        let (load, section) = (&batch.loads[number], &batch.sections[number]);
        PairLoad::reciprocal(&load.in_axes(&axes.transpose()), centre + axes * section.position)
    }
}

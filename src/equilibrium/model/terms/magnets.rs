//! All magnets and coils near the chain.

use nalgebra::Vector3;

use super::super::chain::Chain;
use super::super::inputs::Inputs;
use super::super::pair_quadrature::PairQuadrature;
use super::super::source_field::StationFields;
use super::magnet::Magnet;
use crate::geometry::Pose;
use crate::magnetics::Sources;
use crate::rod::{Order, Station};

/// Each source as a term of its own, by its number.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Magnets<'a>([Option<Magnet<'a>>; Sources::MOST]);

impl<'a> Magnets<'a> {
    pub(crate) fn new(sources: &'a Sources, inputs: &'a Inputs, rules: &'a PairQuadrature) -> Self {
        let mut all = [None; Sources::MOST];
        for (number, (kind, slot)) in sources.list().iter().zip(&mut all).enumerate() {
            *slot = Magnet::new((number, kind), inputs, rules);
        }
        Self(all)
    }

    /// The sources for a chain whose sections are sampled as coarsely as this relative accuracy of the energies allows.
    pub(crate) fn seen_by(self, chain: &Chain, accuracy: f64) -> Self {
        Self(self.0.map(|source| source.map(|source| source.seen_by(chain, accuracy))))
    }

    /// The sources that are there.
    pub(crate) fn each(&self) -> impl Iterator<Item = &Magnet<'a>> {
        self.0.iter().flatten()
    }

    /// The sources without those that are switched off: as if they could not be switched on.
    pub(crate) fn without_idle(self) -> Self {
        Self(self.0.map(|source| source.filter(Magnet::is_on)))
    }

    /// Evaluates the field of each at the material of `stations` at their poses; `None` inside one.
    pub(crate) fn fields_at<'s>(
        &self,
        stations: &(impl Iterator<Item = (&'s Station, Pose)> + Clone),
        order: Order,
        out: &mut [StationFields],
    ) -> Option<()> {
        self.each()
            .try_for_each(|source| source.fields_at(stations.clone(), order, &mut out[source.number()]))
    }

    /// Their field (T) at a point in the world frame; `None` inside one.
    pub(crate) fn at(&self, point: &Vector3<f64>) -> Option<Vector3<f64>> {
        self.each().try_fold(Vector3::zeros(), |sum, source| Some(sum + source.at(point)?))
    }
}

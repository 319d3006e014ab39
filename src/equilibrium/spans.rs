//! Rings acting on spans, and spans back on rings.

use nalgebra::{Matrix3, Matrix6};

use super::pair::{Mixed, PairLoad, blocks};
use super::potential::Potential;
use super::settings::Interaction;
use super::source::Source;
use crate::rod::Order;

impl Potential<'_> {
    /// Adds the energies of all rings with all spans to the loads; their sum.
    pub(super) fn load_spans(&mut self, order: Order) -> Option<f64> {
        if !self.settings.interaction.acts_on_spans() {
            return Some(0.0);
        }
        let mutual = self.settings.interaction == Interaction::Full;
        let mut energy = 0.0;
        for k in 0..self.chain.elements.len() {
            self.work.mixed[k].clear();
            let start = self.work.nodes[k];
            for (ring, body) in self.chain.rings.iter().enumerate() {
                let node = self.work.nodes[body.node];
                let source = Source::ring(body, &node, self.tabulated);
                for sample in self.chain.views.samples(k, ring, self.rules.span(k, ring)) {
                    let pose = self.work.station(k, sample.station);
                    let load = source.on_sample(sample, &pose, order)?.in_axes(&source.axes().transpose());
                    energy += load.energy;
                    self.work.internal.stations[k][sample.station] += load.in_axes(&start.rotation);
                    let pair = PairLoad::reciprocal(&load, pose.position - node.position);
                    if mutual {
                        self.work.internal.nodes[body.node] += pair.on_first.wrench_alone();
                    }
                    if order == Order::Hessian && body.node > 0 {
                        let second = pair.hessian();
                        if mutual {
                            self.add_block(body.node, body.node, &second.first_first);
                        }
                        let (station, matrix) = (sample.station, second.first_second);
                        self.work.mixed[k].push(Mixed { station, node: body.node, matrix });
                    }
                }
            }
        }
        Some(energy)
    }

    /// Columns of the rings' nodes beside the Hessian of element `k`.
    pub(super) fn mix(&mut self, k: usize) {
        let element = &self.chain.elements[k];
        let axes = self.work.nodes[k].rotation;
        let zero = Matrix3::zeros();
        let turn: Matrix6<f64> = blocks(&axes, &zero, &zero, &axes);
        let cross = &mut self.work.cross[k];
        cross.fill(0.0);
        let tangent = &mut self.work.tangents[k];
        let size = tangent.size;
        let mixed = &mut self.work.mixed[k];
        mixed.sort_unstable_by_key(|mixed| mixed.station);
        for own in mixed.chunk_by(|a, b| a.station == b.station) {
            let station = own[0].station;
            let motion =
                tangent.station_motion(element, station, &self.work.configurations[k].stations[station]);
            for mixed in own {
                let pull = mixed.matrix * turn;
                for (row, target) in
                    cross[6 * (mixed.node - 1) * size..].chunks_exact_mut(size).take(6).enumerate()
                {
                    for (column, moved) in motion.chunks_exact(size).enumerate() {
                        let factor = pull[(row, column)];
                        target.iter_mut().zip(moved).for_each(|(entry, value)| *entry += factor * value);
                    }
                }
            }
        }
    }
}

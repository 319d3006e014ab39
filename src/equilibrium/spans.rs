//! Rings acting on spans, and spans back on rings.

use nalgebra::{Vector3, Vector6};

use super::chain::Chain;
use super::pair::{Mixed, PairLoad};
use super::potential::Potential;
use super::settings::Interaction;
use super::source::Source;
use crate::rod::{Order, Station, Tangent};

/// Whether the ring at `node` acts on a station of `element`.
fn acts(chain: &Chain, level: Interaction, node: usize, element: usize, station: &Station) -> bool {
    let table = &chain.elements[element];
    match level {
        Interaction::None | Interaction::Rings => false,
        Interaction::Preceding => node <= element && !(node == element && table.bonded(station, false)),
        Interaction::Full => {
            let before = node == element && table.bonded(station, false);
            let after = node == element + 1 && table.bonded(station, true);
            !before && !after
        }
    }
}

impl Potential<'_> {
    /// Adds the energies of all rings with all stations to the loads; their sum.
    pub(super) fn load_spans(&mut self, order: Order) -> Option<f64> {
        let level = self.settings.interaction;
        let mutual = level == Interaction::Full;
        self.work.mixed.clear();
        if !level.acts_on_spans() {
            return Some(0.0);
        }
        let mut energy = 0.0;
        for (k, element) in self.chain.elements.iter().enumerate() {
            let start = self.work.nodes[k];
            for (index, station) in element.stations.iter().enumerate() {
                let pose = self.work.station(k, index);
                for body in &self.chain.rings {
                    if !acts(self.chain, level, body.node, k, station) {
                        continue;
                    }
                    let node = self.work.nodes[body.node];
                    let source = Source::ring(body, &node);
                    let load = match gap(body.node, k) {
                        0 => source.on_points(&station.sections[0], station.matter.magnetisation, &pose, order)?,
                        1 => source.on_points(&station.sections[1], station.matter.magnetisation, &pose, order)?,
                        _ => source.on_matter(&station.matter, &pose, order)?,
                    };
                    let load = load.in_axes(&source.axes().transpose());
                    energy += load.energy;
                    self.work.station_loads[k][index] += load.in_axes(&start.rotation);
                    let pair = PairLoad::reciprocal(&load, pose.position - node.position);
                    if mutual {
                        self.work.node_loads[body.node] += pair.on_first.wrench_alone();
                    }
                    if order == Order::Hessian && body.node > 0 {
                        let second = pair.hessian();
                        if mutual {
                            self.add_block(body.node, body.node, &second.first_first);
                        }
                        let matrix = second.first_second;
                        self.work.mixed.push(Mixed { element: k, station: index, node: body.node, matrix });
                    }
                }
            }
        }
        Some(energy)
    }

    /// Columns of the rings' nodes beside the Hessian of element `k`.
    pub(super) fn mix(&mut self, k: usize) {
        let element = &self.chain.elements[k];
        let columns = 6 * self.chain.elements.len();
        let axes = self.work.nodes[k].rotation;
        let cross = &mut self.work.cross[k];
        cross.fill(0.0);
        let tangent: &mut Tangent = &mut self.work.tangents[k];
        for mixed in self.work.mixed.iter().filter(|mixed| mixed.element == k) {
            let state = &self.work.configurations[k].stations[mixed.station];
            let size = tangent.size;
            let motion = tangent.station_motion(element, mixed.station, state);
            for row in 0..size {
                let along = |first: usize| Vector3::from_fn(|k, _| motion[(first + k) * size + row]);
                let (position, rotation) = (axes * along(0), axes * along(3));
                let moved =
                    Vector6::new(position.x, position.y, position.z, rotation.x, rotation.y, rotation.z);
                let pulled = mixed.matrix * moved;
                let target = &mut cross[row * columns + 6 * (mixed.node - 1)..][..6];
                for (entry, value) in target.iter_mut().zip(pulled.iter()) {
                    *entry += value;
                }
            }
        }
    }
}

/// Segments between a ring and an element.
pub(super) fn gap(node: usize, element: usize) -> usize {
    if node <= element { element - node } else { node - element - 1 }
}

//! All loads on the chain at one shape, summed over frames and pairs.

use nalgebra::{Matrix3, Matrix6};

use super::pair_loads::Made;
use super::potential::Potential;
use super::source_field::StationFields;
use super::terms::{Frame, Mixed, NearStation, RingsOnSpans, TermWrenches, blocks};
use crate::geometry::hat;
use crate::numerics::dense;
use crate::rod::{Load, Order, PlacedCoupling, PlacedLoad};

impl Potential<'_> {
    /// Places the chain and sums all loads; returns the energy, or `None` where bodies touch.
    pub(crate) fn load(&mut self, unknowns: &[f64], order: Order) -> Option<f64> {
        let hessian = order == Order::Hessian;
        self.work.place(self.chain, self.inputs, unknowns);
        let mut energy = 0.0;
        for (k, element) in self.chain.elements.iter().enumerate() {
            energy += self.work.configurations[k].elastic_energy(element, self.chain.part(k, unknowns));
        }

        self.work.wrenches = TermWrenches::none();
        energy += self.load_stations(order)? + self.load_stops(unknowns);
        self.load_nodes(order)?;
        self.work.on_nodes_around.clear();
        if let Some(around) = &mut self.around {
            energy += around.load(self.chain, self.inputs, unknowns, self.work);
        }

        if hessian {
            self.work.node_hessian.fill(0.0);
        }
        energy += self.add_pair_loads(unknowns, order)?;
        for node in 1..self.work.node_loads.len() {
            let load = &self.work.node_loads[node];
            if hessian {
                let own = blocks(
                    &load.position_position,
                    &load.position_rotation,
                    &load.position_rotation.transpose(),
                    &load.rotation_hessian(),
                );
                self.add_block(node, node, &own);
            }
        }
        energy += self.work.node_loads.iter().map(|load| load.energy).sum::<f64>();
        energy.is_finite().then_some(energy)
    }

    fn load_stations(&mut self, order: Order) -> Option<f64> {
        let mut fields = std::mem::take(&mut self.work.fields);
        let energy = self.load_stations_in(&mut fields, order);
        self.work.fields = fields;
        energy
    }

    /// Loads of all stations, with the storage for the fields of the sources.
    fn load_stations_in(&mut self, fields: &mut [StationFields], order: Order) -> Option<f64> {
        let (mut energy, base) = (0.0, self.inputs.base.position);
        let stations = self.chain.elements.iter().enumerate().flat_map(|(k, element)| {
            let work = &*self.work;
            element.stations.iter().enumerate().map(move |(index, station)| (station, work.station(k, index)))
        });
        self.terms.magnets.fields_at(&stations, order, fields)?;
        let mut number = 0;
        for (k, element) in self.chain.elements.iter().enumerate() {
            let axes = self.work.nodes[k].rotation;
            for (index, station) in element.stations.iter().enumerate() {
                let near = NearStation { fields, station: number };
                number += 1;
                let (frame, pose) = (Frame::Station(station, near), self.work.station(k, index));
                let load = if k < self.chain.shaft {
                    // The inserted part of a shaft is as heavy as it is long.
                    let mut inserted = TermWrenches::none();
                    let load = self.terms.load(&frame, &pose, &axes, order, (&base, &mut inserted))?;
                    self.work.wrenches.add(&inserted, self.work.growth);
                    load.times(self.work.growth)
                } else {
                    self.terms.load(&frame, &pose, &axes, order, (&base, &mut self.work.wrenches))?
                };
                energy += load.energy;
                self.work.station_loads[k][index] = load;
            }
        }
        Some(energy)
    }

    /// Loads the ends of all cores whose windings touch; returns the energy of their contact.
    fn load_stops(&mut self, unknowns: &[f64]) -> f64 {
        let (mut energy, work) = (0.0, &mut *self.work);
        for (k, element) in self.chain.elements.iter().enumerate() {
            let placed = &mut work.placed_loads[k];
            placed.clear();
            let Some(stop) = self.terms.stops.of(element) else { continue };
            let amplitudes = self.chain.part(k, unknowns);
            let configuration = &work.configurations[k];
            let tangents = element.core_ends.each_ref().map(|row| {
                configuration.rotation_at(element, row, amplitudes).matrix().column(2).into_owned()
            });
            let Some(stop) = stop.loads(&tangents) else { continue };
            for (row, load) in element.core_ends.iter().zip(stop.loads) {
                energy += load.energy;
                let frame = work.configurations[k].frame_at(element, row, amplitudes);
                placed.loads.push(PlacedLoad { row: row.clone(), frame, load });
            }
            let zero = Matrix3::zeros();
            let matrix = blocks(&zero, &zero, &zero, &stop.mixed);
            placed.couplings.push(PlacedCoupling { between: [0, 1], matrix });
            placed.abrupt = stop.stiffness;
            placed.own = placed.loads.len();
        }
        energy
    }

    fn load_nodes(&mut self, order: Order) -> Option<()> {
        let (axes, base) = (Matrix3::identity(), self.inputs.base.position);
        self.work.node_loads.fill(Load::zero());
        for (node, frame) in Frame::at_nodes(self.chain) {
            let pose = self.work.nodes[node];
            let about = (&base, &mut self.work.wrenches);
            self.work.node_loads[node] += self.terms.load(&frame, &pose, &axes, order, about)?;
        }
        Some(())
    }

    /// Adds the loads of rings on rings and on spans; returns their energy, or `None` where bodies touch.
    ///
    /// The first step after a change of the inputs starts from the shape of the last solve, whose pair loads are reused.
    pub(crate) fn add_pair_loads(&mut self, unknowns: &[f64], order: Order) -> Option<f64> {
        let (placed, rules) = ((self.work.nodes[0], self.work.growth), self.rules.number());
        let kept = self.work.pair_loads.at(unknowns, placed, rules);
        let kept = kept.filter(|_| order == Order::Gradient);
        let energy = if let Some(energy) = kept {
            energy
        } else {
            let pair_loads = &mut self.work.pair_loads;
            pair_loads.made = None;
            pair_loads.nodes.fill(Load::zero());
            pair_loads.stations.iter_mut().for_each(|loads| loads.fill(Load::zero()));
            let energy = self.load_ring_pairs(order)? + self.load_rings_on_spans(order)?;
            let pair_loads = &mut self.work.pair_loads;
            pair_loads.made = Some(Made { energy, rules });
            pair_loads.placed = placed;
            pair_loads.unknowns.copy_from_slice(unknowns);
            energy
        };

        let work = &mut *self.work;
        let stations = work.station_loads.iter_mut().flatten().zip(work.pair_loads.stations.iter().flatten());
        for (load, own) in stations.chain(work.node_loads.iter_mut().zip(&work.pair_loads.nodes)) {
            *load += *own;
        }
        Some(energy)
    }

    /// Adds all pairs of rings to the stored loads; returns the sum of their energies.
    fn load_ring_pairs(&mut self, order: Order) -> Option<f64> {
        let (pairs, mut energy) = (self.terms.pairs, 0.0);
        let mutual = pairs.are_mutual();
        for numbers in pairs.each() {
            let [first, second] = numbers.map(|number| self.chain.rings[number].node);
            let load = pairs.load(numbers, [&self.work.nodes[first], &self.work.nodes[second]], order)?;
            energy += load.on_second.energy;
            self.work.pair_loads.nodes[second] += load.on_second.wrench_alone();
            if mutual {
                self.work.pair_loads.nodes[first] += load.on_first.wrench_alone();
            }
            if order == Order::Hessian {
                let pair = load.hessian();
                self.add_block(second, second, &pair.second_second);
                self.add_block(second, first, &pair.first_second.transpose());
                if mutual {
                    self.add_block(first, first, &pair.first_first);
                    self.add_block(first, second, &pair.first_second);
                }
            }
        }
        Some(energy)
    }

    /// Adds all rings with all spans to the stored loads; returns the sum of their energies.
    fn load_rings_on_spans(&mut self, order: Order) -> Option<f64> {
        if !self.terms.spans.act() {
            return Some(0.0);
        }
        let each =
            if order == Order::Hessian { Self::load_ring_on_span } else { Self::load_ring_on_span_slope };
        let mut energy = 0.0;
        for k in 0..self.chain.elements.len() {
            self.work.mixed[k].clear();
            for ring in 0..self.chain.rings.len() {
                energy += each(self, k, ring)?;
            }
        }
        Some(energy)
    }

    /// Adds ring number `ring` with element `k` without second derivatives; returns the energy.
    fn load_ring_on_span_slope(&mut self, k: usize, ring: usize) -> Option<f64> {
        let (spans, body) = (self.terms.spans, &self.chain.rings[ring]);
        let (samples, near) = spans.samples(k, ring);
        let work = &mut *self.work;
        let source = spans.source(ring, &work.nodes[body.node]);
        let element = (&work.nodes[k], &work.configurations[k].stations[..]);
        let stations = &mut work.pair_loads.stations[k];
        let (energy, force, moment) = source.add_on_samples(samples, near, element, stations)?;
        if spans.are_mutual() {
            let load = &mut work.pair_loads.nodes[body.node];
            load.force += force;
            load.couple += hat(&moment) * 0.5;
        }
        Some(energy)
    }

    /// Load of a ring on a span, with second derivatives.
    fn load_ring_on_span(&mut self, k: usize, ring: usize) -> Option<f64> {
        let (spans, body, mut energy) = (self.terms.spans, &self.chain.rings[ring], 0.0);
        let mutual = spans.are_mutual();
        let node = self.work.nodes[body.node];
        let axes = self.work.nodes[k].rotation;
        let source = spans.source(ring, &node);
        let (samples, near) = spans.samples(k, ring);
        let work = &mut *self.work;
        let element = (&work.nodes[k], &work.configurations[k].stations[..]);
        source.on_samples(samples, near, element, &mut work.batch)?;

        for (number, sample) in samples.iter().enumerate() {
            let (station, work) = (sample.station, &mut *self.work);
            let load = RingsOnSpans::load(&source, &node, &work.batch, number);
            energy += load.on_second.energy;
            work.pair_loads.stations[k][station] += load.on_second.in_axes(&axes);
            if mutual {
                work.pair_loads.nodes[body.node] += load.on_first.wrench_alone();
            }
            // The base does not move.
            if body.node > 0 {
                let second = load.hessian();
                if mutual {
                    self.add_block(body.node, body.node, &second.first_first);
                }
                let matrix = second.first_second;
                self.work.mixed[k].push(Mixed { station, node: body.node, matrix });
            }
        }
        Some(energy)
    }

    /// Computes the mixed derivatives of element `k` and the rings' nodes.
    pub(crate) fn mix(&mut self, k: usize) {
        let element = &self.chain.elements[k];
        let axes = self.work.nodes[k].rotation;
        let zero = Matrix3::zeros();
        let turn: Matrix6<f64> = blocks(&axes, &zero, &zero, &axes);
        let cross = &mut self.work.cross[k];
        cross.fill(0.0);
        let tangent = &mut self.work.derivatives[k];
        let size = tangent.size;
        let mixed = &mut self.work.mixed[k];
        mixed.sort_unstable_by_key(|mixed| mixed.station);
        for own in mixed.chunk_by(|a, b| a.station == b.station) {
            let station = own[0].station;
            let motion =
                tangent.station_motion(element, station, &self.work.configurations[k].stations[station]);
            for mixed in own {
                // Matrices are stored by column, those of `dense` by row.
                let pull = (mixed.matrix * turn).transpose();
                let target = &mut cross[6 * (mixed.node - 1) * size..][..6 * size];
                dense::add_product(pull.as_slice(), motion, 6, size, target);
            }
        }
    }

    /// Adds a block between two nodes to the Hessian of the nodes, which leaves out the base (node 0).
    pub(crate) fn add_block(&mut self, row: usize, column: usize, block: &Matrix6<f64>) {
        let (Some(row), Some(column)) = (row.checked_sub(1), column.checked_sub(1)) else { return };
        let size = 6 * self.chain.elements.len();
        for i in 0..6 {
            for j in 0..6 {
                self.work.node_hessian[(6 * row + i) * size + 6 * column + j] += block[(i, j)];
            }
        }
    }
}

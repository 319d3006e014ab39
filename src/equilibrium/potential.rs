//! The potential of the whole chain, with exact gradient and Hessian.

use nalgebra::{Matrix3, Vector3};

use super::chain::Chain;
use super::dead::{add_wrench, no_wrench, weight};
use super::inputs::Inputs;
use super::pair::{PairLoad, blocks, overlap};
use super::reduction::{Reduction, turn_nodes};
use super::rules::PairRules;
use super::settings::{Interaction, Settings};
use super::source::Source;
use crate::geometry::Pose;
use crate::magnetics::Wrench;
use crate::numerics::cholesky;
use crate::numerics::trust_region::Objective;
use crate::rod::{Configuration, Load, Order, Tangent};

/// Everything that an evaluation overwrites; kept between solves so that none allocates.
#[derive(Debug, Clone)]
pub(super) struct Workspace {
    pub(super) configurations: Vec<Configuration>,
    pub(super) nodes: Vec<Pose>,
    station_loads: Vec<Vec<Load>>,
    pub(super) node_loads: Vec<Load>,
    /// External magnetic force, and torque about the base position.
    pub(super) magnetic: Wrench,
    /// Derivative of the energy by the clamped base: force and moment that the clamp exerts.
    pub(super) base: (Vector3<f64>, Vector3<f64>),
    tangents: Vec<Tangent>,
    reductions: Vec<Reduction>,
    gradient: Vec<f64>,
    node_hessian: Vec<f64>,
    factor: Vec<f64>,
    /// Whether `factor` and the reductions hold a factorisation, of this shape or an earlier one.
    pub(super) factored: bool,
    /// Axes of the elements' start nodes in that factorisation.
    axes: Vec<Matrix3<f64>>,
    rhs: Vec<f64>,
}

impl Workspace {
    pub(super) fn new(chain: &Chain) -> Self {
        let count = chain.elements.len();
        let size = 6 * count;
        Self {
            configurations: chain.elements.iter().map(Configuration::straight).collect(),
            nodes: vec![Pose::identity(); count + 1],
            station_loads: chain.elements.iter().map(|e| vec![Load::zero(); e.stations.len()]).collect(),
            node_loads: vec![Load::zero(); count + 1],
            magnetic: no_wrench(),
            base: (Vector3::zeros(), Vector3::zeros()),
            tangents: chain.elements.iter().map(Tangent::new).collect(),
            reductions: chain.elements.iter().map(|e| Reduction::new(e.freedoms())).collect(),
            gradient: vec![0.0; chain.freedoms()],
            node_hessian: vec![0.0; size * size],
            factor: vec![0.0; size * size],
            factored: false,
            axes: vec![Matrix3::identity(); count],
            rhs: vec![0.0; size],
        }
    }

    /// Places all stations and nodes for the given base and unknowns.
    pub(super) fn place(&mut self, chain: &Chain, base: &Pose, unknowns: &[f64]) {
        self.nodes[0] = *base;
        for (k, element) in chain.elements.iter().enumerate() {
            self.configurations[k].update(element, chain.part(k, unknowns));
            let end = self.configurations[k].end;
            let start = self.nodes[k];
            self.nodes[k + 1] =
                Pose { position: start.transform(&end.position), rotation: start.rotation * end.rotation };
        }
    }
}

/// The potential at given inputs.
#[derive(Debug)]
pub(super) struct Potential<'a> {
    pub(super) chain: &'a Chain,
    pub(super) settings: &'a Settings,
    pub(super) inputs: &'a Inputs,
    pub(super) field: Source<'a>,
    pub(super) rules: &'a PairRules,
    pub(super) work: &'a mut Workspace,
}

impl Potential<'_> {
    /// Computes the gradient at `x` alone, and keeps the last factorisation; the energy.
    pub(super) fn slope(&mut self, x: &[f64]) -> Option<f64> {
        let energy = self.load(x, Order::Gradient)?;
        self.backward(x, Order::Gradient).then_some(energy)
    }

    /// Places the chain and adds up all loads; the energy, or `None` where something touches.
    fn load(&mut self, unknowns: &[f64], order: Order) -> Option<f64> {
        let hessian = order == Order::Hessian;
        self.work.place(self.chain, &self.inputs.base, unknowns);
        let mut energy = 0.0;
        for (k, element) in self.chain.elements.iter().enumerate() {
            energy += self.work.configurations[k].elastic_energy(element, self.chain.part(k, unknowns));
        }
        self.work.magnetic = no_wrench();
        energy += self.load_stations(order)?;
        self.work.node_loads.fill(Load::zero());
        self.load_rings(order)?;
        if hessian {
            self.work.node_hessian.fill(0.0);
        }
        energy += self.load_pairs(order)?;
        self.load_tip();
        for (node, load) in self.work.node_loads.iter().enumerate().skip(1) {
            if hessian {
                let own = blocks(
                    &load.position_position,
                    &load.position_rotation,
                    &load.position_rotation.transpose(),
                    &load.rotation_hessian(),
                );
                add_block(&mut self.work.node_hessian, self.chain.elements.len(), node, node, &own);
            }
        }
        energy += self.work.node_loads.iter().map(|load| load.energy).sum::<f64>();
        energy.is_finite().then_some(energy)
    }

    fn load_stations(&mut self, order: Order) -> Option<f64> {
        let mut energy = 0.0;
        let gravity = self.inputs.gravity;
        for (k, element) in self.chain.elements.iter().enumerate() {
            let start = self.work.nodes[k];
            for (index, station) in element.stations.iter().enumerate() {
                let state = &self.work.configurations[k].stations[index];
                let pose = Pose {
                    position: start.transform(&state.position),
                    rotation: start.rotation * state.directors,
                };
                let magnetic = self.field.on_station(station, &pose, order)?;
                let axes = self.field.axes();
                let arm = pose.position - self.inputs.base.position;
                let (force, moment) = (axes * magnetic.force, axes * magnetic.moment());
                add_wrench(&mut self.work.magnetic, &force, &moment, &arm);
                let mut load = magnetic.in_axes(&axes.tr_mul(&start.rotation));
                if gravity != Vector3::zeros() {
                    load += weight(station, &pose, &gravity).in_axes(&start.rotation);
                }
                energy += load.energy;
                self.work.station_loads[k][index] = load;
            }
        }
        Some(energy)
    }

    fn load_rings(&mut self, order: Order) -> Option<()> {
        for (index, (body, force)) in self.chain.rings.iter().zip(&self.inputs.ring_forces).enumerate() {
            let node = self.work.nodes[body.node];
            let arm = node.axis() * (0.5 * body.ring.length);
            let dead = force + self.inputs.gravity * body.ring.mass;
            let reach = self.field.distance(&(node.position + arm));
            let rule = self.rules.external(index, reach);
            let magnetic = self.field.on_ring(body, &node, rule, order)?;
            let lever = node.position - self.inputs.base.position;
            add_wrench(&mut self.work.magnetic, &magnetic.force, &magnetic.moment(), &lever);
            let load = &mut self.work.node_loads[body.node];
            *load += magnetic;
            *load += Load::dead_force(&dead, &node.position, &arm);
        }
        Some(())
    }

    fn load_pairs(&mut self, order: Order) -> Option<f64> {
        if self.settings.interaction == Interaction::None {
            return Some(0.0);
        }
        let mut energy = 0.0;
        let mut number = 0;
        let count = self.chain.elements.len();
        for (i, first) in self.chain.rings.iter().enumerate() {
            for (j, second) in self.chain.rings.iter().enumerate().skip(i + 1) {
                let (from, to) = (&self.work.nodes[first.node], &self.work.nodes[second.node]);
                let rule = self.rules.pair(number, j);
                number += 1;
                if overlap(first, from, second, to) {
                    return None;
                }
                let pair = PairLoad::new(first, from, second, to, rule, order)?;
                energy += pair.on_second.energy;
                for (node, load) in [(first.node, &pair.on_first), (second.node, &pair.on_second)] {
                    let target = &mut self.work.node_loads[node];
                    *target += Load { force: load.force, couple: Matrix3::zeros(), ..Load::zero() };
                    // The turning of the couple is in the pair's own second derivatives.
                    target.couple += antisymmetric(&load.couple);
                }
                if order == Order::Hessian {
                    let pair = pair.hessian();
                    let matrix = &mut self.work.node_hessian;
                    add_block(matrix, count, first.node, first.node, &pair.first_first);
                    add_block(matrix, count, second.node, second.node, &pair.second_second);
                    add_block(matrix, count, first.node, second.node, &pair.first_second);
                    add_block(matrix, count, second.node, first.node, &pair.first_second.transpose());
                }
            }
        }
        Some(energy)
    }

    fn load_tip(&mut self) {
        let last = self.chain.elements.len();
        let node = self.work.nodes[last];
        let arm = node.axis() * self.chain.tip_offset;
        let load = &mut self.work.node_loads[last];
        *load += Load::dead_force(&self.inputs.tip_force, &node.position, &arm);
        load.couple += crate::geometry::hat(&self.inputs.tip_moment) * -0.5;
    }

    /// Gradient and element Hessians, from the tip to the base.
    fn backward(&mut self, unknowns: &[f64], order: Order) -> bool {
        let mut force = Vector3::zeros();
        let mut moment = Vector3::zeros();
        for (k, element) in self.chain.elements.iter().enumerate().rev() {
            let load = &self.work.node_loads[k + 1];
            force += load.force;
            moment += load.moment();
            let axes = self.work.nodes[k].rotation;
            let tangent = &mut self.work.tangents[k];
            tangent.assemble(
                element,
                &self.work.configurations[k],
                self.chain.part(k, unknowns),
                &self.work.station_loads[k],
                (&axes.tr_mul(&force), &axes.tr_mul(&moment)),
                order,
            );
            let g = &tangent.gradient;
            force = axes * Vector3::new(g[0], g[1], g[2]);
            moment = axes * Vector3::new(g[3], g[4], g[5]);
            self.work.gradient[self.chain.first[k]..self.chain.first[k + 1]].copy_from_slice(&g[6..]);
            let linear = order == Order::Gradient
                || self.work.reductions[k].linearise(&self.work.configurations[k], &self.work.tangents[k]);
            if !linear {
                return false;
            }
        }
        let base = &self.work.node_loads[0];
        self.work.base = (force + base.force, moment + base.moment());
        self.work.gradient.iter().all(|entry| entry.is_finite())
    }
}

impl Objective for Potential<'_> {
    fn value(&mut self, x: &[f64]) -> Option<f64> {
        self.load(x, Order::Gradient)
    }

    fn linearise(&mut self, x: &[f64]) -> Option<f64> {
        self.work.factored = false;
        let energy = self.load(x, Order::Hessian)?;
        self.backward(x, Order::Hessian).then_some(energy)
    }

    fn gradient(&self) -> &[f64] {
        &self.work.gradient
    }

    fn factorise(&mut self, shift: f64) -> bool {
        let work = &mut *self.work;
        let size = 6 * self.chain.elements.len();
        work.factored = false;
        work.factor.copy_from_slice(&work.node_hessian);
        for (k, reduction) in work.reductions.iter_mut().enumerate() {
            if !reduction.condense(&work.tangents[k], &self.chain.elements[k].metric, shift) {
                return false;
            }
            let axes = work.nodes[k].rotation;
            for i in 0..4 {
                for j in 0..4 {
                    // The first six rows are the base's where the element starts there.
                    let (Some(row), Some(column)) =
                        ((6 * k + 3 * i).checked_sub(6), (6 * k + 3 * j).checked_sub(6))
                    else {
                        continue;
                    };
                    let part = Matrix3::from_fn(|a, b| reduction.condensed[3 * i + a][3 * j + b]);
                    let turned = axes * part * axes.transpose();
                    for a in 0..3 {
                        for b in 0..3 {
                            work.factor[(row + a) * size + column + b] += turned[(a, b)];
                        }
                    }
                }
            }
        }
        // Solves turn into the axes in which this factor was made, wherever the chain moves afterwards.
        work.axes.iter_mut().zip(&work.nodes).for_each(|(axes, node)| *axes = node.rotation);
        work.factored = cholesky::factorise(&mut work.factor, size);
        work.factored
    }

    fn solve(&mut self, x: &mut [f64]) {
        let work = &mut *self.work;
        work.rhs.fill(0.0);
        for (k, reduction) in work.reductions.iter().enumerate() {
            let mut nodes = reduction.eliminate(&mut x[self.chain.first[k]..self.chain.first[k + 1]]);
            turn_nodes(&work.axes[k], &mut nodes);
            for (i, value) in nodes.iter().enumerate() {
                if let Some(row) = (6 * k + i).checked_sub(6) {
                    work.rhs[row] += value;
                }
            }
        }
        cholesky::solve(&work.factor, work.rhs.len(), &mut work.rhs);
        for (k, reduction) in work.reductions.iter().enumerate() {
            let mut nodes =
                core::array::from_fn(|i| (6 * k + i).checked_sub(6).map_or(0.0, |row| work.rhs[row]));
            turn_nodes(&work.axes[k].transpose(), &mut nodes);
            reduction.recover(&nodes, &mut x[self.chain.first[k]..self.chain.first[k + 1]]);
        }
    }

    fn metric(&self) -> &[f64] {
        &self.chain.metric
    }
}

/// The part of a couple that is a moment.
fn antisymmetric(couple: &Matrix3<f64>) -> Matrix3<f64> {
    (couple - couple.transpose()) * 0.5
}

/// Adds a block between two nodes; the base's (node 0) is left out.
fn add_block(matrix: &mut [f64], elements: usize, row: usize, column: usize, block: &nalgebra::Matrix6<f64>) {
    if row == 0 || column == 0 {
        return;
    }
    for i in 0..6 {
        for j in 0..6 {
            matrix[(6 * (row - 1) + i) * 6 * elements + 6 * (column - 1) + j] += block[(i, j)];
        }
    }
}

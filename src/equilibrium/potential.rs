//! The potential of the whole chain, with exact gradient and Hessian.

use nalgebra::{Matrix3, Matrix6, Vector3};

use super::chain::Chain;
use super::condensation::Condensation;
use super::factorisation::{Factorisation, Linearisation};
use super::inputs::Inputs;
use super::pair_loads::PairLoads;
use super::rules::PairRules;
use super::settings::Settings;
use super::terms::{Frame, Mixed, TermWrenches, Terms, blocks};
use crate::geometry::Pose;
use crate::numerics::arnoldi::smallest_real_part;
use crate::numerics::eigenvalue::{Lanczos, Search};
use crate::numerics::trust_region::{Objective, spread};
use crate::rod::{Configuration, Load, Order, START, Tangent};

/// Residual from which on tables may stand: smaller ones are asked for by those who take differences, which jumps spoil.
const TABLE_RESIDUAL: f64 = 5e-8;

/// Arnoldi vectors for the eigenvalues of a matrix that is not symmetric.
const ARNOLDI: usize = 48;

/// The look at the margin when it is asked for.
pub(super) const THOROUGH: Search = Search { vectors: 120, settled: 1e-6 };

/// Everything that an evaluation overwrites; kept between solves so that none allocates.
#[derive(Debug, Clone)]
pub(super) struct Workspace {
    pub(super) configurations: Vec<Configuration>,
    pub(super) nodes: Vec<Pose>,
    /// The unknowns for which they are placed; not a number before the first ones.
    pub(super) placed: Vec<f64>,
    pub(super) station_loads: Vec<Vec<Load>>,
    pub(super) node_loads: Vec<Load>,
    pub(super) pair_loads: PairLoads,
    pub(super) wrenches: TermWrenches,
    /// Derivative of the energy by the clamped base: force and moment that the clamp exerts.
    pub(super) base: (Vector3<f64>, Vector3<f64>),
    pub(super) tangents: Vec<Tangent>,
    /// By element: mixed derivatives of rings and stations, and what they add up to: one row for each displacement of
    /// a node.
    pub(super) mixed: Vec<Vec<Mixed>>,
    pub(super) cross: Vec<Vec<f64>>,
    pub(super) gradient: Vec<f64>,
    pub(super) node_hessian: Vec<f64>,
    /// The last Hessian while it is not factorised.
    pub(super) linearisation: Option<Box<Linearisation>>,
    /// That of this shape or an earlier one.
    pub(super) factorisation: Option<Factorisation>,
}

impl Workspace {
    pub(super) fn new(chain: &Chain, settings: &Settings) -> Self {
        let count = chain.elements.len();
        let size = 6 * count;
        let columns = if settings.interaction.acts_on_spans() { size } else { 0 };
        Self {
            configurations: chain.elements.iter().map(Configuration::straight).collect(),
            nodes: vec![Pose::identity(); count + 1],
            placed: vec![f64::NAN; chain.freedoms()],
            station_loads: chain.elements.iter().map(|e| vec![Load::zero(); e.stations.len()]).collect(),
            node_loads: vec![Load::zero(); count + 1],
            pair_loads: PairLoads::new(chain),
            wrenches: TermWrenches::none(),
            base: (Vector3::zeros(), Vector3::zeros()),
            tangents: chain.elements.iter().map(Tangent::new).collect(),
            mixed: vec![Vec::new(); count],
            cross: chain.elements.iter().map(|e| vec![0.0; (START + e.freedoms()) * columns]).collect(),
            gradient: vec![0.0; chain.freedoms()],
            node_hessian: vec![0.0; size * size],
            linearisation: None,
            factorisation: None,
        }
    }

    /// Pose of a station in the world.
    pub(super) fn station(&self, element: usize, index: usize) -> Pose {
        let state = &self.configurations[element].stations[index];
        self.nodes[element].compose(&Pose { position: state.position, rotation: state.directors })
    }

    /// Places all stations and nodes for the given base and unknowns, if they are not there.
    pub(super) fn place(&mut self, chain: &Chain, base: &Pose, unknowns: &[f64]) {
        if self.nodes[0] == *base && self.placed == unknowns {
            return;
        }
        self.placed.copy_from_slice(unknowns);
        self.nodes[0] = *base;
        for (k, element) in chain.elements.iter().enumerate() {
            self.configurations[k].update(element, chain.part(k, unknowns));
            self.nodes[k + 1] = self.nodes[k].compose(&self.configurations[k].end);
        }
    }
}

/// The potential at given inputs.
#[derive(Debug)]
pub(super) struct Potential<'a> {
    pub(super) chain: &'a Chain,
    pub(super) settings: &'a Settings,
    pub(super) inputs: &'a Inputs,
    pub(super) terms: Terms<'a>,
    pub(super) rules: &'a PairRules,
    pub(super) work: &'a mut Workspace,
}

impl Potential<'_> {
    /// The smallest eigenvalue of the last factorised Hessian relative to the elastic energy, an upper bound by `search`;
    /// positive where the shape is stable, NaN where none is found. `softest` is the first guess, and then its vector.
    ///
    /// Of forces without a potential it is the smallest real part of the eigenvalues: where that is negative the shape diverges
    /// in overdamped motion. Whether a shape flutters, in a pair of complex eigenvalues of the undamped motion, is another
    /// question: it takes the masses and the damping, which statics does not know.
    pub(super) fn margin(&mut self, lanczos: &mut Lanczos, softest: &mut [f64], search: Search) -> f64 {
        let metric = &self.chain.metric;
        if self.terms.have_potential() {
            return lanczos.smallest(metric, 0.0, softest, search, |x| self.solve(x));
        }
        smallest_real_part(metric, softest, ARNOLDI, |x| self.solve(x)).unwrap_or(f64::NAN)
    }

    /// Whether the shape factorised last is stable, for all that its factorisation tells; see [`Potential::margin`]. Where the
    /// symmetric part is positive definite no displacement gains energy, with a potential or without.
    pub(super) fn is_stable(&mut self) -> bool {
        if self.work.factorisation.as_ref().is_some_and(|factorisation| factorisation.definite) {
            return true;
        }
        let mut softest = vec![0.0; self.chain.metric.len()];
        spread(&self.chain.metric, &mut softest, 1.0);
        self.margin(&mut Lanczos::default(), &mut softest, THOROUGH) > 0.0
    }

    /// Computes the gradient at `x` alone, and keeps the last factorisation; the energy. Tables may stand for the rings'
    /// fields, so that energies are not to be compared.
    pub(super) fn chord_slope(&mut self, x: &[f64]) -> Option<f64> {
        self.terms.spans.tabulated = self.settings.tolerance >= TABLE_RESIDUAL;
        let energy = self.slope(x);
        self.terms.spans.tabulated = false;
        energy
    }

    /// Adds the Newton step from the last gradient with the last factorisation to `x`; the gradient is spent.
    pub(super) fn add_newton_step(&mut self, x: &mut [f64]) {
        let mut step = std::mem::take(&mut self.work.gradient);
        self.solve(&mut step);
        x.iter_mut().zip(&step).for_each(|(x, s)| *x -= s);
        self.work.gradient = step;
    }

    /// Places the chain and adds up all loads; the energy, or `None` where something touches.
    pub(super) fn load(&mut self, unknowns: &[f64], order: Order) -> Option<f64> {
        let hessian = order == Order::Hessian;
        self.work.place(self.chain, &self.inputs.base, unknowns);
        let mut energy = 0.0;
        for (k, element) in self.chain.elements.iter().enumerate() {
            energy += self.work.configurations[k].elastic_energy(element, self.chain.part(k, unknowns));
        }
        self.work.wrenches = TermWrenches::none();
        energy += self.load_stations(order)?;
        self.load_nodes(order)?;
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
        let (mut energy, base) = (0.0, self.inputs.base.position);
        for (k, element) in self.chain.elements.iter().enumerate() {
            let axes = self.work.nodes[k].rotation;
            for (index, station) in element.stations.iter().enumerate() {
                let (frame, pose) = (Frame::Station(station), self.work.station(k, index));
                let about = (&base, &mut self.work.wrenches);
                let load = self.terms.load(&frame, &pose, &axes, order, about)?;
                energy += load.energy;
                self.work.station_loads[k][index] = load;
            }
        }
        Some(energy)
    }

    fn load_nodes(&mut self, order: Order) -> Option<()> {
        let (axes, base) = (Matrix3::identity(), self.inputs.base.position);
        self.work.node_loads.fill(Load::zero());
        for (node, frame) in self.chain.frames() {
            let pose = self.work.nodes[node];
            let about = (&base, &mut self.work.wrenches);
            self.work.node_loads[node] += self.terms.load(&frame, &pose, &axes, order, about)?;
        }
        Some(())
    }

    /// Gradient and, with storage for their condensation, element Hessians, from the tip to the base.
    pub(super) fn backward(
        &mut self,
        unknowns: &[f64],
        mut condensations: Option<&mut [Condensation]>,
    ) -> bool {
        let order = if condensations.is_some() { Order::Hessian } else { Order::Gradient };
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
            if let Some(condensations) = &mut condensations {
                if !condensations[k].linearise(&self.work.configurations[k], &self.work.tangents[k]) {
                    return false;
                }
                if self.terms.spans.act() {
                    self.mix(k);
                }
            }
        }
        let base = &self.work.node_loads[0];
        self.work.base = (force + base.force, moment + base.moment());
        self.work.gradient.iter().all(|entry| entry.is_finite())
    }

    /// Adds a block between two nodes; the base's (node 0) is left out.
    pub(super) fn add_block(&mut self, row: usize, column: usize, block: &Matrix6<f64>) {
        let (Some(row), Some(column)) = (row.checked_sub(1), column.checked_sub(1)) else { return };
        let size = 6 * self.chain.elements.len();
        for i in 0..6 {
            for j in 0..6 {
                self.work.node_hessian[(6 * row + i) * size + 6 * column + j] += block[(i, j)];
            }
        }
    }
}

//! Workspace of the evaluations of the potential.

use std::sync::Arc;

use nalgebra::Vector3;

use super::chain::Chain;
use super::factorisation::{Factorisation, Linearisation, TotalLoad};
use super::free_turn::FreeTurn;
use super::inputs::Inputs;
use super::pair_loads::PairLoads;
use super::ring_field::SectionBatch;
use super::settings::Settings;
use super::source_field::StationFields;
use super::terms::{Mixed, TermWrenches};
use crate::geometry::Pose;
use crate::magnetics::Sources;
use crate::rod::{
    Configuration, ElementDerivatives, FrameState, Load, PlacedCoupling, PlacedLoad, Row, START,
};

/// Everything that an evaluation overwrites; kept between solves so that none of them allocates.
#[derive(Debug, Clone)]
pub(crate) struct Workspace {
    pub(crate) configurations: Vec<Configuration>,
    pub(crate) nodes: Vec<Pose>,
    /// The unknowns at which the chain is placed; NaN before the first evaluation.
    pub(crate) placed: Vec<f64>,
    /// Length of the shaft's elements relative to that of their tables.
    pub(crate) growth: f64,
    /// Arc length from the port that the guidewire reaches, m.
    pub(crate) reach: f64,
    /// Rotational stiffness of the guidewire in each element, N m/rad.
    pub(crate) lined: Vec<f64>,
    pub(crate) station_loads: Vec<Vec<Load>>,
    pub(crate) node_loads: Vec<Load>,
    /// Loads on other frames, by element.
    pub(crate) placed_loads: Vec<PlacedLoads>,
    pub(crate) pair_loads: PairLoads,
    /// Sections in the field of one ring.
    pub(crate) batch: SectionBatch,
    /// Fields of the sources at the stations.
    pub(crate) fields: Vec<StationFields>,
    /// Those of the loads on nodes that what surrounds the chain exerts, world axes.
    pub(crate) on_nodes_around: Vec<(usize, Load)>,
    /// The turn that costs no energy at the shapes in search, which is held then.
    pub(crate) free_turn: Option<FreeTurn>,
    pub(crate) wrenches: TermWrenches,
    /// Derivative of the energy with respect to the clamped base: force and moment that the clamp exerts.
    pub(crate) base: (Vector3<f64>, Vector3<f64>),
    pub(crate) derivatives: Vec<ElementDerivatives>,
    /// By element: mixed derivatives of rings and stations, and their sum, with one row for each displacement of a node.
    pub(crate) mixed: Vec<Vec<Mixed>>,
    pub(crate) cross: Vec<Vec<f64>>,
    pub(crate) gradient: Vec<f64>,
    pub(crate) node_hessian: Vec<f64>,
    /// The last Hessian, as long as it is not factorised.
    pub(crate) linearisation: Option<Box<Linearisation>>,
    /// The factorisation at this shape or an earlier one.
    pub(crate) factorisation: Option<Factorisation>,
}

/// Loads on frames of one element other than its stations and nodes.
#[derive(Debug, Clone, Default)]
pub(crate) struct PlacedLoads {
    pub(crate) loads: Vec<PlacedLoad>,
    /// Number of those, which come first, that depend on the shape of the element alone.
    pub(crate) own: usize,
    /// Mixed derivatives of pairs of them.
    pub(crate) couplings: Vec<PlacedCoupling>,
    /// Rotational stiffness of those that change abruptly with the shape, N m/rad.
    pub(crate) abrupt: f64,
}

impl PlacedLoads {
    pub(crate) fn clear(&mut self) {
        self.loads.clear();
        self.couplings.clear();
        self.own = 0;
        self.abrupt = 0.0;
    }
}

impl Workspace {
    pub(crate) fn new(chain: &Chain, settings: &Settings) -> Self {
        let count = chain.elements.len();
        let size = 6 * count;
        let columns = if settings.interaction.acts_on_spans() { size } else { 0 };

        Self {
            configurations: chain.elements.iter().map(Configuration::straight).collect(),
            nodes: vec![Pose::identity(); count + 1],
            placed: vec![f64::NAN; chain.freedoms()],
            growth: 1.0,
            reach: 0.0,
            lined: vec![0.0; count],
            station_loads: chain.elements.iter().map(|e| vec![Load::zero(); e.stations.len()]).collect(),
            node_loads: vec![Load::zero(); count + 1],
            placed_loads: vec![PlacedLoads::default(); count],
            pair_loads: PairLoads::new(chain),
            batch: SectionBatch::default(),
            fields: vec![StationFields::default(); Sources::MOST],
            on_nodes_around: Vec::new(),
            free_turn: None,
            wrenches: TermWrenches::none(),
            base: (Vector3::zeros(), Vector3::zeros()),
            derivatives: chain.elements.iter().map(ElementDerivatives::new).collect(),
            mixed: vec![Vec::new(); count],
            cross: chain.elements.iter().map(|e| vec![0.0; (START + e.freedoms()) * columns]).collect(),
            gradient: vec![0.0; chain.freedoms()],
            node_hessian: vec![0.0; size * size],
            linearisation: None,
            factorisation: None,
        }
    }

    /// Forgets the factorisation and all forces of the last shape.
    pub(crate) fn forget(&mut self) {
        self.factorisation = None;
        self.free_turn = None;
        self.on_nodes_around.clear();
        self.station_loads.iter_mut().flatten().for_each(|load| *load = Load::zero());
        self.placed_loads.iter_mut().for_each(PlacedLoads::clear);
        self.wrenches = TermWrenches::none();
        self.base = (Vector3::zeros(), Vector3::zeros());
    }

    /// Pose of a station in the world.
    pub(crate) fn station(&self, element: usize, index: usize) -> Pose {
        self.nodes[element].compose(&self.configurations[element].stations[index].pose())
    }

    /// Places all stations and nodes for the given inputs and unknowns, unless they are there already.
    pub(crate) fn place(&mut self, chain: &Chain, inputs: &Inputs, unknowns: &[f64]) {
        let (root, growth) = (inputs.root(), chain.growth(inputs.insertion));
        let reach = inputs.guidewire_insertion;
        let same = (self.growth.to_bits(), self.reach.to_bits()) == (growth.to_bits(), reach.to_bits());
        if self.nodes[0] == root && self.placed == unknowns && same {
            return;
        }
        self.placed.copy_from_slice(unknowns);
        (self.growth, self.reach) = (growth, reach);
        self.configurations[..chain.shaft].iter_mut().for_each(|shaft| shaft.growth = growth);
        if let Some(lining) = chain.lining.as_ref().filter(|_| !same) {
            self.line(lining);
        }
        self.nodes[0] = root;
        for (k, element) in chain.elements.iter().enumerate() {
            self.configurations[k].update(element, chain.part(k, unknowns));
            self.nodes[k + 1] = self.nodes[k].compose(&self.configurations[k].end);
        }
    }

    /// Adds a load of what surrounds the chain on a node, in world axes, with its stiffness (N/m): it changes abruptly with the shape.
    pub(crate) fn load_node(&mut self, chain: &Chain, node: usize, (load, stiffness): (Load, f64)) {
        self.node_loads[node] += load;
        self.on_nodes_around.push((node, load));
        if let Some(before) = node.checked_sub(1) {
            let lever = self.lever(chain, before);
            self.placed_loads[before].abrupt += stiffness * lever * lever;
        }
    }

    /// Adds a load at a row of an element's tables, whose frame is in that of the element's start node.
    pub(crate) fn load_row(
        &mut self,
        chain: &Chain,
        element: usize,
        (row, frame): (Row, FrameState),
        (load, stiffness): (Load, f64),
    ) {
        let lever = self.lever(chain, element);
        let load = load.in_axes(&self.nodes[element].rotation);
        let placed = &mut self.placed_loads[element];
        placed.abrupt += stiffness * (lever * lever);
        placed.loads.push(PlacedLoad { row: Arc::new(row), frame, load });
    }

    /// Length of an element, m: the lever by which a stiffness on it resists its rotation.
    fn lever(&self, chain: &Chain, element: usize) -> f64 {
        chain.elements[element].length * self.configurations[element].growth
    }

    /// The storage of the last Hessian, factorised or not.
    pub(crate) fn take_linearisation(&mut self) -> Option<Box<Linearisation>> {
        self.factorisation.take().map(Factorisation::into_linearisation).or_else(|| self.linearisation.take())
    }

    /// Loads on all nodes, then the totals on each element.
    pub(crate) fn loads(&self) -> impl Iterator<Item = TotalLoad> + '_ {
        let nodes = self.node_loads.iter().map(|load| TotalLoad::of([load], 0.0));
        let parts = self.station_loads.iter().zip(&self.placed_loads).zip(&self.lined);
        let elements = parts.map(|((stations, placed), lined)| {
            let others = placed.loads.iter().map(|placed| &placed.load);
            TotalLoad::of(stations.iter().chain(others), placed.abrupt + lined)
        });
        nodes.chain(elements)
    }
}

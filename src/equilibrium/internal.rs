//! What the manipulator's bodies do to one another; kept, as it depends on the shape alone.

use super::chain::Chain;
use super::potential::Potential;
use crate::geometry::Pose;
use crate::rod::{Load, Order};

/// Loads of all pairs at the shape for which they were last made.
#[derive(Debug, Clone)]
pub(super) struct Internal {
    /// On the nodes: forces and couples only.
    pub(super) nodes: Vec<Load>,
    /// On the stations, element by element.
    pub(super) stations: Vec<Vec<Load>>,
    /// `None` where they were not finished.
    made: Option<Made>,
    base: Pose,
    unknowns: Vec<f64>,
}

/// How the loads were made.
#[derive(Debug, Clone, Copy)]
struct Made {
    energy: f64,
    /// Number of the rules.
    rules: u64,
    tabulated: bool,
}

impl Internal {
    pub(super) fn new(chain: &Chain) -> Self {
        Self {
            nodes: vec![Load::zero(); chain.elements.len() + 1],
            stations: chain.elements.iter().map(|e| vec![Load::zero(); e.stations.len()]).collect(),
            made: None,
            base: Pose::identity(),
            unknowns: vec![0.0; chain.freedoms()],
        }
    }

    /// The energy, if these are the loads at that shape with those rules; tabulated ones do where tables may stand.
    fn at(&self, unknowns: &[f64], base: &Pose, rules: u64, tabulated: bool) -> Option<f64> {
        let alike = |made: &Made| made.rules == rules && (tabulated || !made.tabulated);
        let made = self.made.filter(|made| alike(made) && self.base == *base && self.unknowns == unknowns);
        made.map(|made| made.energy)
    }
}

impl Potential<'_> {
    /// Adds what rings do to rings and to spans to the loads; the energy, or `None` where something touches.
    ///
    /// The first step after a change of the inputs starts from the shape of the last solve: nothing is made anew.
    pub(super) fn load_internal(&mut self, unknowns: &[f64], order: Order) -> Option<f64> {
        let (base, rules, tabulated) = (&self.inputs.base, self.rules.number(), self.tabulated);
        let kept = self.work.internal.at(unknowns, base, rules, tabulated);
        let kept = kept.filter(|_| order == Order::Gradient);
        let energy = if let Some(energy) = kept {
            energy
        } else {
            let internal = &mut self.work.internal;
            internal.made = None;
            internal.nodes.fill(Load::zero());
            internal.stations.iter_mut().for_each(|loads| loads.fill(Load::zero()));
            let energy = self.load_pairs(order)? + self.load_spans(order)?;
            let internal = &mut self.work.internal;
            internal.made = Some(Made { energy, rules, tabulated });
            internal.base = *base;
            internal.unknowns.copy_from_slice(unknowns);
            energy
        };
        let work = &mut *self.work;
        let stations = work.station_loads.iter_mut().flatten().zip(work.internal.stations.iter().flatten());
        for (load, own) in stations.chain(work.node_loads.iter_mut().zip(&work.internal.nodes)) {
            *load += *own;
        }
        Some(energy)
    }
}

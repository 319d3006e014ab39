//! How far a shape and its loads have gone from those of the last factorisation.
//!
//! The Hessian depends on the shape and, through the turning of the directors, on the forces and couples along the
//! chain. While both have hardly changed, the factorisation and what it told about stability still hold.

use nalgebra::{Matrix3, Vector3};
use serde::{Deserialize, Serialize};

use super::chain::Chain;
use super::inputs::Inputs;
use super::potential::{Potential, Workspace};

/// Entries of one load: its couple and its force.
const ENTRIES: usize = 12;

/// Where a Hessian was made: enough to make it again.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Origin {
    pub(super) unknowns: Vec<f64>,
    pub(super) inputs: Inputs,
    /// The rules of the ring pairs.
    pub(super) rules: Vec<usize>,
    /// Whether the margin of the branch was found there.
    pub(super) judged: bool,
}

/// The origin of the last Hessian, and the loads there.
#[derive(Debug, Clone)]
pub(super) struct Reference {
    pub(super) origin: Origin,
    loads: Vec<f64>,
}

impl Reference {
    /// Storage; nothing has been judged.
    pub(super) fn new(chain: &Chain) -> Self {
        let (unknowns, inputs) = (vec![0.0; chain.freedoms()], Inputs::unloaded(chain.rings.len()));
        let origin = Origin { unknowns, inputs, rules: Vec::new(), judged: false };
        Self { origin, loads: vec![0.0; ENTRIES * (2 * chain.elements.len() + 1)] }
    }
}

impl Potential<'_> {
    /// Keeps the shape `unknowns` and what acts on it, of which a Hessian has been made.
    pub(super) fn note_origin(&mut self, unknowns: &[f64]) {
        let mut loads = std::mem::take(&mut self.work.reference.loads);
        for (slot, load) in loads.chunks_exact_mut(ENTRIES).zip(self.work.loads(self.chain)) {
            slot.copy_from_slice(&load);
        }
        self.work.reference.loads = loads;
        let origin = &mut self.work.reference.origin;
        origin.unknowns.copy_from_slice(unknowns);
        origin.inputs.copy_from(self.inputs);
        origin.rules.clear();
        origin.rules.extend(self.rules.chosen());
        origin.judged = false;
    }
}

impl Workspace {
    /// Distance from the reference of the present loads and of `unknowns`, in the chain's unit: radians of one element.
    pub(super) fn drift(&self, chain: &Chain, unknowns: &[f64]) -> f64 {
        let unit = chain.unit();
        let turned = chain
            .metric
            .iter()
            .zip(unknowns.iter().zip(&self.reference.origin.unknowns))
            .map(|(k, (a, b))| k * (a - b) * (a - b))
            .sum::<f64>();
        let mut loaded = 0.0;
        for (slot, load) in self.reference.loads.chunks_exact(ENTRIES).zip(self.loads(chain)) {
            for (before, now) in slot.iter().zip(load) {
                loaded += (now - before) * (now - before);
            }
        }
        turned.sqrt() / unit + loaded.sqrt() / (unit * unit)
    }

    /// Couple (J) and force times the first element's length (J) of all nodes, then summed over each element's stations.
    fn loads(&self, chain: &Chain) -> impl Iterator<Item = [f64; ENTRIES]> + '_ {
        let arm = chain.elements.first().map_or(0.0, |element| element.length);
        let nodes = self.node_loads.iter().map(|load| (load.couple, load.force));
        let elements = self.station_loads.iter().map(|loads| {
            loads.iter().fold((Matrix3::zeros(), Vector3::zeros()), |(couple, force), load| {
                (couple + load.couple, force + load.force)
            })
        });
        nodes.chain(elements).map(move |(couple, force)| {
            core::array::from_fn(|i| if i < 9 { couple[i] } else { force[i - 9] * arm })
        })
    }
}

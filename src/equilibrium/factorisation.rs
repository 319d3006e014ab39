//! A factorised Hessian: where it was made, and whether what it told about stability still holds.
//!
//! The Hessian depends on the shape and, through the turning of the directors, on the forces and couples along the
//! chain. While both have hardly changed, the factorisation and what it told about stability still hold.

use nalgebra::{DMatrix, DVectorViewMut, Dyn, LU, Matrix3, Vector3};
use serde::{Deserialize, Serialize};

use super::chain::Chain;
use super::condensation::{Condensation, turn_nodes};
use super::inputs::Inputs;
use super::potential::{Potential, Workspace};
use crate::numerics::cholesky;

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

/// The Hessian of a shape, ready to be factorised; its storage is that of the last one.
#[derive(Debug, Clone)]
pub(super) struct Linearisation {
    pub(super) condensations: Vec<Condensation>,
    /// Axes of the elements' start nodes: it is factorised and solved with in these, wherever the chain moves afterwards.
    axes: Vec<Matrix3<f64>>,
    /// By the displacements of the nodes, row by row; then its Cholesky factor.
    matrix: Vec<f64>,
    rhs: Vec<f64>,
    origin: Origin,
    /// What acted on nodes and elements.
    loads: Vec<f64>,
}

/// A Hessian that is factorised, with a shift or without.
#[derive(Debug, Clone)]
pub(super) struct Factorisation {
    made: Box<Linearisation>,
    /// Where the matrix is not symmetric.
    lu: Option<LU<f64, Dyn, Dyn>>,
    /// Whether its symmetric part is positive definite.
    pub(super) definite: bool,
    /// Whether rings act on spans, and spans back on rings.
    spans: bool,
    mutual: bool,
}

impl Linearisation {
    /// Storage, nothing is made yet; `spans` where rings act on spans.
    pub(super) fn new(chain: &Chain, spans: bool) -> Box<Self> {
        let count = chain.elements.len();
        let size = 6 * count;
        let columns = if spans { size } else { 0 };
        let (unknowns, inputs) = (vec![0.0; chain.freedoms()], Inputs::unloaded(chain.rings.len()));
        Box::new(Self {
            condensations: chain.elements.iter().map(|e| Condensation::new(e.freedoms(), columns)).collect(),
            axes: vec![Matrix3::identity(); count],
            matrix: vec![0.0; size * size],
            rhs: vec![0.0; size],
            origin: Origin { unknowns, inputs, rules: Vec::new(), judged: false },
            loads: vec![0.0; ENTRIES * (2 * count + 1)],
        })
    }

    /// Keeps the shape `unknowns` and what acts on it, where `potential` has been linearised.
    pub(super) fn note(&mut self, potential: &Potential<'_>, unknowns: &[f64]) {
        for (axes, node) in self.axes.iter_mut().zip(&potential.work.nodes) {
            *axes = node.rotation;
        }
        for (slot, load) in self.loads.chunks_exact_mut(ENTRIES).zip(potential.work.loads(potential.chain)) {
            slot.copy_from_slice(&load);
        }
        let origin = &mut self.origin;
        origin.unknowns.copy_from_slice(unknowns);
        origin.inputs.copy_from(potential.inputs);
        origin.rules.clear();
        origin.rules.extend(potential.rules.chosen());
        origin.judged = false;
    }

    /// Factorises the Hessian of `of`, made here, plus `shift` times the elastic one; itself where it is not positive definite
    /// or, without a potential, not regular.
    pub(super) fn factorise(
        mut self: Box<Self>,
        of: &Potential<'_>,
        shift: f64,
    ) -> Result<Factorisation, Box<Self>> {
        let size = self.rhs.len();
        self.origin.judged = false;
        self.matrix.copy_from_slice(&of.work.node_hessian);
        for k in 0..self.condensations.len() {
            if !self.condense(of, k, shift) {
                return Err(self);
            }
        }
        let mut lu = None;
        if !of.terms.have_potential() {
            let whole = DMatrix::from_row_slice(size, size, &self.matrix);
            self.matrix.copy_from_slice(((&whole + whole.transpose()) * 0.5).as_slice());
            lu = Some(whole.lu());
        }
        let definite = !of.terms.pairs.one_sided() && cholesky::factorise(&mut self.matrix, size);
        let regular = lu.as_ref().map_or(definite, LU::is_invertible);
        let (spans, mutual) = (of.terms.spans.act(), of.terms.spans.are_mutual());
        if regular { Ok(Factorisation { made: self, lu, definite, spans, mutual }) } else { Err(self) }
    }

    /// Condenses element `k` and adds it to the matrix of the nodes.
    fn condense(&mut self, of: &Potential<'_>, k: usize, shift: f64) -> bool {
        let size = self.rhs.len();
        let own = &mut self.condensations[k];
        if !own.condense(&of.work.tangents[k], &of.chain.elements[k].metric, shift) {
            return false;
        }
        let axes = self.axes[k];
        for i in 0..4 {
            for j in 0..4 {
                // The first six rows are the base's where the element starts there.
                let (Some(row), Some(column)) = (free(6 * k + 3 * i), free(6 * k + 3 * j)) else { continue };
                let part = Matrix3::from_fn(|a, b| own.condensed[3 * i + a][3 * j + b]);
                let turned = axes * part * axes.transpose();
                for a in 0..3 {
                    for b in 0..3 {
                        self.matrix[(row + a) * size + column + b] += turned[(a, b)];
                    }
                }
            }
        }
        if !of.terms.spans.act() {
            return true;
        }
        own.condense_outer(&of.work.cross[k], size);
        let mutual = of.terms.spans.are_mutual();
        for column in 0..size {
            let mut nodes = core::array::from_fn(|i| own.condensed_outer[i * size + column]);
            turn_nodes(&axes, &mut nodes);
            for (i, value) in nodes.iter().enumerate() {
                let Some(row) = free(6 * k + i) else { continue };
                self.matrix[row * size + column] += value;
                if mutual {
                    self.matrix[column * size + row] += value;
                }
            }
            if mutual {
                for row in 0..=column {
                    let value = cholesky::dot(own.outer(row), own.outer(column));
                    self.matrix[row * size + column] -= value;
                    if row != column {
                        self.matrix[column * size + row] -= value;
                    }
                }
            }
        }
        true
    }
}

impl Factorisation {
    /// Replaces `x` by `(H + shift K)^-1 x`.
    pub(super) fn solve(&mut self, chain: &Chain, x: &mut [f64]) {
        let Linearisation { condensations, axes, matrix, rhs, .. } = &mut *self.made;
        rhs.fill(0.0);
        for (k, condensation) in condensations.iter().enumerate() {
            let part = &mut x[chain.first[k]..chain.first[k + 1]];
            let mut nodes = condensation.eliminate(part);
            turn_nodes(&axes[k], &mut nodes);
            for (i, value) in nodes.iter().enumerate() {
                if let Some(row) = free(6 * k + i) {
                    rhs[row] += value;
                }
            }
            if self.mutual {
                condensation.eliminate_outer(part, rhs);
            }
        }
        let size = rhs.len();
        match &self.lu {
            Some(lu) => {
                lu.solve_mut(&mut DVectorViewMut::from_slice(rhs, size));
            }
            None => cholesky::solve(matrix, size, rhs),
        }
        for (k, condensation) in condensations.iter().enumerate() {
            let part = &mut x[chain.first[k]..chain.first[k + 1]];
            let mut nodes = core::array::from_fn(|i| free(6 * k + i).map_or(0.0, |row| rhs[row]));
            turn_nodes(&axes[k].transpose(), &mut nodes);
            if self.spans {
                condensation.recover_outer(rhs, part);
            }
            condensation.recover(&nodes, part);
        }
    }

    /// Where it was made.
    pub(super) fn origin(&self) -> &Origin {
        &self.made.origin
    }

    /// The margin of the branch has been found here, or is known to be that of here.
    pub(super) fn set_judged(&mut self, judged: bool) {
        self.made.origin.judged = judged;
    }

    /// Whether what it told about stability holds for `unknowns` and the loads there, which `work` has added up last: they may
    /// be as far as `reach` from its origin, in the radian norm.
    pub(super) fn holds_at(&self, work: &Workspace, chain: &Chain, unknowns: &[f64], reach: f64) -> bool {
        let Linearisation { origin, loads, .. } = &*self.made;
        if !origin.judged {
            return false;
        }
        let turned = chain
            .metric
            .iter()
            .zip(unknowns.iter().zip(&origin.unknowns))
            .map(|(k, (a, b))| k * (a - b) * (a - b))
            .sum::<f64>();
        let mut loaded = 0.0;
        for (slot, load) in loads.chunks_exact(ENTRIES).zip(work.loads(chain)) {
            for (before, now) in slot.iter().zip(load) {
                loaded += (now - before) * (now - before);
            }
        }
        let unit = chain.unit();
        turned.sqrt() / unit + loaded.sqrt() / (unit * unit) <= reach
    }
}

impl Workspace {
    /// The storage of the last Hessian, factorised or not.
    pub(super) fn take_linearisation(&mut self) -> Option<Box<Linearisation>> {
        self.factorisation
            .take()
            .map(|factorisation| factorisation.made)
            .or_else(|| self.linearisation.take())
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

/// The row of a node's displacement in the matrix of the nodes, from which the base is left out.
fn free(row: usize) -> Option<usize> {
    row.checked_sub(6)
}

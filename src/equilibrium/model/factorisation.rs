//! A factorised Hessian, with its origin and with how long its stability result stays valid.
//!
//! The Hessian depends on the shape and, through the rotation of the directors, on the forces and couples along the
//! chain. While both have hardly changed, the factorisation and its stability result remain valid, unless the stiffness
//! of a load has changed that appears or vanishes abruptly, as that of touching windings does.

use nalgebra::{DMatrix, DVectorViewMut, Dyn, LU, Matrix3, Vector3};
use serde::{Deserialize, Serialize};

use super::chain::Chain;
use super::condensation::{Added, Condensation, turn_nodes};
use super::free_turn::FreeTurn;
use super::inputs::Inputs;
use crate::geometry::Pose;
use crate::numerics::cholesky;
use crate::numerics::trust_region::distance;
use crate::rod::{ElementDerivatives, Load};

/// Total load on a node or element: what the validity of a Hessian depends on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct TotalLoad {
    /// Couple, N m.
    couple: Matrix3<f64>,
    /// Force, N.
    force: Vector3<f64>,
    /// Rotational stiffness of the loads that change abruptly with the shape, N m/rad.
    abrupt: f64,
}

impl TotalLoad {
    /// The sum of `loads`, with the stiffness of those that change abruptly.
    pub(crate) fn of<'a>(loads: impl IntoIterator<Item = &'a Load>, abrupt: f64) -> Self {
        let none = Self { couple: Matrix3::zeros(), force: Vector3::zeros(), abrupt };
        loads.into_iter().fold(none, |sum, load| Self {
            couple: sum.couple + load.couple,
            force: sum.force + load.force,
            ..sum
        })
    }

    /// Square of the change from `before`, with forces at the lever `arm` (m), (N m)2.
    fn square_from(&self, before: &Self, arm: f64) -> f64 {
        (self.couple - before.couple).norm_squared()
            + ((self.force - before.force) * arm).norm_squared()
            + (self.abrupt - before.abrupt).powi(2)
    }
}

/// Coupling of rings and spans in the Hessian.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum SpanCoupling {
    /// No coupling.
    None,
    /// Rings act on spans, without reaction.
    OneSided,
    /// Rings act on spans and spans on rings.
    Mutual,
}

/// The Hessian at a shape, in parts.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Hessian<'a> {
    pub(crate) chain: &'a Chain,
    /// Diagonal elastic stiffness of all unknowns.
    pub(crate) metric: &'a [f64],
    /// Second derivatives with respect to the node displacements, row by row.
    pub(crate) nodes: &'a [f64],
    /// Second derivatives of each element.
    pub(crate) elements: &'a [ElementDerivatives],
    /// Mixed second derivatives of each element and the rings' nodes; empty where rings do not act on spans.
    pub(crate) mixed: &'a [Vec<f64>],
    pub(crate) spans: SpanCoupling,
    /// An unknown that is held, with the stiffness that holds it.
    pub(crate) held: Option<(usize, f64)>,
    /// Whether all forces are conservative, so that the Hessian is symmetric.
    pub(crate) symmetric: bool,
    /// Whether every force between rings has its reaction.
    pub(crate) reciprocal: bool,
}

/// Where a Hessian was computed: enough to compute it again.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Origin {
    pub(crate) unknowns: Vec<f64>,
    pub(crate) inputs: Inputs,
    /// The quadrature rules of the ring pairs.
    pub(crate) rules: Vec<usize>,
    /// Whether the stability margin of the branch was determined there.
    pub(crate) assessed: bool,
    /// The free turn that was held.
    pub(crate) turn: Option<FreeTurn>,
}

/// The Hessian at a shape before its factorisation; it reuses the storage of the last one.
#[derive(Debug, Clone)]
pub(crate) struct Linearisation {
    pub(crate) condensations: Vec<Condensation>,
    /// Axes of the elements' start nodes at the origin. Factorisation and solves use these, wherever the chain moves
    /// afterwards.
    axes: Vec<Matrix3<f64>>,
    /// Hessian with respect to the node displacements, row by row; later its Cholesky factor.
    matrix: Vec<f64>,
    rhs: Vec<f64>,
    origin: Origin,
    /// Loads on nodes and elements.
    loads: Vec<TotalLoad>,
}

/// A factorised Hessian, with or without a shift.
#[derive(Debug, Clone)]
pub(crate) struct Factorisation {
    made: Box<Linearisation>,
    /// LU factors, where the matrix is not symmetric.
    lu: Option<LU<f64, Dyn, Dyn>>,
    /// Whether the symmetric part is positive definite.
    pub(crate) definite: bool,
    spans: SpanCoupling,
}

impl Linearisation {
    /// Allocates the storage; `spans` tells whether rings act on spans.
    pub(crate) fn new(chain: &Chain, spans: bool) -> Box<Self> {
        let count = chain.elements.len();
        let size = 6 * count;
        let columns = if spans { size } else { 0 };
        let (unknowns, inputs) = (vec![0.0; chain.freedoms()], Inputs::unloaded(chain.rings.len()));
        Box::new(Self {
            condensations: chain.elements.iter().map(|e| Condensation::new(e.freedoms(), columns)).collect(),
            axes: vec![Matrix3::identity(); count],
            matrix: vec![0.0; size * size],
            rhs: vec![0.0; size],
            origin: Origin { unknowns, inputs, rules: Vec::new(), assessed: false, turn: None },
            loads: Vec::with_capacity(2 * count + 1),
        })
    }

    /// Records the origin: the shape, the nodes' poses there, the loads on nodes and elements, the inputs, the
    /// quadrature rules and the free turn.
    pub(crate) fn note(
        &mut self,
        (unknowns, nodes): (&[f64], &[Pose]),
        loads: impl Iterator<Item = TotalLoad>,
        inputs: &Inputs,
        rules: impl Iterator<Item = usize>,
        turn: Option<FreeTurn>,
    ) {
        for (axes, node) in self.axes.iter_mut().zip(nodes) {
            *axes = node.rotation;
        }
        self.loads.clear();
        self.loads.extend(loads);
        let origin = &mut self.origin;
        origin.unknowns.copy_from_slice(unknowns);
        origin.inputs.copy_from(inputs);
        origin.rules.clear();
        origin.rules.extend(rules);
        (origin.assessed, origin.turn) = (false, turn);
    }

    /// Factorises this Hessian plus `shift` times the elastic one. Returns itself where the matrix is not positive
    /// definite or, for non-conservative forces, not regular.
    pub(crate) fn factorise(
        mut self: Box<Self>,
        hessian: &Hessian<'_>,
        shift: f64,
    ) -> Result<Factorisation, Box<Self>> {
        let size = self.rhs.len();
        self.origin.assessed = false;
        self.matrix.copy_from_slice(hessian.nodes);
        for k in 0..self.condensations.len() {
            if !self.condense(hessian, k, shift) {
                return Err(self);
            }
        }
        let mut lu = None;
        if !hessian.symmetric {
            let whole = DMatrix::from_row_slice(size, size, &self.matrix);
            self.matrix.copy_from_slice(((&whole + whole.transpose()) * 0.5).as_slice());
            lu = Some(whole.lu());
        }
        let definite = hessian.reciprocal && cholesky::factorise(&mut self.matrix, size);
        let regular = lu.as_ref().map_or(definite, LU::is_invertible);
        let spans = hessian.spans;
        if regular { Ok(Factorisation { made: self, lu, definite, spans }) } else { Err(self) }
    }

    /// Condenses element `k` and adds it to the matrix of the nodes.
    fn condense(&mut self, hessian: &Hessian<'_>, k: usize, shift: f64) -> bool {
        let size = self.rhs.len();
        let unknowns = hessian.chain.first[k]..hessian.chain.first[k + 1];
        let held = hessian.held.filter(|(unknown, _)| unknowns.contains(unknown));
        let added = Added {
            shift,
            metric: &hessian.metric[unknowns.clone()],
            held: held.map_or((0, 0.0), |(unknown, stiffness)| (unknown - unknowns.start, stiffness)),
        };
        if !self.condensations[k].condense(&hessian.elements[k], &added, &hessian.mixed[k]) {
            return false;
        }

        let (own, axes) = (&self.condensations[k], self.axes[k]);
        for i in 0..4 {
            for j in 0..4 {
                // The base is fixed: it has no rows where the element starts there.
                let (Some(row), Some(column)) = (free(6 * k + 3 * i), free(6 * k + 3 * j)) else { continue };
                let part = Matrix3::from_fn(|a, b| own.of_nodes(3 * i + a, 3 * j + b));
                let turned = axes * part * axes.transpose();
                for a in 0..3 {
                    for b in 0..3 {
                        self.matrix[(row + a) * size + column + b] += turned[(a, b)];
                    }
                }
            }
        }
        if hessian.spans != SpanCoupling::None {
            self.add_spans(k, hessian.spans == SpanCoupling::Mutual);
        }
        true
    }

    /// Adds what element `k`, condensed, does to the rows and columns of the rings that act on it.
    fn add_spans(&mut self, k: usize, mutual: bool) {
        let size = self.rhs.len();
        let (own, axes) = (&self.condensations[k], self.axes[k]);
        for column in 0..size {
            let mut nodes = own.to_ring(column);
            turn_nodes(&axes, &mut nodes);
            for (i, value) in nodes.iter().enumerate() {
                let Some(row) = free(6 * k + i) else { continue };
                self.matrix[row * size + column] += value;
                if mutual {
                    self.matrix[column * size + row] += value;
                }
            }
            if mutual {
                let taken = own.of_rings(column);
                let row = &mut self.matrix[column * size + column..(column + 1) * size];
                row.iter_mut().zip(taken).for_each(|(entry, value)| *entry -= value);
                for (below, value) in taken.iter().enumerate().skip(1) {
                    self.matrix[(column + below) * size + column] -= value;
                }
            }
        }
    }
}

impl Factorisation {
    /// Replaces `x` by `(H + shift K)^-1 x`.
    pub(crate) fn solve(&mut self, chain: &Chain, x: &mut [f64]) {
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
            if self.spans == SpanCoupling::Mutual {
                condensation.eliminate_rings(part, rhs);
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
            if self.spans != SpanCoupling::None {
                condensation.recover_rings(rhs, part);
            }
            condensation.recover(&nodes, part);
        }
    }

    /// Shape, inputs and rules at which it was computed.
    pub(crate) fn origin(&self) -> &Origin {
        &self.made.origin
    }

    /// Sets whether the stability margin of the branch is that of this factorisation.
    pub(crate) fn set_assessed(&mut self, assessed: bool) {
        self.made.origin.assessed = assessed;
    }

    /// Returns the storage for the next Hessian.
    pub(crate) fn into_linearisation(self) -> Box<Linearisation> {
        self.made
    }

    /// Whether its stability result is valid for `unknowns` with these `loads` on nodes and elements: both together may
    /// differ by `reach` from its origin, in the radian norm.
    pub(crate) fn holds_at(
        &self,
        chain: &Chain,
        unknowns: &[f64],
        loads: impl Iterator<Item = TotalLoad>,
        reach: f64,
    ) -> bool {
        let Linearisation { origin, loads: before, .. } = &*self.made;
        origin.assessed && drift(chain, (&origin.unknowns, before), (unknowns, loads)) <= reach
    }
}

/// Change of a shape and of the loads on nodes and elements, on which the Hessian depends, from `before` to `now`, both together in
/// the radian norm.
fn drift(
    chain: &Chain,
    before: (&[f64], &[TotalLoad]),
    now: (&[f64], impl Iterator<Item = TotalLoad>),
) -> f64 {
    let turned = distance(&chain.metric, now.0, before.0);
    let arm = chain.elements.first().map_or(0.0, |element| element.length);
    let loads = before.1.iter().zip(now.1);
    let loaded: f64 = loads.map(|(before, now)| now.square_from(before, arm)).sum();

    let unit = chain.radian_norm();
    turned / unit + loaded.sqrt() / (unit * unit)
}

/// The row of a node's displacement in the matrix of the nodes, which leaves out the base.
fn free(row: usize) -> Option<usize> {
    row.checked_sub(6)
}

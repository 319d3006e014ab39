//! Elimination of the rates of an element's collocation intervals.
//!
//! Everything is in coordinates of one size: a state's change over its units, a rate's over its unit per element length.

use nalgebra::{DMatrix, DVector, Dyn, LU, SMatrix, Vector6};

use super::mesh::{Interval, Tableau};
use super::node_shape::Basis;
use super::node_system::Link;
use super::strong_form::{Matrix12, Stage, State, Vector12};
use super::surroundings::Surroundings;
use super::transfer::{RingColumns, Transfer, force, join, split};
use crate::equilibrium::settings::Interaction;

/// One interval: its rates by what comes in.
#[derive(Debug)]
struct Eliminated {
    factors: LU<f64, Dyn, Dyn>,
    /// Rates by the change of the interval's start, and by the displacement of each ring.
    by_start: DMatrix<f64>,
    by_ring: Vec<DMatrix<f64>>,
    /// Change of the local coordinates at the end by that of each rate: quadrature weights.
    weights: Vec<f64>,
    /// Local coordinates at the end.
    end: Vector12,
}

/// All intervals of an element, and how a change at its start arrives at its end.
#[derive(Debug)]
pub(super) struct Condensed {
    intervals: Vec<Eliminated>,
    /// Units of a state, and the length of an element.
    units: Vector12,
    length: f64,
    offset: Matrix12,
    transfer: Transfer,
}

impl Condensed {
    pub(super) fn new(around: &Surroundings<'_>, basis: &Basis<6>, element: usize, start: &State) -> Self {
        let mut units = Vector12::zeros();
        units.fixed_rows_mut::<6>(0).copy_from(&basis.pose.diagonal());
        units.fixed_rows_mut::<6>(6).copy_from(&basis.wrench.diagonal());
        let one_sided = around.interaction == Interaction::Preceding;
        let mut transfer = Transfer::identity(if one_sided { element } else { 0 });
        let rigid = start.advance_derivative(around.line.chain.elements[element].offset);
        let offset = Matrix12::from_fn(|i, j| rigid[(i, j)] * units[j] / units[i]);
        transfer.own = offset;
        Self { intervals: Vec::new(), units, length: around.line.length, offset, transfer }
    }

    /// Eliminates the rates of the next interval; `None` where they are not determined.
    pub(super) fn add(&mut self, tableau: &Tableau, interval: &Interval, stages: &[Stage]) -> Option<()> {
        let size = 12 * stages.len();
        let (units, length) = (self.units, self.length);
        let mut matrix = DMatrix::identity(size, size);
        let mut by_start = DMatrix::zeros(size, 12);
        let mut by_ring = vec![DMatrix::zeros(size, 6); self.transfer.rings.len()];
        for (j, stage) in stages.iter().enumerate() {
            let by_local = Matrix12::from_fn(|a, b| stage.by_local[(a, b)] * units[b] / units[a]);
            for (l, weight) in tableau.inner[j].iter().enumerate() {
                let mut block = matrix.fixed_view_mut::<12, 12>(12 * j, 12 * l);
                block -= by_local * (interval.length * weight);
            }
            // The rotation of the start does not move the local rotation vector, which starts at zero.
            let mut columns = by_local;
            for a in 0..12 {
                for b in 0..3 {
                    columns[(a, 3 + b)] = stage.by_start[(a, b)] / units[a];
                }
            }
            by_start.fixed_view_mut::<12, 12>(12 * j, 0).copy_from(&(columns * length));
            for (target, mixed) in by_ring.iter_mut().zip(&stage.mixed) {
                let mut columns = RingColumns::zeros();
                force(&mut columns, mixed);
                let scaled = RingColumns::from_fn(|a, b| columns[(a, b)] * length * units[b] / units[a]);
                target.fixed_view_mut::<12, 6>(12 * j, 0).copy_from(&scaled);
            }
        }
        let factors = matrix.lu();
        let solved = by_ring.iter_mut().all(|columns| factors.solve_mut(columns)) && factors.solve_mut(&mut by_start);
        let weights = tableau.weights.iter().map(|weight| weight * interval.length / length).collect();
        let eliminated = Eliminated { factors, by_start, by_ring, weights, end: interval.end(tableau) };
        let own = self.transfer.own;
        self.transfer.own = eliminated.carried(&own, |_, _| {});
        for (number, ring) in self.transfer.rings.iter_mut().enumerate() {
            let before = *ring;
            *ring = eliminated.carried(&before, |rates, j| {
                rates.copy_from(&(*rates + eliminated.by_ring[number].fixed_view::<12, 6>(12 * j, 0)));
            });
        }
        self.intervals.push(eliminated);
        solved.then_some(())
    }

    /// The element in the equations of the nodes; `next` is not set.
    pub(super) fn link(&self) -> Link<6> {
        let own = |row: usize, column: usize| self.transfer.own.fixed_view::<6, 6>(row, column).into_owned();
        let ring = |columns: &RingColumns| {
            [columns.fixed_view::<6, 6>(0, 0).into_owned(), columns.fixed_view::<6, 6>(6, 0).into_owned()]
        };
        let rings = self.transfer.rings.iter().map(ring).collect();
        Link::new([own(0, 0), own(0, 6)], [own(6, 0), own(6, 6)], rings)
    }

    /// The rates' change, interval by interval, that removes their residuals when nothing comes in.
    pub(super) fn particular(&self, residuals: &[Vec<Vector12>]) -> Option<Vec<DVector<f64>>> {
        let own = self.intervals.iter().zip(residuals).map(|(interval, stages)| {
            let mut right = DVector::from_iterator(
                12 * stages.len(),
                stages.iter().flat_map(|stage| stage.iter().copied()),
            );
            interval.factors.solve_mut(&mut right).then_some(right)
        });
        own.collect()
    }

    /// Carries the change of the node at the start, and of the nodes whose rings act, to the element's end; appends the
    /// rates' changes to `step`.
    pub(super) fn cross(
        &self,
        particular: &[DVector<f64>],
        start: &Vector12,
        rings: &[Vector6<f64>],
        mut step: Option<&mut Vec<f64>>,
    ) -> Vector12 {
        let mut change = self.offset * start;
        for (interval, own) in self.intervals.iter().zip(particular) {
            let mut rates = own + &interval.by_start * change;
            for (by, moved) in interval.by_ring.iter().zip(rings) {
                rates += by * moved;
            }
            let (mut sum, turned) = split(&change);
            for (j, weight) in interval.weights.iter().enumerate() {
                sum += rates.fixed_rows::<12>(12 * j) * *weight;
            }
            change = join(&interval.end, &sum, &turned);
            if let Some(step) = step.as_deref_mut() {
                step.extend(rates.iter());
            }
        }
        change
    }
}

impl Eliminated {
    /// Carries columns of changes from the interval's start to its end.
    fn carried<const C: usize>(
        &self,
        start: &SMatrix<f64, 12, C>,
        acts: impl Fn(&mut SMatrix<f64, 12, C>, usize),
    ) -> SMatrix<f64, 12, C> {
        let (mut sum, turned) = split(start);
        for (j, weight) in self.weights.iter().enumerate() {
            let mut rates = self.by_start.fixed_view::<12, 12>(12 * j, 0) * start;
            acts(&mut rates, j);
            sum += rates * *weight;
        }
        join(&self.end, &sum, &turned)
    }
}

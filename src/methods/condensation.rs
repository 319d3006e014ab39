//! Static condensation of the rates of an element's collocation intervals.
//!
//! All coordinates are nondimensional: a state's change relative to its units, a rate relative to its unit per element length.

use nalgebra::{DMatrix, DVector, Dyn, LU};

use super::mesh::{Interval, Tableau};
use super::node_shape::Basis;
use super::node_system::{Block, Link};
use super::strong_form::{Matrix12, Stage, State, Vector12, join, split};
use super::surroundings::Surroundings;

/// One interval: its rates as functions of the change of its start.
#[derive(Debug)]
struct Eliminated {
    factors: LU<f64, Dyn, Dyn>,
    /// Derivative of the rates with respect to the interval's start.
    by_start: DMatrix<f64>,
    /// Derivatives of the local coordinates at the end with respect to each rate: quadrature weights.
    weights: Vec<f64>,
    /// Local coordinates at the end.
    end: Vector12,
}

/// All intervals of an element, and the map of a change from its start to its end.
#[derive(Debug)]
pub(super) struct Condensed {
    intervals: Vec<Eliminated>,
    /// Units of a state, and the length of an element.
    units: Vector12,
    length: f64,
    offset: Matrix12,
    own: Matrix12,
}

impl Condensed {
    pub(super) fn new(around: &Surroundings<'_>, basis: &Basis<6>, element: usize, start: &State) -> Self {
        let mut units = Vector12::zeros();
        units.fixed_rows_mut::<6>(0).copy_from(&basis.pose.diagonal());
        units.fixed_rows_mut::<6>(6).copy_from(&basis.wrench.diagonal());
        let rigid = start.advance_derivative(around.line.chain.elements[element].offset);
        let offset = Matrix12::from_fn(|i, j| rigid[(i, j)] * units[j] / units[i]);
        Self { intervals: Vec::new(), units, length: around.line.length, offset, own: offset }
    }

    /// Eliminates the rates of the next interval; `None` where they are indeterminate (singular matrix).
    pub(super) fn add(&mut self, tableau: &Tableau, interval: &Interval, stages: &[Stage]) -> Option<()> {
        let size = 12 * stages.len();
        let (units, length) = (self.units, self.length);
        let mut matrix = DMatrix::identity(size, size);
        let mut by_start = DMatrix::zeros(size, 12);
        for (j, stage) in stages.iter().enumerate() {
            let by_local = Matrix12::from_fn(|a, b| stage.by_local[(a, b)] * units[b] / units[a]);
            for (l, weight) in tableau.inner[j].iter().enumerate() {
                let mut block = matrix.fixed_view_mut::<12, 12>(12 * j, 12 * l);
                block -= by_local * (interval.length * weight);
            }
            // A rotation of the start does not change the local rotation vector, which is zero there.
            let mut columns = by_local;
            for a in 0..12 {
                for b in 0..3 {
                    columns[(a, 3 + b)] = stage.by_start[(a, b)] / units[a];
                }
            }
            by_start.fixed_view_mut::<12, 12>(12 * j, 0).copy_from(&(columns * length));
        }
        let factors = matrix.lu();
        let solved = factors.solve_mut(&mut by_start);
        let weights = tableau.weights.iter().map(|weight| weight * interval.length / length).collect();
        let eliminated = Eliminated { factors, by_start, weights, end: interval.end(tableau) };
        self.own = eliminated.carried(&self.own);
        self.intervals.push(eliminated);
        solved.then_some(())
    }

    /// The linearised element for the nodal equations; `next` is not set.
    pub(super) fn link(&self) -> Link<6> {
        let own = |row: usize, column: usize| self.own.fixed_view::<6, 6>(row, column).into_owned();
        Link { pose: [own(0, 0), own(0, 6)], wrench: [own(6, 0), own(6, 6)], next: Block::identity() }
    }

    /// Particular solution: the change of the rates, by interval, that removes their residuals for an unchanged interval start.
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

    /// Maps a change of the start node to the element's end; appends the changes of the rates to `step`.
    pub(super) fn cross(
        &self,
        particular: &[DVector<f64>],
        start: &Vector12,
        mut step: Option<&mut Vec<f64>>,
    ) -> Vector12 {
        let mut change = self.offset * start;
        for (interval, own) in self.intervals.iter().zip(particular) {
            let rates = own + &interval.by_start * change;
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
    /// Maps columns of changes from the interval's start to its end.
    fn carried(&self, start: &Matrix12) -> Matrix12 {
        let (mut sum, turned) = split(start);
        for (j, weight) in self.weights.iter().enumerate() {
            sum += self.by_start.fixed_view::<12, 12>(12 * j, 0) * start * *weight;
        }
        join(&self.end, &sum, &turned)
    }
}

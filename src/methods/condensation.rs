//! Static condensation of the rates of an element's collocation intervals.
//!
//! All coordinates are nondimensional: a state's change relative to its units, a rate relative to its unit per element length.

use core::ops::Range;

use nalgebra::{DMatrix, DVector, Dyn, LU, Matrix3, SMatrix, Vector3};

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

/// Touching windings of an element's core.
#[derive(Debug)]
pub(super) struct Windings {
    /// Intervals of the core.
    pub(super) intervals: Range<usize>,
    /// Derivatives of the moment that they carry with respect to rotations of both ends of the core, N m/rad.
    pub(super) by_ends: [Matrix3<f64>; 2],
}

/// Their effect on the linearised element, in nondimensional coordinates.
#[derive(Debug)]
struct Coupled {
    windings: Windings,
    /// Inverse of the derivative of the moment's equation with respect to the moment.
    inverse: Matrix3<f64>,
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
    coupled: Option<Coupled>,
}

impl Condensed {
    pub(super) fn new(around: &Surroundings<'_>, basis: &Basis<6>, element: usize, start: &State) -> Self {
        let mut units = Vector12::zeros();
        units.fixed_rows_mut::<6>(0).copy_from(&basis.pose.diagonal());
        units.fixed_rows_mut::<6>(6).copy_from(&basis.wrench.diagonal());
        let rigid = start.advance_derivative(around.line.chain.elements[element].offset);
        let offset = Matrix12::from_fn(|i, j| rigid[(i, j)] * units[j] / units[i]);
        Self { intervals: Vec::new(), units, length: around.line.length, offset, own: offset, coupled: None }
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

    /// Adds the moment that touching windings carry beside the core, after all intervals; `None` where it is
    /// indeterminate.
    pub(super) fn couple(&mut self, mut windings: Windings) -> Option<()> {
        for by in &mut windings.by_ends {
            *by /= self.units[9];
        }

        let Range { start, end } = windings.intervals;
        let (mut own, mut turned) = (self.offset, [SMatrix::<f64, 3, 12>::zeros(); 2]);
        let mut by_moment = SMatrix::<f64, 12, 3>::zeros();
        let mut inverse = Matrix3::zeros();
        for (k, interval) in self.intervals.iter().enumerate() {
            // Within the core the windings' moment is taken off, after it given back.
            if k == start {
                turned[0] = own.fixed_rows::<3>(3).into_owned();
                by_moment.fixed_rows_mut::<3>(9).fill_with_identity();
                by_moment.neg_mut();
            }
            (own, by_moment) = (interval.carried(&own), interval.carried(&by_moment));

            if k + 1 == end {
                turned[1] = own.fixed_rows::<3>(3).into_owned();
                let turned_by_moment = by_moment.fixed_rows::<3>(3);
                inverse = (Matrix3::identity() - windings.by_ends[1] * turned_by_moment).try_inverse()?;
                let mut moment = by_moment.fixed_rows_mut::<3>(9);
                moment += Matrix3::identity();
            }
        }

        let [near, far] = &windings.by_ends;
        self.own = own + by_moment * (inverse * (near * turned[0] + far * turned[1]));
        self.coupled = Some(Coupled { windings, inverse });
        Some(())
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
        step: Option<&mut Vec<f64>>,
    ) -> Vector12 {
        let mut moment = Vector3::zeros();
        if let Some(Coupled { windings, inverse }) = &self.coupled {
            let turned = |count: usize| {
                let change = self.advance(&particular[..count], start, &moment, None);
                change.fixed_rows::<3>(3).into_owned()
            };
            let [near, far] = &windings.by_ends;
            moment =
                inverse * (near * turned(windings.intervals.start) + far * turned(windings.intervals.end));
        }
        self.advance(particular, start, &moment, step)
    }

    /// Maps a change of the start node over as many intervals as there are particular solutions, with a change `moment` of
    /// what the windings carry beside the core.
    fn advance(
        &self,
        particular: &[DVector<f64>],
        start: &Vector12,
        moment: &Vector3<f64>,
        mut step: Option<&mut Vec<f64>>,
    ) -> Vector12 {
        let core = self.coupled.as_ref().map_or(0..0, |coupled| coupled.windings.intervals.clone());

        let mut change = self.offset * start;
        for (k, (interval, own)) in self.intervals.iter().zip(particular).enumerate() {
            if k == core.start {
                let mut internal = change.fixed_rows_mut::<3>(9);
                internal -= moment;
            }

            // The rates that condensation took out follow from the change of the interval's start.
            let rates = own + &interval.by_start * change;
            let (mut sum, turned) = split(&change);
            for (j, weight) in interval.weights.iter().enumerate() {
                sum += rates.fixed_rows::<12>(12 * j) * *weight;
            }
            change = join(&interval.end, &sum, &turned);
            if k + 1 == core.end {
                let mut internal = change.fixed_rows_mut::<3>(9);
                internal += moment;
            }

            if let Some(step) = step.as_deref_mut() {
                step.extend(rates.iter());
            }
        }
        change
    }
}

impl Eliminated {
    /// Maps columns of changes from the interval's start to its end.
    fn carried<const C: usize>(&self, start: &SMatrix<f64, 12, C>) -> SMatrix<f64, 12, C> {
        let (mut sum, turned) = split(start);
        for (j, weight) in self.weights.iter().enumerate() {
            sum += self.by_start.fixed_view::<12, 12>(12 * j, 0) * start * *weight;
        }
        join(&self.end, &sum, &turned)
    }
}

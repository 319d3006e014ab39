//! The columns of a sweep's table.

use core::ops::Range;
use std::str::FromStr;

use mcm::manipulator::output_table::{self, OutputRow, Scope, Spelling};
use mcm::manipulator::{Outputs, Scene};
use nalgebra::Vector3;

use super::way::Way;
use crate::verdict;

/// Tip distance up to which two shapes count as equal, mm, beside the errors that are told of them: ten thousand times the
/// error that a solve leaves.
const SAME_TIP: f64 = 1e-4;

const MM_PER_M: f64 = 1e3;

/// Columns of the solve.
const SEARCH: [&str; 11] = [
    "predicted_fold",
    "stable",
    "stability",
    "snaps",
    "converged",
    "outcome",
    "progress",
    "iterations",
    "residual",
    "interaction",
    "reason",
];

/// Which columns the scene's table has.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Columns {
    vessel: bool,
    shaft: bool,
}

impl Columns {
    pub(crate) fn of(scene: &Scene) -> Self {
        Self { vessel: scene.vessel.is_some(), shaft: scene.shaft.is_some() }
    }

    /// The outputs that have columns.
    fn rows(self) -> impl Iterator<Item = (&'static OutputRow, Spelling)> {
        let has = move |scope| match scope {
            Scope::Always => true,
            Scope::Vessel => self.vessel,
            Scope::Shaft => self.shaft,
            Scope::MutualWrenches => false,
        };
        output_table::rows().filter(move |row| has(row.scope)).filter_map(|row| Some((row, row.column?)))
    }

    /// Number of the columns of the shape.
    fn count(self) -> usize {
        self.rows().map(|(row, _)| row.components).sum()
    }

    /// Places of an output among the columns of the shape.
    fn places(self, name: &str) -> Range<usize> {
        let before: usize =
            self.rows().take_while(|(row, _)| row.name != name).map(|(row, _)| row.components).sum();
        before..before + output_table::row(name).map_or(0, |row| row.components)
    }

    /// The table's header for these keys.
    pub(crate) fn header<'a>(self, keys: impl Iterator<Item = &'a str>) -> Vec<String> {
        let numbers = self.rows().flat_map(|(row, _)| row.columns());
        let before = keys.chain(["way"]).map(str::to_owned);
        before.chain(numbers).chain(SEARCH.map(str::to_owned)).collect()
    }
}

/// One line of the table.
pub(crate) struct Row {
    columns: Columns,
    varied: Vec<f64>,
    way: Way,
    /// `None` in a row that did not converge.
    numbers: Option<Vec<f64>>,
    predicted_fold: Option<f64>,
    stable: Option<bool>,
    stability: Option<String>,
    snaps: u32,
    outcome: String,
    progress: f64,
    iterations: u32,
    residual: f64,
    /// The level that answered.
    interaction: String,
    /// Why it did not converge, is neutral, or what was left out on the way to it.
    reason: Option<String>,
}

impl Row {
    /// The cells in the order of [`Columns::header`].
    pub(crate) fn cells(&self) -> impl serde::Serialize + '_ {
        let converged = self.converged();
        let number = |index| self.numbers.as_ref().map(|numbers| numbers[index]);
        let numbers: Vec<Option<f64>> = (0..self.columns.count()).map(number).collect();
        let verdict = (self.predicted_fold, self.stable, &self.stability, self.snaps);
        let search = (
            converged,
            &self.outcome,
            self.progress,
            self.iterations,
            self.residual,
            &self.interaction,
            &self.reason,
        );
        (&self.varied, self.way.name(), numbers, verdict, search)
    }

    /// The row with these cells and this number of keys; `None` for anything else.
    pub(crate) fn read<'a>(
        mut cells: impl Iterator<Item = &'a str>,
        keys: usize,
        columns: Columns,
    ) -> Option<Self> {
        // An empty cell is a missing value.
        fn some<T: FromStr>(cell: &str) -> Result<Option<T>, T::Err> {
            if cell.is_empty() { Ok(None) } else { cell.parse().map(Some) }
        }
        let mut next = || cells.next();
        Some(Self {
            columns,
            varied: (0..keys).map(|_| next()?.parse().ok()).collect::<Option<_>>()?,
            way: Way::named(next()?)?,
            numbers: (0..columns.count())
                .map(|_| some(next()?).ok())
                .collect::<Option<Vec<_>>>()?
                .into_iter()
                .collect(),
            predicted_fold: some(next()?).ok()?,
            stable: some(next()?).ok()?,
            stability: some(next()?).ok()?,
            snaps: next()?.parse().ok()?,
            outcome: {
                next()?; // whether it converged
                next()?.into()
            },
            progress: next()?.parse().ok()?,
            iterations: next()?.parse().ok()?,
            residual: next()?.parse().ok()?,
            interaction: next()?.into(),
            reason: some(next()?).ok()?,
        })
    }

    pub(crate) fn new(
        columns: Columns,
        varied: Vec<f64>,
        way: Way,
        outputs: &Outputs,
        predicted_fold: Option<f64>,
    ) -> Self {
        let numbers =
            columns.rows().flat_map(|(row, Spelling { unit, .. })| row.read(outputs, 0, unit)).collect();

        Self {
            columns,
            varied,
            way,
            numbers: verdict::converged(outputs).then_some(numbers),
            predicted_fold,
            stable: outputs.stable.filter(|_| verdict::converged(outputs)),
            stability: verdict::stability(outputs).map(str::to_owned),
            snaps: outputs.snaps,
            outcome: outputs.outcome.name().into(),
            progress: outputs.progress,
            iterations: outputs.iterations,
            residual: outputs.residual,
            interaction: outputs.interaction.name().into(),
            reason: verdict::reason(outputs, None),
        }
    }

    /// With what the time budget left out on the way to it.
    pub(crate) fn leaving_out(mut self, left_out: Option<&str>) -> Self {
        self.reason = self.reason.or_else(|| left_out.map(str::to_owned));
        self
    }

    /// The first key's value.
    pub(crate) fn value(&self) -> f64 {
        self.varied[0]
    }

    /// Why it did not converge, or is neutral.
    pub(crate) fn reason(&self) -> &str {
        self.reason.as_deref().unwrap_or(&self.outcome)
    }

    /// Whether there is something to say about its shape.
    pub(crate) fn is_noted(&self) -> bool {
        self.reason.is_some()
    }

    /// How far the last step to it got, 0 to 1.
    pub(crate) fn progress(&self) -> f64 {
        self.progress
    }

    /// The tip angle, deg; `None` without a shape.
    pub(crate) fn angle(&self) -> Option<f64> {
        Some(self.numbers.as_ref()?[0])
    }

    pub(crate) fn way(&self) -> Way {
        self.way
    }

    pub(crate) fn converged(&self) -> bool {
        self.numbers.is_some()
    }

    /// Whether the tip positions differ by more than their errors, or only one of the two rows converged.
    pub(crate) fn differs(&self, other: &Self) -> bool {
        let (Some(own), Some(other)) = (&self.numbers, &other.numbers) else {
            return self.converged() != other.converged();
        };
        let of = |name| self.columns.places(name);
        let (places, error) = (of("tip.position"), of("model.error_estimate"));
        let tip = |numbers: &[f64]| Vector3::from_row_slice(&numbers[places.clone()]);
        let error = |numbers: &[f64]| numbers[error.start] * MM_PER_M;
        (tip(own) - tip(other)).norm() > SAME_TIP + error(own) + error(other)
    }
}

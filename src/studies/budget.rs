//! Error budget: how much each tolerance and each omission of the model changes the tip angle, and how far the model is
//! from the paper's measurements.

mod entries;

use rayon::prelude::*;
use serde::Serialize;

use self::entries::{ENTRIES, Entry, Setup};
use super::progress::Progress;
use super::study::{Study, Value};
use super::{fig7a, fig7b, fig7c};
use crate::error::Error;

pub use entries::{BUDGET_SCENES, BudgetKind, BudgetScene};

/// Effect of one entry in one scene.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Contribution {
    /// Kind of entry.
    pub kind: BudgetKind,
    /// The quantity that changes.
    pub quantity: String,
    /// Size of the change, with its unit.
    pub change: &'static str,
    /// The scene; `None` for a comparison with the paper.
    pub scene: Option<&'static str>,
    /// Tip angle without the change, deg.
    pub tip_angle_deg: Option<f64>,
    /// Smallest change of the tip angle, percent; `None` if the rings snap together at every change.
    pub least_percent: Option<f64>,
    /// Largest change of the tip angle, percent; `None` if the rings snap together at any change.
    pub largest_percent: Option<f64>,
    /// Whether the rings snap together before the full field is reached.
    pub pulled_shut: bool,
}

impl Contribution {
    /// Larger magnitude of both changes, percent; infinite where the rings snap together.
    #[must_use]
    pub fn size(&self) -> f64 {
        let ends = [self.least_percent, self.largest_percent, self.pulled_shut.then_some(f64::INFINITY)];
        ends.iter().flatten().fold(0.0, |size: f64, end| size.max(end.abs()))
    }
}

/// Effects of all entries in all scenes: all tolerances combined, each tolerance, each omission, and comparisons with
/// the paper; those of one kind by their size in the first scene, largest first.
///
/// # Errors
/// None for these scenes; those of the solves are passed on.
pub fn budget(progress: &dyn Progress) -> Result<Vec<Contribution>, Error> {
    let pairs: Vec<(&Entry, &BudgetScene)> =
        ENTRIES.iter().flat_map(|entry| BUDGET_SCENES.iter().map(move |scene| (entry, scene))).collect();
    progress.more(pairs.len());
    let effects = pairs.into_par_iter().map(|(entry, scene)| {
        let effect = contribution(entry, scene);
        progress.done();
        effect
    });
    let mut rows = effects.collect::<Result<Vec<Contribution>, Error>>()?;
    rows.extend(BUDGET_SCENES.iter().map(|scene| combined(&rows, scene)).collect::<Vec<_>>());
    rows.extend(paper(progress)?);
    let first = |row: &Contribution| {
        let same = |other: &&Contribution| (other.kind, &other.quantity) == (row.kind, &row.quantity);
        rows.iter().find(same).map_or(0.0, Contribution::size)
    };
    let order: Vec<(BudgetKind, f64)> = rows.iter().map(|row| (row.kind, first(row))).collect();
    let mut sorted: Vec<usize> = (0..rows.len()).collect();
    sorted.sort_by(|&a, &b| order[a].0.cmp(&order[b].0).then(order[b].1.total_cmp(&order[a].1)));
    Ok(sorted.into_iter().map(|index| rows[index].clone()).collect())
}

fn contribution(entry: &Entry, scene: &BudgetScene) -> Result<Contribution, Error> {
    let before = Setup::new(scene, entry.weighed);
    let angle = before.tip_angle()?;
    let mut changes = Vec::new();
    for &step in entry.steps {
        let mut after = before.clone();
        (entry.vary)(&mut after, step);
        changes.push(after.tip_angle()?.zip(angle).map(|(after, before)| 100.0 * (after / before - 1.0)));
    }
    let known = || changes.iter().copied().flatten();
    Ok(Contribution {
        kind: entry.kind,
        quantity: entry.quantity.into(),
        change: entry.change,
        scene: Some(scene.name),
        tip_angle_deg: angle.map(f64::to_degrees),
        least_percent: known().reduce(f64::min),
        // A softer device bends further until its rings snap together: there is no largest change.
        largest_percent: known().reduce(f64::max).filter(|_| !changes.contains(&None)),
        pulled_shut: changes.contains(&None),
    })
}

/// All tolerances combined as independent errors: the root of the sum of squares, separately for each sign.
fn combined(rows: &[Contribution], scene: &BudgetScene) -> Contribution {
    let own = || rows.iter().filter(|row| row.scene == Some(scene.name) && row.kind == BudgetKind::Tolerance);
    let together = |ends: &mut dyn Iterator<Item = f64>| ends.map(|end| end * end).sum::<f64>().sqrt();
    let pulled_shut = own().any(|row| row.pulled_shut);
    let below = together(&mut own().filter_map(|row| row.least_percent).map(|end| end.min(0.0)));
    let above = together(&mut own().filter_map(|row| row.largest_percent).map(|end| end.max(0.0)));
    Contribution {
        kind: BudgetKind::Combined,
        quantity: "all tolerances".into(),
        change: "root of the sum of squares",
        scene: Some(scene.name),
        tip_angle_deg: own().next().and_then(|row| row.tip_angle_deg),
        least_percent: Some(-below),
        largest_percent: Some(above).filter(|_| !pulled_shut),
        pulled_shut,
    }
}

/// Comparisons of the exact model with the measurements that the paper prints.
fn paper(progress: &dyn Progress) -> Result<Vec<Contribution>, Error> {
    type Figure = fn(&dyn Progress) -> Result<Study, Error>;
    let figures: [Figure; 3] = [|_| fig7a(), fig7b, |_| fig7c()];
    let figures = figures.par_iter().map(|figure| figure(progress)).collect::<Result<Vec<_>, Error>>()?;
    let rows = figures.iter().flat_map(|figure| &figure.comparison);
    let measured = rows.filter_map(|row| {
        let shown = entries::MEASURED.iter().find(|(quantity, _)| row.quantity.starts_with(quantity))?;
        let Value::Number(_) = row.paper else { return None };
        Some((shown.1, 100.0 * row.difference()?))
    });
    Ok(measured
        .map(|(quantity, percent)| Contribution {
            kind: BudgetKind::Paper,
            quantity: quantity.into(),
            change: "",
            scene: None,
            tip_angle_deg: None,
            least_percent: Some(percent),
            largest_percent: Some(percent),
            pulled_shut: false,
        })
        .collect())
}

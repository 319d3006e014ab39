//! The budget as a chart of horizontal bars, the largest first.

use super::Contribution;
use super::entries::{BUDGET_SCENES, BudgetKind};
use crate::studies::study::{Bar, Panel, Study};

/// Limits of the axis, percent; longer bars are cut off and read from their numbers.
const RANGE: [f64; 2] = [-20.0, 20.0];

/// Chart of the rows of [`super::budget()`]: bars for all scenes, numbers for the first.
#[must_use]
pub fn budget_picture(rows: &[Contribution]) -> Study {
    let mut bars: Vec<Bar> = Vec::new();
    let mut last = None;
    for row in rows {
        // Without a largest change, the bar extends beyond the axis.
        let end = row.largest_percent.or(row.pulled_shut.then_some(f64::INFINITY));
        let ends = row.least_percent.zip(end).map(|(least, end)| [least.min(0.0), end.max(0.0)]);
        let change = if row.change.is_empty() { String::new() } else { format!(", {}", row.change) };
        let label = format!("{}{change}", row.quantity);
        if let Some(bar) = bars.last_mut().filter(|bar| bar.label == label) {
            bar.ends.push(ends);
            continue;
        }
        let group = if last == Some(row.kind) { "" } else { heading(row.kind) };
        last = Some(row.kind);
        let colour = if row.kind == BudgetKind::Paper { PAPER_COLOUR } else { 0 };
        bars.push(Bar { group: group.into(), label, numbers: numbers(row), colour, ends: vec![ends] });
    }
    Study {
        title: "What changes the tip angle, and by how much",
        columns: vec![],
        panels: vec![Panel::Bars {
            title: format!("level full, field across the device; numbers: {}", BUDGET_SCENES[0].name),
            x: "change of the tip angle (%)".into(),
            range: RANGE,
            series: BUDGET_SCENES.iter().map(|scene| scene.name.into()).collect(),
            bars,
        }],
        comparison: vec![],
    }
}

/// Colour index of the comparisons with measurements.
const PAPER_COLOUR: usize = 2;

fn heading(kind: BudgetKind) -> &'static str {
    match kind {
        BudgetKind::Combined => "together",
        BudgetKind::Tolerance => "tolerances",
        BudgetKind::Omission => "left out of the model",
        BudgetKind::Paper => "model less what the paper measured, over that",
    }
}

/// The smallest and largest change in percent as text, or one number if they are equal.
fn numbers(row: &Contribution) -> String {
    match (row.least_percent, row.largest_percent) {
        (Some(least), Some(largest)) if least < largest => format!("{} to {}", shown(least), shown(largest)),
        (Some(one), Some(_)) => shown(one),
        (Some(least), None) => format!("{}, pulled shut", shown(least)),
        _ if row.pulled_shut => "pulled shut".into(),
        _ => "not known".into(),
    }
}

/// A change in percent as text, with more decimals if it is small.
fn shown(percent: f64) -> String {
    if percent.abs() < 0.1 { format!("{percent:+.2}") } else { format!("{percent:+.1}") }
}

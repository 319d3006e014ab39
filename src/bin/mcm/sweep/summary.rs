//! Folds of a sweep as a table, and a summary of its results in words.

use std::fmt::Write;

use mcm::manipulator::Fold;

use super::rows::Row;
use super::walk::Walk;
use super::way::Way;
use crate::failure::Failure;
use crate::output::Table;

/// Columns of a fold after the keys.
const COLUMNS: [&str; 6] =
    ["way", "alpha_before_deg", "stability_margin_before", "alpha_after_deg", "after_at", "branch"];

/// Writes the folds of all combinations; the first key's column holds the value at the fold.
pub(super) fn write_folds(mut table: Table, keys: &[&str], walks: &[Walk]) -> Result<(), Failure> {
    table.header(keys.iter().chain(&COLUMNS))?;
    for walk in walks {
        for (fold, way) in &walk.folds {
            let varied = [&[fold.value], &walk.others[..]].concat();
            let before = (fold.before.tip_angle.to_degrees(), fold.before.stability_margin);
            let after = fold.after.as_ref().map(|(value, shape)| (shape.tip_angle.to_degrees(), *value));
            let branch = if after.is_some() { "snap" } else { "end" };
            table.row((varied, way.name(), before, after.map(|a| a.0), after.map(|a| a.1), branch))?;
        }
    }
    table.complete()
}

/// Summary of one combination in lines of text; empty if there is nothing to report.
pub(super) fn describe(keys: &[&str], walk: &Walk) -> String {
    let mut text = String::new();
    for (fold, way) in &walk.folds {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "  {}", fold_in_words(keys[0], fold, *way));
    }
    if let Some(hysteresis) = hysteresis(keys[0], &walk.rows) {
        let _ = writeln!(text, "  {hysteresis}");
    }
    if text.is_empty() || walk.others.is_empty() {
        return text;
    }
    let named = |(key, value): (&&str, &f64)| format!("{key} = {value}");
    let others: Vec<String> = keys[1..].iter().zip(&walk.others).map(named).collect();
    format!("  with {}:\n{text}", others.join(", "))
}

fn fold_in_words(key: &str, fold: &Fold, way: Way) -> String {
    let before = fold.before.tip_angle.to_degrees();
    let margin = fold.before.stability_margin;
    let known = if fold.located { String::new() } else { format!(" +-{:.6}", 0.5 * fold.width) };
    let there =
        format!("{}: at {key} = {:.6}{known}, {before:.2} deg (margin {margin:.3})", way.name(), fold.value);
    match &fold.after {
        Some((value, shape)) => {
            let angle = shape.tip_angle.to_degrees();
            let far = (value - fold.value).abs() > 1e-3 * fold.value.abs();
            let at = if far { format!(", found at {value}") } else { String::new() };
            format!("{there}, it snaps to {angle:.2} deg{at}")
        }
        None => format!("{there}, the branch ends: {}", fold.outcome),
    }
}

/// Where the way back differs from the way forth, in words; `None` without a way back.
fn hysteresis(key: &str, rows: &[Row]) -> Option<String> {
    let forth = rows.len().div_ceil(2);
    let pairs = || rows[..forth].iter().zip(rows[forth - 1..].iter().rev());
    if rows[forth..].is_empty() || rows[forth].way() == Way::Forth {
        return None;
    }
    let apart: Vec<(&Row, &Row)> = pairs().filter(|(there, back)| there.differs(back)).collect();
    let (Some(first), Some(last)) = (apart.first(), apart.last()) else {
        return Some(if rows.iter().all(Row::converged) {
            "the way back is the way forth: no hysteresis".into()
        } else {
            "the way back starts at the last shape before the branch's end, which the device would have left"
                .into()
        });
    };
    // Where only one way has a shape they differ most.
    let difference = |(a, b): &&(&Row, &Row)| {
        a.angle().zip(b.angle()).map_or(f64::INFINITY, |(there, back)| (there - back).abs())
    };
    let told = |row: &Row| row.angle().map_or("no shape".into(), |angle| format!("{angle:.2} deg"));
    let (there, back) = apart.iter().max_by(|a, b| difference(a).total_cmp(&difference(b)))?;
    Some(format!(
        "hysteresis: the way back differs from {key} = {} to {}, most at {}: {} forth, {} back",
        first.0.value(),
        last.0.value(),
        there.value(),
        told(there),
        told(back)
    ))
}

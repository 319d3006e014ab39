//! Which rows of a table belong to one curve, and how its parts are drawn.

use super::sheet::Sheet;
use crate::failure::Failure;
use crate::picture::chart::{Curve, Run, Stroke, colour};
use crate::picture::units::value;

/// Most curves that can still be told apart.
const MOST: usize = 40;

/// The rows of each curve.
pub(super) struct Curves {
    groups: Vec<Branch>,
    /// Number of colours: curves there and back share one.
    colours: usize,
    abscissa: Vec<Option<f64>>,
    /// Branch with an unstable shape or with none.
    doubtful: Vec<bool>,
    /// Number of snaps so far, where it is told.
    snaps: Option<Vec<Option<f64>>>,
}

/// The rows of one curve.
struct Branch {
    name: String,
    colour: usize,
    back: bool,
    rows: Vec<usize>,
}

impl Curves {
    /// The curves over the column `x`; what was varied stands before the column with the title `end`.
    pub(super) fn of(sheet: &Sheet, x: usize, end: &str) -> Result<Self, Failure> {
        let abscissa = sheet.numbers(x)?;
        let back = sheet.says("way", "back");
        let end = sheet.titles.iter().position(|title| title == end).unwrap_or(0);
        let mut keys: Vec<usize> = sheet.varied().filter(|column| *column < end && *column != x).collect();
        let mut combinations = combined(sheet, &keys);
        // Along a path all inputs move together: its rows are no combinations.
        if combinations.len() * 2 > sheet.len() || !repeats(&abscissa, &back) {
            keys.clear();
            combinations = combined(sheet, &keys);
        }
        if combinations.len() > MOST {
            let names: Vec<&str> = keys.iter().map(|key| sheet.titles[*key].as_str()).collect();
            return Err(sheet.failure(format_args!(
                "{} curves, one for each value of {}, are too many for one picture: at most {MOST}; draw a part of the \
                 table, or one of these over --x",
                combinations.len(),
                names.join(" and ")
            )));
        }
        let there_and_back = back.contains(&true);
        let mut groups = Vec::new();
        for (colour, (cells, rows)) in combinations.iter().enumerate() {
            let values = keys.iter().zip(cells).map(|(key, cell)| value(&sheet.titles[*key], cell));
            for way in [false, true] {
                let mut own: Vec<usize> = rows.iter().copied().filter(|row| back[*row] == way).collect();
                let Some(first) = own.first().copied() else { continue };
                // The way back begins where the one there has ended.
                if way && first > 0 && rows.contains(&(first - 1)) {
                    own.insert(0, first - 1);
                }
                let way_name = there_and_back.then(|| if way { "back (dashed)" } else { "forth" }.to_owned());
                let name = values.clone().chain(way_name).collect::<Vec<_>>().join(", ");
                groups.push(Branch { name, colour, back: way, rows: own });
            }
        }
        let (unstable, lost) = (sheet.says("stable", "false"), sheet.says("converged", "false"));
        let doubtful = unstable.iter().zip(&lost).map(|(unstable, lost)| *unstable || *lost).collect();
        let snaps = sheet.titles.iter().position(|title| title == "snaps");
        let snaps = snaps.and_then(|column| sheet.numbers(column).ok());
        Ok(Self { groups, colours: combinations.len(), abscissa, doubtful, snaps })
    }

    /// Number of curves.
    pub(super) fn count(&self) -> usize {
        self.groups.len()
    }

    /// The curves of the column `y`.
    pub(super) fn of_column(&self, sheet: &Sheet, y: usize) -> Result<Vec<Curve>, Failure> {
        let values = sheet.numbers(y)?;
        if !values.iter().zip(&self.abscissa).any(|(y, x)| y.is_some() && x.is_some()) {
            return Err(sheet.failure(format_args!("{} has no value to draw", sheet.titles[y])));
        }
        Ok(self.groups.iter().map(|group| self.curve(group, &values)).collect())
    }

    fn curve(&self, group: &Branch, values: &[Option<f64>]) -> Curve {
        let mut curve = Curve {
            name: group.name.clone(),
            colour: colour(group.colour, self.colours),
            runs: Vec::new(),
            snaps: Vec::new(),
        };
        // The row before, and its place if it has one.
        let mut before: Option<(usize, Option<(f64, f64)>)> = None;
        for &row in &group.rows {
            let place = self.abscissa[row].zip(values[row]);
            let snapped = before.is_some_and(|(last, _)| self.snaps_between(last, row));
            if let Some(here) = place {
                match before {
                    Some((last, Some(there))) => {
                        let doubtful = snapped || self.doubtful[last] || self.doubtful[row];
                        let stroke = match (doubtful, group.back) {
                            (true, _) => Stroke::Dotted,
                            (false, true) => Stroke::Dashed,
                            (false, false) => Stroke::Solid,
                        };
                        join(&mut curve.runs, stroke, there, here);
                    }
                    _ => curve.runs.push(Run { stroke: Stroke::Points, points: vec![here] }),
                }
                if snapped {
                    curve.snaps.push(here);
                }
            }
            before = Some((row, place));
        }
        curve
    }

    fn snaps_between(&self, before: usize, after: usize) -> bool {
        let Some(snaps) = &self.snaps else { return false };
        snaps[before].zip(snaps[after]).is_some_and(|(before, after)| after > before)
    }
}

/// Leads a curve on from one place, at which it is, to another.
fn join(runs: &mut Vec<Run>, stroke: Stroke, there: (f64, f64), here: (f64, f64)) {
    match runs.last_mut() {
        Some(run) if run.points.len() == 1 || run.stroke == stroke => {
            run.stroke = stroke;
            run.points.push(here);
        }
        _ => runs.push(Run { stroke, points: vec![there, here] }),
    }
}

/// Whether a value of the abscissa occurs more than once on the way there.
fn repeats(abscissa: &[Option<f64>], back: &[bool]) -> bool {
    let there = abscissa.iter().zip(back).filter(|(_, back)| !**back);
    let mut values: Vec<f64> = there.filter_map(|(x, _)| *x).collect();
    values.sort_by(f64::total_cmp);
    values.windows(2).any(|pair| pair[1] - pair[0] <= 0.0)
}

/// The combinations of cells in these columns, in the order of the table, and the rows of each.
fn combined<'a>(sheet: &'a Sheet, keys: &[usize]) -> Vec<(Vec<&'a str>, Vec<usize>)> {
    let columns: Vec<Vec<&str>> = keys.iter().map(|key| sheet.cells(*key).collect()).collect();
    let mut numbers = std::collections::HashMap::new();
    let mut out: Vec<(Vec<&str>, Vec<usize>)> = Vec::new();
    for row in 0..sheet.len() {
        let cells: Vec<&str> = columns.iter().map(|column| column[row]).collect();
        let number = *numbers.entry(cells.clone()).or_insert_with(|| {
            out.push((cells, Vec::new()));
            out.len() - 1
        });
        out[number].1.push(row);
    }
    out
}

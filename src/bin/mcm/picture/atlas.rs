//! Small maps on common axes, whose cells are coloured by category.

use mcm::studies::{AtlasRow, Kind};
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::axes::{spacing, span, tick};
use super::{Canvas, Drawn, GRID, pen, scaled, text, tint};

/// Margins in pixels: left of the maps for names of groups and, from `ROW` on, of rows; above them for names of
/// columns; below them for ticks and labels.
const NAMES: f64 = 205.0;
const ROW: f64 = 152.0;
const ABOVE: f64 = 46.0;
const BELOW: f64 = 34.0;

/// Gap between maps, and additional gap between groups, pixels.
const GAP: f64 = 5.0;
const GROUP_GAP: f64 = 9.0;

/// Font heights of names and ticks, pixels.
const SMALL: f64 = 17.0;
const TICK: f64 = 14.0;

/// Values along one axis of all maps.
struct Axis {
    low: f64,
    high: f64,
    /// Width of a cell.
    cell: f64,
}

/// Positions of the maps, in pixels of the oversampled picture.
struct Layout<'a, 'b> {
    area: &'a Canvas<'b>,
    /// Number of columns of each group.
    of_group: usize,
    columns: usize,
    /// For each row, the number of groups that begin up to this row, without the first group.
    started: Vec<f64>,
    /// Size of a map.
    wide: f64,
    high: f64,
}

impl Axis {
    fn new(values: impl Iterator<Item = f64>) -> Self {
        let values: Vec<f64> = values.collect();
        let [low, high] = span(values.iter().copied());
        Self { low, high, cell: spacing(&values) }
    }

    /// Position of a value between the outer edges of the first and the last cell, from 0 to 1.
    fn part(&self, value: f64) -> f64 {
        (value - self.low + 0.5 * self.cell) / (self.high - self.low + self.cell)
    }
}

impl<'a, 'b> Layout<'a, 'b> {
    fn new(area: &'a Canvas<'b>, of_group: usize, groups: usize, rows: &[AtlasRow]) -> Self {
        let started = rows.iter().skip(1).scan(0.0, |count, row| {
            *count += if row.group.is_empty() { 0.0 } else { 1.0 };
            Some(*count)
        });
        let started: Vec<f64> = [0.0].into_iter().chain(started).collect();
        let columns = of_group * groups;
        let between = |count: usize, groups: f64| full(GAP) * (count as f64 - 1.0) + full(GROUP_GAP) * groups;
        let (width, height) = area.dim_in_pixel();
        let across = f64::from(width) - full(NAMES) - between(columns, groups as f64 - 1.0);
        let down = f64::from(height)
            - full(ABOVE + BELOW)
            - between(rows.len(), started.last().copied().unwrap_or_default());
        let (wide, high) = (across / columns as f64, down / rows.len() as f64);
        Self { area, of_group, columns, started, wide, high }
    }

    fn left(&self, column: usize) -> f64 {
        let before = full(GROUP_GAP) * (column / self.of_group) as f64;
        full(NAMES) + column as f64 * (self.wide + full(GAP)) + before
    }

    fn top(&self, row: usize) -> f64 {
        full(ABOVE) + row as f64 * (self.high + full(GAP)) + self.started[row] * full(GROUP_GAP)
    }

    fn bottom(&self) -> f64 {
        self.top(self.started.len() - 1) + self.high
    }

    fn write(&self, words: &str, size: f64, place: (f64, f64), side: HPos) -> Drawn {
        Ok(self.area.draw_text(words, &text(size).pos(Pos::new(side, VPos::Center)), pixel(place))?)
    }
}

/// Draws the maps.
pub(super) fn draw(
    area: &Canvas,
    labels: [&str; 2],
    kinds: &[Kind],
    [names, groups]: &[Vec<String>; 2],
    rows: &[AtlasRow],
) -> Drawn {
    let values = |axis: usize| {
        rows.iter().flat_map(|row| row.maps.iter().flatten()).map(move |(place, _)| place[axis])
    };
    let axes = [Axis::new(values(0)), Axis::new(values(1))];
    let layout = Layout::new(area, names.len(), groups.len(), rows);
    for (group, name) in groups.iter().enumerate() {
        let first = group * names.len();
        let ends = layout.left(first) + layout.left(first + names.len() - 1) + layout.wide;
        layout.write(name, SMALL, (0.5 * ends, full(11.0)), HPos::Center)?;
        for (column, name) in names.iter().enumerate() {
            let middle = layout.left(first + column) + 0.5 * layout.wide;
            layout.write(name, SMALL, (middle, full(33.0)), HPos::Center)?;
        }
    }
    for (number, row) in rows.iter().enumerate() {
        let middle = layout.top(number) + 0.5 * layout.high;
        layout.write(&row.group, SMALL, (0.0, middle), HPos::Left)?;
        layout.write(&row.label, SMALL, (full(ROW), middle), HPos::Left)?;
        for (column, map) in row.maps.iter().enumerate() {
            draw_map(&layout, (column, number), &axes, kinds, map)?;
        }
    }
    draw_ticks(&layout, &axes, labels)
}

fn draw_map(
    layout: &Layout,
    (column, row): (usize, usize),
    [across, up]: &[Axis; 2],
    kinds: &[Kind],
    map: &[([f64; 2], usize)],
) -> Drawn {
    let (left, top) = (layout.left(column), layout.top(row));
    let at =
        |x: f64, y: f64| pixel((left + layout.wide * across.part(x), top + layout.high * (1.0 - up.part(y))));
    for ([x, y], kind) in map {
        let half = [0.5 * across.cell, 0.5 * up.cell];
        let corners = [at(x - half[0], y - half[1]), at(x + half[0], y + half[1])];
        layout.area.draw(&Rectangle::new(corners, tint(kinds[*kind].tint).filled()))?;
    }
    let frame = [pixel((left, top)), pixel((left + layout.wide, top + layout.high))];
    Ok(layout.area.draw(&Rectangle::new(frame, pen(GRID, 1.0)))?)
}

fn draw_ticks(layout: &Layout, [across, up]: &[Axis; 2], [x, y]: [&str; 2]) -> Drawn {
    let bottom = layout.bottom();
    for column in 0..layout.columns {
        for (part, side) in [(0.0, HPos::Left), (0.5, HPos::Center), (1.0, HPos::Right)] {
            let value = tick(across.low + part * (across.high - across.low));
            let place = (layout.left(column) + layout.wide * part, bottom + full(10.0));
            layout.write(&value, TICK, place, side)?;
        }
    }
    let height = bottom + full(31.0);
    let middle = 0.5 * (layout.left(0) + layout.left(layout.columns - 1) + layout.wide);
    layout.write(x, SMALL, (middle, height), HPos::Center)?;
    let upwards = format!("upwards in each map: {y}, {} to {}", tick(up.low), tick(up.high));
    layout.write(&upwards, SMALL, (0.0, height), HPos::Left)
}

/// [`scaled`] as a float, for sums of many lengths.
fn full(length: f64) -> f64 {
    f64::from(scaled(length))
}

#[allow(clippy::cast_possible_truncation, reason = "places are within the picture")]
fn pixel((x, y): (f64, f64)) -> (i32, i32) {
    (x.round() as i32, y.round() as i32)
}

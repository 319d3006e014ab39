//! Many small maps of kinds on axes of one range.

use mcm::studies::{AtlasRow, Kind};
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::axes::{spacing, span, tick};
use super::{Canvas, Drawn, GRID, pen, scaled, text, tint};

/// Left of the maps: names of groups and rows, and the ticks; above: names of columns; below: ticks and label.
const NAMES: f64 = 205.0;
const GROUP: f64 = 152.0;
const ABOVE: f64 = 46.0;
const BELOW: f64 = 34.0;

/// Between the maps, and more between groups.
const GAP: f64 = 5.0;
const GROUP_GAP: f64 = 9.0;

/// Height of small letters.
const SMALL: f64 = 17.0;
const TICK: f64 = 14.0;

/// Draws the maps below a legend.
pub(super) fn draw(
    area: &Canvas,
    [x, y]: [&str; 2],
    kinds: &[Kind],
    [names, groups]: &[Vec<String>; 2],
    rows: &[AtlasRow],
) -> Drawn {
    let (width, height) = area.dim_in_pixel();
    let (width, height) = (f64::from(width), f64::from(height));
    let full = |length: f64| f64::from(scaled(length));
    let cells = || rows.iter().flat_map(|row| row.maps.iter().flatten());
    let [xs, ys] = [0, 1].map(|axis| cells().map(|(place, _)| place[axis]).collect::<Vec<f64>>());
    let range = |values: &[f64]| {
        let ([low, high], cell) = (span(values.iter().copied()), spacing(values));
        ([low - 0.5 * cell, high + 0.5 * cell], cell)
    };
    let (across, up) = (range(&xs), range(&ys));
    let of_group = names.len();
    let columns = of_group * groups.len();
    let spare = full(GAP) * (columns - 1) as f64 + full(GROUP_GAP) * (groups.len() - 1) as f64;
    let wide = (width - full(NAMES) - spare) / columns as f64;
    let started = |row: usize| rows[1..=row].iter().filter(|row| !row.group.is_empty()).count() as f64;
    let spare = full(GAP) * (rows.len() - 1) as f64 + full(GROUP_GAP) * started(rows.len() - 1);
    let high = (height - full(ABOVE + BELOW) - spare) / rows.len() as f64;
    let left = |column: usize| {
        full(NAMES) + column as f64 * (wide + full(GAP)) + (column / of_group) as f64 * full(GROUP_GAP)
    };
    let top = |row: usize| full(ABOVE) + row as f64 * (high + full(GAP)) + started(row) * full(GROUP_GAP);
    let write = |words: &str, size: f64, place: (f64, f64), side: HPos| {
        area.draw_text(words, &text(size).pos(Pos::new(side, VPos::Center)), pixel(place))
    };
    for (group, name) in groups.iter().enumerate() {
        let (from, to) = (left(group * of_group), left((group + 1) * of_group - 1) + wide);
        write(name, SMALL, (0.5 * (from + to), full(11.0)), HPos::Center)?;
        for (column, name) in names.iter().enumerate() {
            let middle = left(group * of_group + column) + 0.5 * wide;
            write(name, SMALL, (middle, full(33.0)), HPos::Center)?;
        }
    }
    for (number, row) in rows.iter().enumerate() {
        let middle = top(number) + 0.5 * high;
        write(&row.group, SMALL, (0.0, middle), HPos::Left)?;
        write(&row.label, SMALL, (full(GROUP), middle), HPos::Left)?;
        for (column, map) in row.maps.iter().enumerate() {
            let at = |[x, y]: [f64; 2]| {
                let part = |value: f64, [low, high]: [f64; 2]| (value - low) / (high - low);
                let right = left(column) + wide * part(x, across.0);
                pixel((right, top(number) + high * (1.0 - part(y, up.0))))
            };
            for ([x, y], kind) in map {
                let half = [0.5 * across.1, 0.5 * up.1];
                let corners = [at([x - half[0], y - half[1]]), at([x + half[0], y + half[1]])];
                area.draw(&Rectangle::new(corners, tint(kinds[*kind].tint).filled()))?;
            }
            let frame =
                [pixel((left(column), top(number))), pixel((left(column) + wide, top(number) + high))];
            area.draw(&Rectangle::new(frame, pen(GRID, 1.0)))?;
        }
    }
    let bottom = top(rows.len() - 1) + high;
    let [first, last] = span(xs.iter().copied());
    for column in 0..columns {
        for (part, side) in [(0.0, HPos::Left), (0.5, HPos::Center), (1.0, HPos::Right)] {
            let value = tick(first + part * (last - first));
            write(&value, TICK, (left(column) + wide * part, bottom + full(10.0)), side)?;
        }
    }
    let middle = 0.5 * (left(0) + width);
    write(x, SMALL, (middle, bottom + full(31.0)), HPos::Center)?;
    let [lowest, highest] = span(ys.iter().copied()).map(tick);
    write(
        &format!("upwards in each map: {y}, {lowest} to {highest}"),
        SMALL,
        (0.0, bottom + full(31.0)),
        HPos::Left,
    )?;
    Ok(())
}

#[allow(clippy::cast_possible_truncation, reason = "places are within the picture")]
fn pixel((x, y): (f64, f64)) -> (i32, i32) {
    (x.round() as i32, y.round() as i32)
}

//! Horizontal bars from zero, in groups, with labels on the left and numbers on the right.

use mcm::studies::Bar;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::axes::tick;
use super::{Canvas, Drawn, GRID, INK, colour, pen, scaled, text};

/// Margins in pixels: left of the axis for labels, right of it for numbers, below it for ticks and the abscissa's
/// label.
const LABELS: f64 = 385.0;
const NUMBERS: f64 = 140.0;
const BELOW: f64 = 52.0;

/// Heights of a row or heading, of all bars of a row together, and of the font, pixels.
pub(super) const ROW: f64 = 25.0;
const BARS: f64 = 16.0;
const SMALL: f64 = 17.0;

/// Approximate number of intervals between ticks.
const TICKS: f64 = 8.0;

/// Height of all rows and the axis in pixels of the picture.
pub(super) fn height(bars: &[Bar]) -> f64 {
    let headings = bars.iter().filter(|bar| !bar.group.is_empty()).count();
    (bars.len() + headings) as f64 * ROW + BELOW
}

/// Draws the bars.
pub(super) fn draw(area: &Canvas, x: &str, range: [f64; 2], bars: &[Bar]) -> Drawn {
    let (width, _) = area.dim_in_pixel();
    let [left, right] = [f64::from(scaled(LABELS)), f64::from(width) - f64::from(scaled(NUMBERS))];
    let across = |value: f64| {
        let part = (value.clamp(range[0], range[1]) - range[0]) / (range[1] - range[0]);
        whole(left + (right - left) * part)
    };
    let write = |words: &str, place: (i32, i32), side: HPos| -> Drawn {
        Ok(area.draw_text(words, &text(SMALL).pos(Pos::new(side, VPos::Center)), place)?)
    };
    let line = |from: (i32, i32), to: (i32, i32), shade: RGBColor| {
        area.draw(&PathElement::new(vec![from, to], pen(shade, 1.0)))
    };
    let bottom = scaled(height(bars) - BELOW);
    for value in ticks(range) {
        line((across(value), 0), (across(value), bottom), if value == 0.0 { INK } else { GRID })?;
        write(&tick(value), (across(value), bottom + scaled(12.0)), HPos::Center)?;
    }
    write(x, (whole(0.5 * (left + right)), bottom + scaled(36.0)), HPos::Center)?;
    let mut top = 0.0;
    for bar in bars {
        if !bar.group.is_empty() {
            write(&bar.group, (0, scaled(top + 0.6 * ROW)), HPos::Left)?;
            line((0, scaled(top + ROW)), (whole(right), scaled(top + ROW)), GRID)?;
            top += ROW;
        }
        let middle = scaled(top + 0.5 * ROW);
        write(&bar.label, (scaled(LABELS - 12.0), middle), HPos::Right)?;
        write(&bar.numbers, (whole(right) + scaled(10.0), middle), HPos::Left)?;
        let thick = BARS / bar.ends.len().max(1) as f64;
        for (number, ends) in bar.ends.iter().enumerate() {
            let Some([least, largest]) = ends else { continue };
            let from = top + 0.5 * (ROW - BARS) + number as f64 * thick;
            let corners = [(across(*least), scaled(from)), (across(*largest), scaled(from + thick))];
            area.draw(&Rectangle::new(corners, colour(bar.colour + number).filled()))?;
            for (cut, edge, inwards) in [(*least < range[0], left, 1), (*largest > range[1], right, -1)] {
                if cut {
                    point(area, whole(edge), [corners[0].1, corners[1].1], inwards)?;
                }
            }
        }
        top += ROW;
    }
    Ok(())
}

/// Cuts the end of a bar at `edge` to a point, which shows that the bar extends beyond the axis.
fn point(area: &Canvas, edge: i32, [top, bottom]: [i32; 2], inwards: i32) -> Drawn {
    let half = (bottom - top) / 2;
    for corner in [top, bottom] {
        let notch = [(edge, corner), (edge, top + half), (edge + inwards * half, corner)];
        area.draw(&Polygon::new(notch, WHITE.filled()))?;
    }
    Ok(())
}

/// Round values within a range, with zero if the range contains it.
fn ticks([low, high]: [f64; 2]) -> impl Iterator<Item = f64> {
    let rough = (high - low) / TICKS;
    let power = 10.0_f64.powf(rough.log10().floor());
    let step = [1.0, 2.0, 5.0, 10.0].map(|part| part * power).into_iter().find(|step| *step >= rough);
    let step = step.unwrap_or(rough);
    (0..).map(move |i| ((low / step).ceil() + f64::from(i)) * step).take_while(move |value| *value <= high)
}

#[allow(clippy::cast_possible_truncation, reason = "places are within the picture")]
fn whole(place: f64) -> i32 {
    place.round() as i32
}

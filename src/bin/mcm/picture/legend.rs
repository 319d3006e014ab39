//! Title and legend of a panel, above its axes, where they hide nothing.

use mcm::studies::{Mark, Panel, Stroke, Tint};
use plotters::prelude::*;

use super::{Canvas, INK, LINE, PAPER, TEXT, colour, pen, scaled, text, tint};

/// Length of a line sample, gap and height of a line of text, pixels.
const SAMPLE: f64 = 30.0;
const GAP: f64 = 8.0;
const LINE_HEIGHT: f64 = 27.0;

/// Symbol of a legend entry.
pub(super) enum Sample {
    Curve(usize, Stroke),
    Level,
    Band,
    Point,
    Kind(Tint),
}

/// Title and legend entries of a panel; curves and marks without a label have no entry.
pub(super) fn entries(panel: &Panel) -> (&str, Vec<(&str, Sample)>) {
    let curve = |label, colour, stroke| (label, Sample::Curve(colour, stroke));
    let (title, curves, marks): (_, Vec<(&str, Sample)>, _) = match panel {
        Panel::Curves { title, curves, marks, .. } => {
            (title, curves.iter().map(|c| curve(c.label.as_str(), c.colour, c.stroke)).collect(), marks)
        }
        Panel::Places { title, series, marks, .. } => {
            (title, series.iter().map(|s| curve(s.label.as_str(), s.colour, s.stroke)).collect(), marks)
        }
        Panel::Map { title, marks, .. } => (title, Vec::new(), marks),
        Panel::Bars { title, series, .. } => {
            let kind = |(number, label)| (String::as_str(label), Sample::Kind(Tint::Colour(number)));
            return (title, series.iter().enumerate().map(kind).collect());
        }
        Panel::Atlas { kinds, .. } => {
            return ("", kinds.iter().map(|kind| (kind.label.as_str(), Sample::Kind(kind.tint))).collect());
        }
    };
    let marks = marks.iter().map(|mark| match mark {
        Mark::Level(label, _) => (label.as_str(), Sample::Level),
        Mark::Band(label, _) => (label.as_str(), Sample::Band),
        Mark::Point(label, _) => (label.as_str(), Sample::Point),
    });
    (title, curves.into_iter().chain(marks).filter(|(label, _)| !label.is_empty()).collect())
}

/// Draws title and legend in as many lines as they need; returns the height at which they end.
pub(super) fn draw(
    title: &str,
    entries: &[(&str, Sample)],
    area: &Canvas,
) -> Result<i32, Box<dyn std::error::Error>> {
    let style = text(TEXT);
    let width = i32::try_from(area.dim_in_pixel().0)?;
    let (start, mut y) = (scaled(GAP), scaled(0.5 * LINE_HEIGHT));
    if !title.is_empty() {
        area.draw_text(title, &style, (start, y))?;
        y += scaled(LINE_HEIGHT);
    }
    let mut x = start;
    for (label, sample) in entries {
        let length = scaled(SAMPLE + GAP) + i32::try_from(area.estimate_text_size(label, &style)?.0)?;
        if x > start && x + length > width {
            x = start;
            y += scaled(LINE_HEIGHT);
        }
        draw_sample(sample, area, (x, y))?;
        area.draw_text(label, &style, (x + scaled(SAMPLE + GAP), y))?;
        x += length + scaled(2.0 * GAP);
    }
    Ok(y + scaled(if entries.is_empty() { -0.5 } else { 0.5 } * LINE_HEIGHT))
}

fn draw_sample(sample: &Sample, area: &Canvas, (x, y): (i32, i32)) -> Result<(), Box<dyn std::error::Error>> {
    let end = x + scaled(SAMPLE);
    let middle = (x + scaled(0.5 * SAMPLE), y);
    let line =
        |colour, width, from, to| area.draw(&PathElement::new(vec![(from, y), (to, y)], pen(colour, width)));
    match sample {
        Sample::Curve(number, Stroke::Solid) => line(colour(*number), LINE, x, end)?,
        Sample::Curve(number, Stroke::Dashed) => {
            line(colour(*number), LINE, x, x + scaled(0.42 * SAMPLE))?;
            line(colour(*number), LINE, x + scaled(0.58 * SAMPLE), end)?;
        }
        Sample::Curve(number, Stroke::Dots) => {
            area.draw(&Circle::new(middle, scaled(4.0), colour(*number).filled()))?;
        }
        Sample::Level => line(PAPER, LINE, x, end)?,
        Sample::Band => {
            let corners = [(x, y - scaled(8.0)), (end, y + scaled(8.0))];
            area.draw(&Rectangle::new(corners, PAPER.mix(0.3).filled()))?;
        }
        Sample::Kind(kind) => {
            let corners = [(x, y - scaled(8.0)), (end, y + scaled(8.0))];
            area.draw(&Rectangle::new(corners, tint(*kind).filled()))?;
        }
        Sample::Point => area.draw(&Circle::new(middle, scaled(6.5), pen(INK, LINE)))?,
    }
    Ok(())
}

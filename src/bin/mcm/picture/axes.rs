//! Curves and maps on their axes.

use mcm::studies::{Curve, Mark, Series, Stroke, Study};
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;

use super::{Canvas, Drawn, GRID, INK, LINE, PAPER, TEXT, colour, pen, scaled, text};

type Chart<'a, 'b> = ChartContext<'a, BitMapBackend<'b>, Cartesian2d<RangedCoordf64, RangedCoordf64>>;

/// Colour scale of maps, readable with colour blindness and in grey: viridis, from low to high.
const SCALE: ViridisRGB = ViridisRGB;

/// Draws columns over one column.
pub(super) fn curves(
    study: &Study,
    area: &Canvas,
    x: &(String, String),
    y_label: &str,
    curves: &[Curve],
    marks: &[Mark],
) -> Drawn {
    let abscissa = column(study, &x.1)?;
    let ordinates: Vec<&[f64]> = curves.iter().map(|c| column(study, &c.column)).collect::<Result<_, _>>()?;
    let heights = marks.iter().flat_map(|mark| match mark {
        Mark::Level(_, height) | Mark::Point(_, [_, height]) => [*height; 2],
        Mark::Band(_, heights) => *heights,
    });
    let heights = span(ordinates.iter().flat_map(|values| values.iter().copied()).chain(heights));
    let across = span(abscissa.iter().copied());
    let mut chart = chart(area, across, widened(heights), [&x.0, y_label], tick)?;
    draw_backdrop(&mut chart, across, marks)?;
    for (curve, values) in curves.iter().zip(&ordinates) {
        let points: Vec<(f64, f64)> = abscissa.iter().copied().zip(values.iter().copied()).collect();
        for run in points.split(|point| point.1.is_nan()) {
            draw_curve(&mut chart, run, curve.colour, curve.stroke)?;
        }
    }
    draw_points(&mut chart, marks)
}

/// Draws points on logarithmic axes.
pub(super) fn places(area: &Canvas, labels: [&str; 2], series: &[Series], marks: &[Mark]) -> Drawn {
    let marks: Vec<Mark> = marks
        .iter()
        .map(|mark| match mark {
            Mark::Level(label, height) => Mark::Level(label.clone(), height.log10()),
            Mark::Band(label, heights) => Mark::Band(label.clone(), heights.map(f64::log10)),
            Mark::Point(label, place) => Mark::Point(label.clone(), place.map(f64::log10)),
        })
        .collect();
    let shown = |series: &Series| -> Vec<(f64, f64)> {
        let positive = series.places.iter().filter(|place| place.iter().all(|value| *value > 0.0));
        positive.map(|[x, y]| (x.log10(), y.log10())).collect()
    };
    let all: Vec<(f64, f64)> = series.iter().flat_map(shown).collect();
    // Whole powers of ten around all points.
    let around = |[low, high]: [f64; 2]| [low.floor(), high.ceil()];
    let across = around(span(all.iter().map(|point| point.0)));
    let mut chart = chart(area, across, around(span(all.iter().map(|point| point.1))), labels, power)?;
    draw_backdrop(&mut chart, across, &marks)?;
    for series in series {
        let points = shown(series);
        draw_curve(&mut chart, &points, series.colour, series.stroke)?;
        draw_curve(&mut chart, &points, series.colour, Stroke::Dots)?;
    }
    draw_points(&mut chart, &marks)
}

/// Draws a colour map of one column over the grid of two others, with its colour scale.
pub(super) fn map(
    study: &Study,
    area: &Canvas,
    [x, y]: [&(String, String); 2],
    value: &str,
    marks: &[Mark],
) -> Drawn {
    let (xs, ys, values) = (column(study, &x.1)?, column(study, &y.1)?, column(study, value)?);
    let range = span(values.iter().copied());
    let (left, right) = area.split_horizontally(i32::try_from(area.dim_in_pixel().0)? - scaled(85.0));
    let (cell_x, cell_y) = (spacing(xs), spacing(ys));
    let around = |values: &[f64], cell: f64| {
        let [low, high] = span(values.iter().copied());
        [low - 0.5 * cell, high + 0.5 * cell]
    };
    let mut chart = chart(&left, around(xs, cell_x), around(ys, cell_y), [&x.0, &y.0], tick)?;
    let cells = xs.iter().zip(ys).zip(values).filter(|(_, value)| !value.is_nan());
    chart.draw_series(cells.map(|((&x, &y), &value)| {
        let corners = [(x - 0.5 * cell_x, y - 0.5 * cell_y), (x + 0.5 * cell_x, y + 0.5 * cell_y)];
        Rectangle::new(corners, SCALE.get_color_normalized(value, range[0], range[1]).filled())
    }))?;
    draw_points(&mut chart, marks)?;
    draw_scale(&right, range)
}

fn draw_scale(area: &Canvas, [low, high]: [f64; 2]) -> Drawn {
    const STEPS: i32 = 64;
    let step = (high - low) / f64::from(STEPS);
    let mut chart = ChartBuilder::on(area)
        .margin_top(scaled(8.0))
        .margin_bottom(scaled(62.0))
        .set_label_area_size(LabelAreaPosition::Right, scaled(60.0))
        .build_cartesian_2d(0.0..1.0, low..high)?;
    chart
        .configure_mesh()
        .disable_mesh()
        .disable_x_axis()
        .y_labels(6)
        .label_style(text(TEXT))
        .y_label_formatter(&|value| tick(*value))
        .draw()?;
    chart.draw_series((0..STEPS).map(|i| {
        let from = low + step * f64::from(i);
        let colour = SCALE.get_color_normalized(from + 0.5 * step, low, high);
        Rectangle::new([(0.0, from), (1.0, from + step)], colour.filled())
    }))?;
    Ok(())
}

fn chart<'a, 'b>(
    area: &'a Canvas<'b>,
    x: [f64; 2],
    y: [f64; 2],
    [x_label, y_label]: [&str; 2],
    tick: fn(f64) -> String,
) -> Result<Chart<'a, 'b>, Box<dyn std::error::Error>>
where
    'b: 'a,
{
    let mut chart = ChartBuilder::on(area)
        .margin_top(scaled(8.0))
        .margin_right(scaled(10.0))
        .x_label_area_size(scaled(62.0))
        .y_label_area_size(scaled(84.0))
        .build_cartesian_2d(x[0]..x[1], y[0]..y[1])?;
    let plain = |value: &f64| tick(*value);
    chart
        .configure_mesh()
        .x_desc(x_label)
        .y_desc(y_label)
        .x_labels(7)
        .y_labels(7)
        .max_light_lines(0)
        .bold_line_style(pen(GRID, 1.0))
        .axis_style(pen(INK, 1.0))
        .label_style(text(TEXT))
        .axis_desc_style(text(TEXT))
        .set_all_tick_mark_size(scaled(6.0))
        .x_label_formatter(&plain)
        .y_label_formatter(&plain)
        .draw()?;
    Ok(chart)
}

/// Label of a tick, without the rounding errors of its value.
pub(super) fn tick(value: f64) -> String {
    let rounded = (value * 1e6).round() / 1e6;
    if rounded == 0.0 { "0".into() } else { rounded.to_string() }
}

/// Label of a power of ten by its exponent; empty between powers.
fn power(exponent: f64) -> String {
    if (exponent - exponent.round()).abs() < 1e-6 { format!("1e{exponent:.0}") } else { String::new() }
}

fn draw_curve(chart: &mut Chart, run: &[(f64, f64)], number: usize, stroke: Stroke) -> Drawn {
    let colour = colour(number);
    let points = run.iter().copied();
    match stroke {
        Stroke::Solid => drop(chart.draw_series(LineSeries::new(points, pen(colour, LINE)))?),
        Stroke::Dashed => {
            let dashes = DashedLineSeries::new(points, scaled(10.0), scaled(6.0), pen(colour, LINE));
            chart.draw_series(dashes)?;
        }
        Stroke::Dots => {
            chart.draw_series(points.map(|point| Circle::new(point, scaled(4.0), colour.filled())))?;
        }
    }
    Ok(())
}

/// Draws levels and bands, behind the curves.
fn draw_backdrop(chart: &mut Chart, [left, right]: [f64; 2], marks: &[Mark]) -> Drawn {
    for mark in marks {
        match mark {
            Mark::Level(_, height) => {
                let line = PathElement::new(vec![(left, *height), (right, *height)], pen(PAPER, LINE));
                chart.draw_series([line])?;
            }
            Mark::Band(_, [low, high]) => {
                let band = Rectangle::new([(left, *low), (right, *high)], PAPER.mix(0.3).filled());
                chart.draw_series([band])?;
            }
            Mark::Point(..) => {}
        }
    }
    Ok(())
}

fn draw_points(chart: &mut Chart, marks: &[Mark]) -> Drawn {
    for mark in marks {
        if let Mark::Point(_, [x, y]) = mark {
            chart.draw_series([Circle::new((*x, *y), scaled(7.0), pen(INK, LINE))])?;
        }
    }
    Ok(())
}

fn column<'a>(study: &'a Study, name: &str) -> Result<&'a [f64], String> {
    study.column(name).ok_or_else(|| format!("there is no column {name}"))
}

/// Smallest and largest value; 0 and 1 if there are none.
pub(super) fn span(values: impl Iterator<Item = f64>) -> [f64; 2] {
    values
        .filter(|value| !value.is_nan())
        .map(|value| [value, value])
        .reduce(|[low, high], [value, _]| [low.min(value), high.max(value)])
        .unwrap_or([0.0, 1.0])
}

/// A range with a margin added at both ends.
fn widened([low, high]: [f64; 2]) -> [f64; 2] {
    let air = 0.05 * (high - low);
    [low - air, high + air]
}

/// Smallest distance between two different values: the grid spacing.
pub(super) fn spacing(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted
        .windows(2)
        .map(|pair| pair[1] - pair[0])
        .filter(|step| *step > 1e-9 * pair_scale(&sorted))
        .fold(f64::INFINITY, f64::min)
}

/// Range of the values, relative to which a step is real or rounding.
fn pair_scale(sorted: &[f64]) -> f64 {
    sorted.last().zip(sorted.first()).map_or(1.0, |(last, first)| last - first)
}

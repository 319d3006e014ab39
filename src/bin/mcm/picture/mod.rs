//! The picture of a study: panels with title, legend and axes; and that of a shape.

mod atlas;
mod axes;
mod bars;
mod legend;
mod shape;

use std::path::Path;

use mcm::studies::{Panel, Study, Tint};
use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::register_font;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::failure::Failure;
use super::output::Output;
pub(super) use shape::ShapeFile;

/// Width and minimum height of a picture, and heights of a row of panels without and with long legends, pixels.
const WIDTH: u32 = 900;
const HEIGHT: u32 = 600;
const ROW: u32 = 300;
const TALL_ROW: u32 = 500;

/// Height of title, legend and margins around bars, pixels.
const ABOVE_BARS: f64 = 115.0;

/// Pictures are drawn this many times larger and averaged, which smooths lines and letters.
const OVERSAMPLING: u32 = 3;

/// Step between shades: fine enough for smooth edges, coarse enough for small files. It divides 255, which is white.
const SHADE: usize = 5;

/// Name under which the embedded font is registered: Ubuntu Light (Ubuntu Font Licence 1.0, in `epaint_default_fonts`),
/// so that pictures need no font of the system and look the same everywhere; vector graphics are shown in the viewer's own.
const FONT: &str = "sans-serif";

/// Font heights and line width, pixels of the final picture.
const TITLE: f64 = 24.0;
const TEXT: f64 = 21.0;
const LINE: f64 = 2.6;

const INK: RGBColor = RGBColor(0x22, 0x25, 0x2a);
const GRID: RGBColor = RGBColor(0xdc, 0xdc, 0xdc);
/// Colour of values from the paper.
const PAPER: RGBColor = RGBColor(0x80, 0x86, 0x8f);

/// Colours that people with colour blindness can distinguish: M. Okabe and K. Ito, Color Universal Design (2002).
const COLOURS: [RGBColor; 6] = [
    RGBColor(0x00, 0x72, 0xb2),
    RGBColor(0xd5, 0x5e, 0x00),
    RGBColor(0x00, 0x9e, 0x73),
    RGBColor(0xcc, 0x79, 0xa7),
    RGBColor(0xe6, 0x9f, 0x00),
    RGBColor(0x56, 0xb4, 0xe9),
];

type Canvas<'a> = DrawingArea<BitMapBackend<'a>, Shift>;

/// Result of drawing; the error says why a picture could not be drawn.
type Drawn = Result<(), Box<dyn std::error::Error>>;

/// Draws a study into a PNG file.
pub(super) fn write(study: &Study, path: &Path) -> Result<(), Failure> {
    let failure = |reason: String| Failure(format!("cannot draw {}: {reason}", path.display()));
    let rows = u32::try_from(study.panels.len().div_ceil(2)).unwrap_or(u32::MAX);
    let tall = study.panels.iter().any(|panel| matches!(panel, Panel::Places { .. }));
    let bars = study.panels.iter().map(bars_height).max().unwrap_or_default();
    let size = (WIDTH, HEIGHT.max(rows.saturating_mul(if tall { TALL_ROW } else { ROW })).max(bars));
    let large = (size.0 * OVERSAMPLING, size.1 * OVERSAMPLING);
    let mut pixels = vec![255; (large.0 * large.1 * 3) as usize];
    draw(study, &mut pixels, large).map_err(|error| failure(error.to_string()))?;
    write_png(Output::at(path)?, &pixels, size)
}

/// Writes an oversampled picture into a PNG file.
fn write_png(mut file: Output, pixels: &[u8], size: (u32, u32)) -> Result<(), Failure> {
    let mut encoder = png::Encoder::new(&mut file, size.0, size.1);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_compression(png::Compression::High);
    let written = encoder.write_header().and_then(|mut writer| {
        writer.write_image_data(&averaged(pixels, size))?;
        writer.finish()
    });
    written.map_err(|error| Failure(format!("cannot write a picture: {error}")))?;
    file.complete()
}

/// Registers the embedded font.
fn use_font() -> Drawn {
    register_font(FONT, FontStyle::Normal, epaint_default_fonts::UBUNTU_LIGHT)
        .map_err(|_| "the embedded font is not readable".into())
}

fn draw(study: &Study, pixels: &mut [u8], size: (u32, u32)) -> Drawn {
    use_font()?;
    let canvas = BitMapBackend::with_buffer(pixels, size).into_drawing_area();
    let canvas = canvas.margin(scaled(8.0), scaled(8.0), scaled(8.0), scaled(14.0));
    let (heading, body) = canvas.split_vertically(scaled(34.0));
    heading.draw_text(study.title, &text(TITLE), (0, scaled(14.0)))?;
    let across = study.panels.len().min(2);
    let rows = study.panels.len().div_ceil(2);
    for (panel, area) in study.panels.iter().zip(body.split_evenly((rows, across))) {
        draw_panel(study, panel, &area.margin(0, scaled(10.0), 0, 0))?;
    }
    canvas.present()?;
    Ok(())
}

/// Height in pixels that a panel of bars needs; 0 for other panels.
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "some hundred pixels")]
fn bars_height(panel: &Panel) -> u32 {
    match panel {
        Panel::Bars { bars, .. } => (ABOVE_BARS + bars::height(bars)).ceil() as u32,
        _ => 0,
    }
}

fn draw_panel(study: &Study, panel: &Panel, area: &Canvas) -> Drawn {
    let (title, entries) = legend::entries(panel);
    let below = legend::draw(title, &entries, area)?;
    let (_, area) = area.split_vertically(below);
    match panel {
        Panel::Curves { x, y, curves, marks, .. } => axes::curves(study, &area, x, y, curves, marks),
        Panel::Places { x, y, series, marks, .. } => axes::places(&area, [x, y], series, marks),
        Panel::Map { x, y, value, marks, .. } => axes::map(study, &area, [x, y], value, marks),
        Panel::Bars { x, range, bars, .. } => bars::draw(&area, x, *range, bars),
        Panel::Atlas { x, y, kinds, columns, rows } => atlas::draw(&area, [x, y], kinds, columns, rows),
    }
}

/// Converts a length from pixels of the final picture to those of the oversampled one.
#[allow(clippy::cast_possible_truncation, reason = "lengths are far below the largest integer")]
fn scaled(length: f64) -> i32 {
    (length * f64::from(OVERSAMPLING)).round() as i32
}

/// Text style of the given height; the position of a text is its left end, at half its height.
fn text(height: f64) -> TextStyle<'static> {
    (FONT, scaled(height)).into_font().color(&INK).pos(Pos::new(HPos::Left, VPos::Center))
}

/// A pen of the given colour, `width` pixels wide.
fn pen(colour: RGBColor, width: f64) -> ShapeStyle {
    colour.stroke_width(scaled(width).unsigned_abs())
}

/// The colour with this index.
fn colour(number: usize) -> RGBColor {
    COLOURS[number % COLOURS.len()]
}

/// The colour of a category of cells.
fn tint(tint: Tint) -> RGBColor {
    match tint {
        Tint::Colour(number) => colour(number),
        Tint::Light => GRID,
        Tint::Dark => PAPER,
    }
}

/// Means over squares of the oversampled picture, rounded to the shades.
fn averaged(large: &[u8], (width, height): (u32, u32)) -> Vec<u8> {
    let factor = OVERSAMPLING as usize;
    let (width, height) = (width as usize, height as usize);
    let mut small = Vec::with_capacity(width * height * 3);
    for index in 0..width * height * 3 {
        let (row, column, channel) = (index / (width * 3), index / 3 % width, index % 3);
        let block = (0..factor * factor).map(|cell| {
            let (y, x) = (row * factor + cell / factor, column * factor + cell % factor);
            usize::from(large[(y * width * factor + x) * 3 + channel])
        });
        let mean = block.sum::<usize>() / (factor * factor);
        small.push(u8::try_from((mean + SHADE / 2) / SHADE * SHADE).unwrap_or(u8::MAX));
    }
    small
}

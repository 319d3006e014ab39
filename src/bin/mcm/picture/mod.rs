//! The picture of a shape.

mod shape;

use plotters::prelude::*;
use plotters::style::register_font;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::failure::Failure;
use super::output::Output;
pub(super) use shape::ShapeFile;

/// Width of a picture, pixels.
const WIDTH: u32 = 900;

/// Pictures are drawn this many times larger and averaged, which smooths lines and letters.
const OVERSAMPLING: u32 = 3;

/// Step between shades: fine enough for smooth edges, coarse enough for small files. It divides 255, which is white.
const SHADE: usize = 5;

/// Name under which the embedded font is registered: Ubuntu Light (Ubuntu Font Licence 1.0, in `epaint_default_fonts`),
/// so that pictures need no font of the system and look the same everywhere; vector graphics are shown in the viewer's own.
const FONT: &str = "sans-serif";

/// Font heights and line width, pixels of the final picture.
const TITLE: f64 = 24.0;
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

/// Result of drawing; the error says why a picture could not be drawn.
type Drawn = Result<(), Box<dyn std::error::Error>>;

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

/// Label of a tick, without the rounding errors of its value.
fn tick(value: f64) -> String {
    let rounded = (value * 1e6).round() / 1e6;
    if rounded == 0.0 { "0".into() } else { rounded.to_string() }
}

//! Colours, sizes and elements that all pictures share.

use svg::Document;
use svg::node::element::{Path, Rectangle, Text, Title};

/// Width of a picture, pixels.
pub(super) const WIDTH: f64 = 900.0;

/// Heights of the letters of a title and of everything else, pixels.
pub(super) const TITLE: f64 = 17.0;
pub(super) const TEXT: f64 = 14.0;

/// Width of a line that means something, pixels.
pub(super) const LINE: f64 = 1.8;

/// Mean width of a letter over its height: that of common sans-serif fonts, rounded up.
const LETTER: f64 = 0.56;

pub(super) const INK: &str = "#22252a";
pub(super) const GRID: &str = "#dcdcdc";
pub(super) const GREY: &str = "#80868f";

/// Colours that people with colour blindness can distinguish: M. Okabe and K. Ito, Color Universal Design (2002).
pub(super) const COLOURS: [&str; 6] = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"];

/// An empty picture of this height (pixels) with a title above everything.
pub(super) fn document(height: f64, title: &str) -> Document {
    Document::new()
        .set("width", WIDTH)
        .set("height", height)
        .set("viewBox", format!("0 0 {WIDTH} {height}"))
        .set("role", "img")
        .set("font-family", "sans-serif")
        .set("font-size", TEXT)
        .set("fill", INK)
        .add(Title::new(title))
        .add(Rectangle::new().set("width", WIDTH).set("height", height).set("fill", "white"))
        .add(text(title, (16.0, 26.0), "start").set("font-size", TITLE))
}

/// A text, whose `start`, `middle` or `end` is at a place.
pub(super) fn text(words: &str, (x, y): (f64, f64), anchor: &str) -> Text {
    Text::new(words).set("x", pixels(x)).set("y", pixels(y)).set("text-anchor", anchor)
}

/// About the width of a text, pixels.
pub(super) fn width(words: &str) -> f64 {
    LETTER * TEXT * words.chars().count() as f64
}

/// A line of this colour and width through these points.
pub(super) fn line(points: impl IntoIterator<Item = (f64, f64)>, colour: &str, width: f64) -> Path {
    Path::new()
        .set("d", path(points))
        .set("fill", "none")
        .set("stroke", colour)
        .set("stroke-width", width)
        .set("stroke-linejoin", "round")
}

/// The commands of a path through these points.
pub(super) fn path(points: impl IntoIterator<Item = (f64, f64)>) -> String {
    let point = |(number, (x, y)): (usize, (f64, f64))| {
        let command = if number == 0 { 'M' } else { 'L' };
        format!("{command}{},{}", pixels(x), pixels(y))
    };
    points.into_iter().enumerate().map(point).collect()
}

/// A length to a thousandth of a pixel.
pub(super) fn pixels(length: f64) -> f64 {
    (length * 1e3).round() / 1e3
}

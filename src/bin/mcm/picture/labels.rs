//! Names of curves: each at its curve's end, or all above the axes where they do not fit there.

use svg::node::element::{Group, Rectangle};

use super::style::{TEXT, line, text, width};

/// Least distance of two names, pixels.
const APART: f64 = 1.15 * TEXT;

/// Room between the axes and the names, pixels.
const GAP: f64 = 18.0;

/// Size of a sample of a colour, and room after a name, pixels.
const SAMPLE: f64 = 14.0;
const AFTER: f64 = 18.0;

/// A name to write: its colour, and the place in the picture at which its curve ends.
pub(super) struct Name<'a> {
    pub(super) words: &'a str,
    pub(super) colour: &'a str,
    pub(super) end: (f64, f64),
}

/// Room that names need beside the axes, pixels; `None` where so many do not fit into this height.
pub(super) fn room_beside<'a>(names: impl Iterator<Item = &'a str>, height: f64, most: f64) -> Option<f64> {
    let widths: Vec<f64> = names.map(width).collect();
    let widest = widths.iter().copied().fold(0.0, f64::max);
    let room = if widths.is_empty() { 0.0 } else { widest + GAP };
    (room <= most && widths.len() as f64 * APART <= height).then_some(room)
}

/// Names beside the axes, whose right edge and limits of height these are, each as near to its curve's end as the others allow.
pub(super) fn beside(mut names: Vec<Name>, right: f64, [top, bottom]: [f64; 2]) -> Group {
    names.sort_by(|a, b| a.end.1.total_cmp(&b.end.1));
    let mut heights: Vec<f64> = Vec::new();
    for name in &names {
        let above = heights.last().map_or(top + 0.5 * APART, |last| last + APART);
        heights.push(name.end.1.max(above));
    }
    let mut below = bottom;
    for height in heights.iter_mut().rev() {
        *height = height.min(below);
        below = *height - APART;
    }
    names.iter().zip(heights).fold(Group::new(), |group, (Name { words, colour, end }, height)| {
        let start = (right + GAP - 4.0, height);
        let leader = line([*end, (right + 2.0, end.1), start], colour, 0.7).set("stroke-opacity", 0.6);
        let name = text(words, (start.0 + 3.0, height), "start")
            .set("dominant-baseline", "central")
            .set("fill", *colour)
            .set("class", "name");
        group.add(leader).add(name)
    })
}

/// Names with samples of their colours in lines from the left to the right; also the height below the last one.
pub(super) fn above<'a>(
    names: impl Iterator<Item = (&'a str, &'a str)>,
    [left, right]: [f64; 2],
    top: f64,
) -> (Group, f64) {
    let (mut x, mut y, mut out) = (left, top, Group::new());
    for (words, colour) in names {
        let wide = SAMPLE + 6.0 + width(words);
        if x > left && x + wide > right {
            (x, y) = (left, y + APART + 4.0);
        }

        let sample = Rectangle::new()
            .set("x", x)
            .set("y", y)
            .set("width", SAMPLE)
            .set("height", SAMPLE)
            .set("fill", colour);
        let name = text(words, (x + SAMPLE + 6.0, y + 0.5 * SAMPLE), "start")
            .set("dominant-baseline", "central")
            .set("class", "name");

        out = out.add(sample).add(name);
        x += wide + AFTER;
    }
    (out, y + APART + 4.0)
}

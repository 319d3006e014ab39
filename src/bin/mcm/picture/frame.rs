//! A rectangle of a picture with axes.

use svg::node::element::{Group, Rectangle, SVG};

use super::style::{GRID, INK, line, pixels, text};
use super::ticks::ticks;

/// Pixels from one number to the next on an axis, about.
const BETWEEN: [f64; 2] = [90.0, 36.0];

/// Length of the mark of a number, pixels.
const TICK: f64 = 5.0;

/// Distances of numbers and labels from the frame, pixels.
const NUMBERS: [f64; 2] = [20.0, 9.0];
const LABELS: [f64; 2] = [42.0, 62.0];

/// Places in the picture (pixels) of values between two limits.
#[derive(Debug, Clone, Copy)]
pub(super) struct Frame {
    pub(super) left: f64,
    pub(super) top: f64,
    pub(super) width: f64,
    pub(super) height: f64,
    /// Limits of the abscissa and of the ordinate.
    pub(super) x: [f64; 2],
    pub(super) y: [f64; 2],
}

impl Frame {
    pub(super) fn right(&self) -> f64 {
        self.left + self.width
    }

    pub(super) fn bottom(&self) -> f64 {
        self.top + self.height
    }

    /// The place of a pair of values.
    pub(super) fn at(&self, (x, y): (f64, f64)) -> (f64, f64) {
        let share = |value: f64, [low, high]: [f64; 2]| (value - low) / (high - low);
        (self.left + self.width * share(x, self.x), self.bottom() - self.height * share(y, self.y))
    }

    /// A part of the picture that shows nothing outside the frame, in the picture's coordinates.
    pub(super) fn inside(&self) -> SVG {
        let [left, top, width, height] = [self.left, self.top, self.width, self.height].map(pixels);
        SVG::new()
            .set("x", left)
            .set("y", top)
            .set("width", width)
            .set("height", height)
            .set("viewBox", format!("{left} {top} {width} {height}"))
    }

    /// Lines at the numbers of both axes.
    pub(super) fn grid(&self) -> Group {
        let [x, y] = self.numbers();
        let across = y.into_iter().map(|(_, y)| [(self.left, y), (self.right(), y)]);
        let upright = x.into_iter().map(|(_, x)| [(x, self.top), (x, self.bottom())]);
        across.chain(upright).fold(Group::new(), |group, ends| group.add(line(ends, GRID, 1.0)))
    }

    /// The frame with numbers and labels; without a label, the abscissa has no numbers either.
    pub(super) fn axes(&self, x_label: Option<&str>, y_label: &str) -> Group {
        let border = Rectangle::new()
            .set("x", pixels(self.left))
            .set("y", pixels(self.top))
            .set("width", pixels(self.width))
            .set("height", pixels(self.height))
            .set("fill", "none")
            .set("stroke", INK);

        let mut out = Group::new().add(border);
        let [x, y] = self.numbers();
        for (number, at) in x {
            out = out.add(line([(at, self.bottom()), (at, self.bottom() + TICK)], INK, 1.0));
            if x_label.is_some() {
                let number = text(&number, (at, self.bottom() + NUMBERS[0]), "middle").set("class", "x");
                out = out.add(number);
            }
        }

        for (number, at) in y {
            out = out.add(line([(self.left - TICK, at), (self.left, at)], INK, 1.0));
            let number = text(&number, (self.left - NUMBERS[1], at), "end").set("class", "y");
            out = out.add(number.set("dominant-baseline", "central"));
        }

        if let Some(label) = x_label {
            let middle = self.left + 0.5 * self.width;
            out = out.add(text(label, (middle, self.bottom() + LABELS[0]), "middle"));
        }

        let (x, y) = (pixels(self.left - LABELS[1]), pixels(self.top + 0.5 * self.height));
        out.add(text(y_label, (x, y), "middle").set("transform", format!("rotate(-90 {x} {y})")))
    }

    /// The round numbers of both axes, with their place along it.
    fn numbers(&self) -> [Vec<(String, f64)>; 2] {
        let x = ticks(self.x, self.width / BETWEEN[0]).into_iter();
        let y = ticks(self.y, self.height / BETWEEN[1]).into_iter();
        [
            x.map(|tick| (tick.label, self.at((tick.value, self.y[0])).0)).collect(),
            y.map(|tick| (tick.label, self.at((self.x[0], tick.value)).1)).collect(),
        ]
    }
}

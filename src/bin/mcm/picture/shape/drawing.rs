//! Drawing of what is in the picture of a scene.

use svg::Document;
use svg::node::element::{Group, Path, Rectangle, SVG};

use super::outline::Outline;
use super::{INSIDE, Magnet, Picture, Remark};
use crate::picture::frame::Frame;
use crate::picture::style::{
    COLOURS, GREY, GRID, INK, LINE, TITLE, document, line, path, pixels, text, width,
};
use crate::picture::ticks::round_below;

/// Room at the left of the axes, above them and below them, pixels.
const LEFT: f64 = 86.0;
const TOP: f64 = 72.0;
const BELOW: f64 = 60.0;

/// Length of the longest arrow of a force, relative to the shorter side, and least force that is drawn, relative to the largest.
const ARROW: f64 = 0.16;
const LEAST: f64 = 0.02;

/// Length and half width of an arrow's head, and length of the arrow of the field, pixels.
const HEAD: [f64; 2] = [11.0, 4.5];
const FIELD_ARROW: f64 = 52.0;

/// Place of a remark above the lower edge of its source, pixels.
const REMARK: f64 = 12.0;

/// Most of the width that the scale takes.
const SCALE: f64 = 0.15;

const DEVICE: &str = COLOURS[0];
const FORCE: &str = COLOURS[1];
const FIELD: &str = COLOURS[2];
const VESSEL: &str = COLOURS[3];
const COIL: &str = COLOURS[4];

/// Colour and opacity of an area.
type Fill = (&'static str, f64);

const BODY: Fill = (DEVICE, 0.3);
const CORE: Fill = (DEVICE, 0.8);
const RING: Fill = (INK, 1.0);
const SHAFT: Fill = (GRID, 1.0);
const LUMEN: Fill = (VESSEL, 0.13);
const SOUTH: Fill = (GRID, 0.8);
const NORTH: Fill = (GREY, 0.55);
const WINDINGS: Fill = (COIL, 0.35);

impl Picture {
    pub(super) fn draw(&self) -> Document {
        let frame = self.frame();
        let per_newton = self.pixels_per_newton(&frame);
        let mut inside = self.draw_bodies(&frame);
        for [at, (x, y)] in &self.forces {
            let (end, length) = (frame.at(*at), per_newton * x.hypot(*y));
            if length >= LEAST * per_newton * self.full_force {
                inside = inside.add(arrow((end.0 - per_newton * x, end.1 + per_newton * y), end, FORCE));
            }
        }
        if let Some(((x, y), magnitude)) = self.field {
            // As long as it seems in the plane, in the corner at the upper right.
            let half = [x, y].map(|part| 0.5 * FIELD_ARROW * part / magnitude);
            let centre = (frame.right() - 40.0, frame.top + 40.0);
            if half[0].hypot(half[1]) > 1.0 {
                let ends = [-1.0, 1.0].map(|sign| (centre.0 + sign * half[0], centre.1 - sign * half[1]));
                inside = inside.add(arrow(ends[0], ends[1], FIELD));
            }
        }
        let [x, y] = self.view.labels();
        document((frame.bottom() + BELOW).round(), &self.title)
            .add(inside.add(scale_of(&frame)))
            .add(frame.axes(Some(&x), &y))
            .add(self.draw_legend(per_newton))
    }

    /// The axes, with the same scale along both.
    fn frame(&self) -> Frame {
        let [low, high] = self.corners;
        let height = INSIDE * (high.1 - low.1) / (high.0 - low.0);
        Frame { left: LEFT, top: TOP, width: INSIDE, height, x: [low.0, high.0], y: [low.1, high.1] }
    }

    pub(super) fn largest_force(&self) -> f64 {
        self.forces.iter().map(|[_, force]| force.0.hypot(force.1)).fold(0.0, f64::max)
    }

    fn pixels_per_newton(&self, frame: &Frame) -> f64 {
        ARROW * frame.width.min(frame.height) / self.full_force
    }

    fn draw_bodies(&self, frame: &Frame) -> SVG {
        let closed = |outline: &Outline| path(outline.iter().map(|point| frame.at(*point))) + "Z";
        let area = |class: &str, outlines: &[&Outline], (fill, opacity): Fill, edge: &str| {
            Path::new()
                .set("class", class)
                .set("d", outlines.iter().map(|outline| closed(outline)).collect::<String>())
                .set("fill", fill)
                .set("fill-opacity", opacity)
                .set("fill-rule", "evenodd")
                .set("stroke", edge)
                .set("stroke-width", 1.2)
        };

        let mut out = frame.inside();

        // From the back to the front: what is drawn later covers what lies behind.
        if !self.vessel.is_empty() {
            out = out.add(area("vessel", &self.vessel.iter().collect::<Vec<_>>(), LUMEN, VESSEL));
        }
        for coil in &self.coils {
            out = out.add(area("coil", &[coil], WINDINGS, COIL));
        }
        for Magnet { whole, northern, .. } in &self.magnet {
            out = out.add(area("magnet", &[whole], SOUTH, GREY)).add(area("north", &[northern], NORTH, GREY));
        }
        for shaft in &self.shaft {
            out = out.add(area("shaft", &[shaft], SHAFT, GREY));
        }

        for body in &self.device {
            out = out.add(area("device", &[body], BODY, DEVICE));
        }
        for core in &self.cores {
            out = out.add(area("core", &[core], CORE, DEVICE));
        }
        for ring in &self.rings {
            out = out.add(area("ring", &[ring], RING, INK));
        }
        out.add(self.draw_letters(frame))
    }

    /// N and S on the magnets, and how far sources are from the plane.
    fn draw_letters(&self, frame: &Frame) -> Group {
        let mut out = Group::new();
        let written = |words: &str, at| text(words, at, "middle").set("dominant-baseline", "central");
        for Magnet { poles, front, .. } in &self.magnet {
            let places = poles.map(|pole| frame.at(pole));
            let apart = (places[0].0 - places[1].0).hypot(places[0].1 - places[1].1);
            for (number, (letter, at)) in ["N", "S"].into_iter().zip(places).enumerate() {
                // Of a magnet that is seen along its axis, the pole in front hides the other one.
                if apart >= TITLE || number == *front {
                    out = out.add(written(letter, at).set("font-size", TITLE).set("class", "pole"));
                }
            }
        }
        for Remark { at, words } in &self.remarks {
            let (x, y) = frame.at(*at);
            let remark = written(words, (x, y - REMARK)).set("class", "depth").set("paint-order", "stroke");
            out = out.add(remark.set("stroke", "white").set("stroke-width", 3));
        }
        out
    }

    fn draw_legend(&self, per_newton: f64) -> Group {
        let segmented = !self.cores.is_empty();
        let rigid = if segmented { "rings" } else { "rigid" };
        let entries = [
            (if segmented { "spirals" } else { "rod" }, BODY, true),
            ("core", CORE, segmented),
            (rigid, RING, !self.rings.is_empty()),
            ("shaft", SHAFT, !self.shaft.is_empty()),
            ("vessel", LUMEN, !self.vessel.is_empty()),
            ("magnet", NORTH, !self.magnet.is_empty()),
            ("coils", WINDINGS, !self.coils.is_empty()),
        ];
        let (mut x, y) = (16.0, 52.0);
        let mut out = Group::new();
        let name = |words: &str, x: f64| text(words, (x, y), "start").set("dominant-baseline", "central");
        for (label, (fill, opacity), _) in entries.into_iter().filter(|(.., shown)| *shown) {
            let sample = Rectangle::new()
                .set("x", pixels(x))
                .set("y", y - 7.0)
                .set("width", 22)
                .set("height", 14)
                .set("fill", fill)
                .set("fill-opacity", opacity)
                .set("stroke", GREY)
                .set("stroke-width", 0.5);
            out = out.add(sample).add(name(label, x + 28.0));
            x += 46.0 + width(label);
        }
        let mut arrows = Vec::new();
        let largest = self.largest_force();
        if largest >= LEAST * self.full_force {
            let round = round_below(self.full_force);
            arrows.push((FORCE, round * per_newton, format!("wall, {} mN", decimals(1e3 * round, 6))));
        } else if largest > 0.0 {
            // An arrow that nobody could see, or one that looks like a force that matters, would both mislead.
            let words = format!("wall, at most {:.1e} mN: not drawn", 1e3 * largest);
            out = out.add(name(&words, x));
            x += 18.0 + width(&words);
        }
        if let Some((_, magnitude)) = self.field {
            arrows.push((FIELD, 26.0, format!("field, {} mT", decimals(magnitude, 2))));
        }
        for (colour, length, label) in arrows {
            out = out.add(arrow((x, y), (x + length, y), colour)).add(name(&label, x + length + 8.0));
            x += length + 26.0 + width(&label);
        }
        out
    }
}

/// A bar of a round length, in the corner at the lower right.
fn scale_of(frame: &Frame) -> Group {
    let per_mm = frame.width / (frame.x[1] - frame.x[0]);
    let length = round_below(SCALE * frame.width / per_mm);
    let (end, y) = (frame.right() - 16.0, frame.bottom() - 14.0);
    let start = end - length * per_mm;
    let label = text(&format!("{length} mm"), (0.5 * (start + end), y - 7.0), "middle");
    Group::new()
        .add(line([(start, y), (end, y)], INK, 3.0).set("class", "scale"))
        .add(label.set("paint-order", "stroke").set("stroke", "white").set("stroke-width", 3))
}

/// An arrow from one place to another, pixels.
fn arrow(from: (f64, f64), to: (f64, f64), colour: &str) -> Group {
    let length = (to.0 - from.0).hypot(to.1 - from.1);
    let (x, y) = ((to.0 - from.0) / length, (to.1 - from.1) / length);
    let [back, side] = HEAD.map(|size| size * (length / HEAD[0]).min(1.0));
    let neck = (to.0 - back * x, to.1 - back * y);
    let head = [to, (neck.0 - side * y, neck.1 + side * x), (neck.0 + side * y, neck.1 - side * x)];
    let head = Path::new().set("d", path(head) + "Z").set("fill", colour);
    Group::new().set("class", "arrow").add(line([from, neck], colour, LINE)).add(head)
}

/// A number with at most so many decimals.
fn decimals(value: f64, most: i32) -> String {
    let unit = 10_f64.powi(most);
    ((value * unit).round() / unit).to_string()
}

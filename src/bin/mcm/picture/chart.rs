//! Charts: curves and points over axes, in panels below one another.

use svg::Document;
use svg::node::element::{Circle, Group, Path, Rectangle};

use super::frame::Frame;
use super::labels::{Name, above, beside, room_beside};
use super::style::{COLOURS, GREY, INK, LINE, WIDTH, document, line, pixels, text, width};

/// Room at the left, at the right and at the top of the axes, and below them with and without numbers, pixels.
const LEFT: f64 = 88.0;
const RIGHT: f64 = 24.0;
const TOP: f64 = 44.0;
const BELOW: [f64; 2] = [60.0, 18.0];

/// Height of the axes, alone and below one another, pixels.
const ALONE: f64 = 440.0;
const STACKED: f64 = 230.0;

/// Most of the width that names of curves may take, pixels.
const MOST_FOR_NAMES: f64 = 300.0;

/// Room around the values, relative to their range.
const AIR: f64 = 0.04;

/// Radius of a point, and of the ring around a snap, pixels.
const POINT: f64 = 3.2;
const RING: f64 = 5.5;

/// A picture of panels.
pub(crate) struct Chart {
    pub(crate) title: String,
    /// Whether all panels share the abscissa, which then has its numbers and label at the lowest.
    pub(crate) one_abscissa: bool,
    pub(crate) panels: Vec<Panel>,
}

/// Curves on one pair of axes.
pub(crate) struct Panel {
    /// Labels of the axes, with units.
    pub(crate) labels: [String; 2],
    pub(crate) curves: Vec<Curve>,
    /// A band of the ordinate: its name and its limits.
    pub(crate) band: Option<(String, [f64; 2])>,
}

/// A curve, which may consist of several parts.
pub(crate) struct Curve {
    /// Its name; empty for none.
    pub(crate) name: String,
    pub(crate) colour: String,
    pub(crate) runs: Vec<Run>,
    /// Where it has snapped to.
    pub(crate) snaps: Vec<(f64, f64)>,
}

/// A part of a curve.
pub(crate) struct Run {
    pub(crate) stroke: Stroke,
    pub(crate) points: Vec<(f64, f64)>,
}

/// How a part of a curve is drawn; a part of one point is always drawn as one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Stroke {
    Solid,
    Dashed,
    /// Unstable, or no curve at all: a jump.
    Dotted,
    /// A point for each pair of values.
    Points,
}

/// The colour of a curve among so many: of a few one of those that are easy to distinguish, else from blue to orange.
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a colour between two others")]
pub(crate) fn colour(number: usize, count: usize) -> String {
    if count <= COLOURS.len() {
        return COLOURS[number].into();
    }
    let share = number as f64 / (count - 1) as f64;
    let [from, to] = [[0.0, 114.0, 178.0], [230.0, 159.0, 0.0]];
    let part = |i: usize| (from[i] + share * (to[i] - from[i])).round() as u8;
    format!("#{:02x}{:02x}{:02x}", part(0), part(1), part(2))
}

impl Chart {
    /// The picture.
    pub(crate) fn draw(&self) -> Document {
        let height = if self.panels.len() > 1 { STACKED } else { ALONE };
        let names = || self.panels.iter().map(|panel| panel.names().map(|(name, _)| name));
        let rooms = names().map(|names| room_beside(names, height, MOST_FOR_NAMES));
        let beside = rooms.collect::<Option<Vec<f64>>>().map(|rooms| rooms.into_iter().fold(RIGHT, f64::max));
        let mut top = TOP;
        let mut parts = Vec::new();
        parts.extend(self.draw_key());
        for (number, panel) in self.panels.iter().enumerate() {
            let numbers = !self.one_abscissa || number + 1 == self.panels.len();
            if beside.is_none() && (number == 0 || !self.one_abscissa) {
                let (names, below) = above(panel.names(), [LEFT, WIDTH - RIGHT], top);
                parts.push(names);
                top = below + 8.0;
            }
            let width = WIDTH - LEFT - beside.unwrap_or(RIGHT);
            let frame =
                Frame { left: LEFT, top, width, height, x: self.abscissa(panel), y: panel.ordinate() };
            parts.push(panel.draw(&frame, numbers, beside.is_some()));
            top = frame.bottom() + BELOW[usize::from(!numbers)];
        }
        parts.into_iter().fold(document(top, &self.title), Document::add)
    }

    /// What rings and dotted parts mean, if there are any.
    fn draw_key(&self) -> Option<Group> {
        let curves = || self.panels.iter().flat_map(|panel| &panel.curves);
        let snapped = curves().any(|curve| !curve.snaps.is_empty());
        let dotted = curves().flat_map(|curve| &curve.runs).any(|run| run.stroke == Stroke::Dotted);
        let words = match (snapped, dotted) {
            (false, false) => return None,
            (false, true) => "dotted: unstable or not converged",
            (true, _) => "snap; dotted: a jump, unstable or not converged",
        };
        let (left, y) = (WIDTH - RIGHT - width(words), 26.0);
        let key = Group::new().add(text(words, (left, y), "start"));
        Some(if snapped { key.add(ring((left - 2.0 * RING, y - 5.0))) } else { key })
    }

    fn abscissa(&self, panel: &Panel) -> [f64; 2] {
        let own: Vec<&Panel> = if self.one_abscissa { self.panels.iter().collect() } else { vec![panel] };
        around(own.iter().flat_map(|panel| panel.points()).map(|(x, _)| x), AIR / 2.0)
    }
}

impl Panel {
    /// Name and colour of each curve, and of the band, that has a name.
    fn names(&self) -> impl Iterator<Item = (&str, &str)> {
        let curves = self.curves.iter().map(|curve| (curve.name.as_str(), curve.colour.as_str()));
        let band = self.band.iter().map(|(name, _)| (name.as_str(), GREY));
        curves.chain(band).filter(|(name, _)| !name.is_empty())
    }

    fn points(&self) -> impl Iterator<Item = (f64, f64)> {
        self.curves.iter().flat_map(|curve| &curve.runs).flat_map(|run| run.points.iter().copied())
    }

    fn ordinate(&self) -> [f64; 2] {
        let band = self.band.iter().flat_map(|(_, limits)| *limits);
        around(self.points().map(|(_, y)| y).chain(band), AIR)
    }

    fn draw(&self, frame: &Frame, numbers: bool, named: bool) -> Group {
        let mut inside = frame.inside().add(frame.grid());
        if let Some((_, [low, high])) = &self.band {
            let (corner, other) = (frame.at((frame.x[0], *high)), frame.at((frame.x[1], *low)));
            let band = Rectangle::new()
                .set("x", pixels(corner.0))
                .set("y", pixels(corner.1))
                .set("width", pixels(other.0 - corner.0))
                .set("height", pixels(other.1 - corner.1))
                .set("fill", GREY)
                .set("fill-opacity", 0.25)
                .set("class", "band");
            inside = inside.add(band);
        }

        for curve in &self.curves {
            inside = inside.add(curve.draw(frame));
        }

        let [x, y] = &self.labels;
        let out = Group::new().add(inside).add(frame.axes(numbers.then_some(x.as_str()), y));
        if !named {
            return out;
        }

        let ends = self.curves.iter().filter(|curve| !curve.name.is_empty()).filter_map(|curve| {
            Some(Name { words: &curve.name, colour: &curve.colour, end: frame.at(curve.end()?) })
        });
        let band = self.band.iter().map(|(name, [low, high])| Name {
            words: name,
            colour: GREY,
            end: frame.at((frame.x[1], 0.5 * (low + high))),
        });

        out.add(beside(ends.chain(band).collect(), frame.right(), [frame.top, frame.bottom()]))
    }
}

impl Curve {
    /// The last of its points in the direction of the abscissa.
    fn end(&self) -> Option<(f64, f64)> {
        let points = self.runs.iter().flat_map(|run| run.points.iter().copied());
        points.max_by(|a, b| a.0.total_cmp(&b.0))
    }

    fn draw(&self, frame: &Frame) -> Group {
        let mut out = Group::new().set("class", "curve").set("fill", self.colour.as_str());
        for Run { stroke, points } in &self.runs {
            if *stroke == Stroke::Points || points.len() == 1 {
                for (x, y) in points.iter().map(|point| frame.at(*point)) {
                    out = out.add(Circle::new().set("cx", pixels(x)).set("cy", pixels(y)).set("r", POINT));
                }
                continue;
            }
            let run = line(points.iter().map(|point| frame.at(*point)), &self.colour, LINE);
            out = out.add(dashed(run, *stroke));
        }
        self.snaps.iter().fold(out, |out, snap| out.add(ring(frame.at(*snap))))
    }
}

fn dashed(run: Path, stroke: Stroke) -> Path {
    match stroke {
        Stroke::Dashed => run.set("stroke-dasharray", "9 4"),
        Stroke::Dotted => run.set("stroke-dasharray", "2 4"),
        Stroke::Solid | Stroke::Points => run,
    }
}

/// The mark of a snap.
fn ring((x, y): (f64, f64)) -> Circle {
    Circle::new()
        .set("class", "snap")
        .set("cx", pixels(x))
        .set("cy", pixels(y))
        .set("r", RING)
        .set("fill", "none")
        .set("stroke", INK)
        .set("stroke-width", 1.5)
}

/// The range of these values with some room; around a single value one that shows it.
fn around(values: impl Iterator<Item = f64>, air: f64) -> [f64; 2] {
    let [low, high] = values
        .map(|value| [value, value])
        .reduce(|[low, high], [value, _]| [low.min(value), high.max(value)])
        .unwrap_or([0.0, 1.0]);
    // Differences by rounding alone are none.
    let range = high - low;
    let size = low.abs().max(high.abs());
    if range <= 1e-9 * size || range == 0.0 {
        let half = if size > 0.0 { 0.5 * size } else { 1.0 };
        return [low - half, high + half];
    }
    [low - air * range, high + air * range]
}

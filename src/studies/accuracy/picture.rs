//! Chart of error against time: our methods in one scene, and other software in its own cases.

use super::{Point, front};
use crate::studies::study::{Mark, Panel, Series, Stroke, Study};

/// Field, number of segments, level and start of the plotted case: the paper's device beside its magnet.
const DRAWN: (&str, usize, &str, &str) = ("pair", 9, "rings", "warm");

/// A case that other software solves as well.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Peered {
    /// Name in the table of peers.
    pub name: &'static str,
    title: &'static str,
    x: &'static str,
    y: &'static str,
}

/// The cases that other software solves as well, in the order of the chart.
pub const PEERS: [Peered; 3] = [
    Peered {
        name: "tip dipole",
        title: "one core with a dipole at its tip",
        x: "time of a solve (us); dashed: cold",
        y: "error of the angle (rad)",
    },
    Peered {
        name: "ring near",
        title: "field of a ring, 2 to 6 radii away",
        x: "time of a point (us); dashed: with gradient",
        y: "relative error, median",
    },
    Peered {
        name: "ring far",
        title: "field of a ring, 17 to 48 radii away",
        x: "time of a point (us); dashed: with gradient",
        y: "relative error, median",
    },
];

/// Chart of nine segments beside the magnet pair, and of those cases of [`PEERS`] that have series: errors over times
/// in microseconds.
#[must_use]
pub fn accuracy_picture(points: &[Point], peers: [Vec<Series>; PEERS.len()]) -> Study {
    let (field, segments, level, start) = DRAWN;
    let drawn: Vec<&Point> = points
        .iter()
        .filter(|p| (p.field, p.segments, p.interaction, p.start) == (field, segments, level, start))
        .collect();
    let mut series: Vec<Series> = Vec::new();
    for (name, colour, stroke) in [
        ("potential", 0, Stroke::Dots),
        ("collocation", 2, Stroke::Solid),
        ("multiple-shooting", 3, Stroke::Solid),
        ("shooting", 1, Stroke::Solid),
        ("shooting-fd", 1, Stroke::Dashed),
        ("planar", 4, Stroke::Solid),
        ("constant-curvature", 5, Stroke::Dots),
    ] {
        let places = drawn.iter().filter(|p| p.name == name).filter_map(|p| p.place()).collect();
        series.push(Series { label: name.into(), colour, stroke, places });
    }
    let known = drawn.first().and_then(|p| p.reference_over_length);
    let known = known.map(|error| Mark::Level("as well as it is known".into(), error));
    let best = front(drawn.iter().copied()).into_iter().filter_map(Point::place).enumerate();
    let label = |i: usize| if i == 0 { "nobody is faster and better".into() } else { String::new() };
    let mut panels = vec![Panel::Places {
        title: "nine segments beside the magnet pair, rings".into(),
        x: "time of a warm solve (us)".into(),
        y: "error of the tip over the length".into(),
        series,
        marks: best.map(|(i, place)| Mark::Point(label(i), place)).chain(known).collect(),
    }];
    for (case, series) in PEERS.iter().zip(peers).filter(|(_, series)| !series.is_empty()) {
        panels.push(Panel::Places {
            title: case.title.into(),
            x: case.x.into(),
            y: case.y.into(),
            series,
            marks: Vec::new(),
        });
    }
    Study {
        title: "Error against time: left and below is better",
        columns: vec![],
        panels,
        comparison: vec![],
    }
}

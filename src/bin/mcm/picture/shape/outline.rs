//! Outlines in a plane: of a vessel, and of cylinders.

use mcm::geometry::Pose;
use mcm::magnetics::{Outline as Solid, Part};
use mcm::nalgebra::Vector3;
use mcm::vessel::Lumen;
use rayon::prelude::*;

use super::view::View;

/// Number of places along the longer side at which the vessel is looked at.
const COLUMNS: f64 = 320.0;

/// Number of corners with which a circle is drawn.
const AROUND: usize = 40;

/// Number of places along a branch at which its size is looked at.
const ALONG: u32 = 200;

/// A value outside a lumen, m.
const OUTSIDE: f64 = -1.0;

/// A closed line in the plane, mm.
pub(super) type Outline = Vec<(f64, f64)>;

/// Numbers on a grid in the plane.
pub(super) struct Grid {
    /// Coordinates of the first node, and distance of two nodes, mm.
    pub(super) first: (f64, f64),
    pub(super) step: f64,
    /// Number of nodes in a row.
    pub(super) columns: usize,
    /// Row by row.
    pub(super) values: Vec<f64>,
}

/// How far inside a lumen the lines of sight come (m) that go through the places between two corners (mm), and two nodes more on
/// each side: negative outside the lumen, and on the border of the grid.
pub(super) fn depth_in_lumen(lumen: &Lumen, view: &View, [low, high]: [(f64, f64); 2]) -> Grid {
    let step = (high.0 - low.0).max(high.1 - low.1) / COLUMNS;
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most some hundred")]
    let [columns, rows] = [high.0 - low.0, high.1 - low.1].map(|side| (side / step).round() as usize + 5);
    let first = (low.0 - 2.0 * step, low.1 - 2.0 * step);
    let depths = depths(lumen, view);
    let rows_of_values = (0..rows).into_par_iter().map(|row| {
        if row == 0 || row + 1 == rows {
            return vec![OUTSIDE; columns];
        }
        let mut values: Vec<f64> = Vec::with_capacity(columns);
        while values.len() < columns {
            let place = (first.0 + step * values.len() as f64, first.1 + step * row as f64);
            let deepest = deepest(lumen, view, place, depths, 1e-3 * step);
            values.push(deepest);
            // Beside it the clearance can differ by no more than the distance; between two places along the line of sight it
            // may be half as far.
            let mut left = 0.5 * 1e3 * deepest.abs() - step;
            while left > 2.0 * step && values.len() < columns {
                values.push(1e-3 * left * deepest.signum());
                left -= step;
            }
        }
        (values[0], values[columns - 1]) = (OUTSIDE, OUTSIDE);
        values
    });
    Grid { first, step, columns, values: rows_of_values.flatten_iter().collect() }
}

/// Largest clearance (m) along the line of sight through a place, as far as it matters for an outline at this resolution (m).
fn deepest(lumen: &Lumen, view: &View, place: (f64, f64), [from, to]: [f64; 2], step: f64) -> f64 {
    let (mut depth, mut largest) = (from, f64::NEG_INFINITY);
    while depth <= to {
        let clearance = lumen.clearance(&view.point(place, depth)).value;
        largest = largest.max(clearance);
        if clearance > 2.0 * step {
            break;
        }
        // Within its distance from a point there is no wall.
        depth += clearance.abs().max(0.5 * step);
    }
    largest
}

/// The depths (m) between which a lumen lies.
fn depths(lumen: &Lumen, view: &View) -> [f64; 2] {
    let balls = lumen.branches().iter().flat_map(|branch| {
        let length = *branch.range().end();
        (0..=ALONG).map(move |i| branch.ball(length * f64::from(i) / f64::from(ALONG)))
    });
    let corners = lumen.grid().into_iter().flat_map(|grid| {
        let ends = grid.bounds();
        (0..8).map(move |corner: usize| (Vector3::from_fn(|axis, _| ends[corner >> axis & 1][axis]), 0.0))
    });
    balls.chain(corners).fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], (centre, radius)| {
        let depth = view.towards.dot(&centre);
        [low.min(depth - radius), high.max(depth + radius)]
    })
}

/// Outline of a part of a magnet or coil at this pose.
pub(super) fn of_part(view: &View, pose: &Pose, part: &Part) -> Outline {
    hull(places(part).map(|place| view.at(&pose.transform(&(part.centre + place)))).collect())
}

/// Outline of the half of a part that lies towards a unit vector of its frame, as seen from its centre.
pub(super) fn of_half(view: &View, pose: &Pose, part: &Part, towards: &Vector3<f64>) -> Outline {
    let all: Vec<Vector3<f64>> = places(part).collect();
    let height = |place: &Vector3<f64>| place.dot(towards);
    let (ahead, behind): (Vec<_>, Vec<_>) = all.into_iter().partition(|place| height(place) > 0.0);

    // Where the lines between the halves cut the middle: their hull is the cut through the body.
    let cut = ahead.iter().flat_map(|one| {
        behind.iter().map(move |other| {
            let share = height(one) / (height(one) - height(other));
            one + (other - one) * share
        })
    });
    let half = ahead.iter().copied().chain(cut.collect::<Vec<_>>());
    hull(half.map(|place| view.at(&pose.transform(&(part.centre + place)))).collect())
}

/// Places on the surface of a part, from its centre, of which it is the convex hull, m.
fn places(part: &Part) -> Box<dyn Iterator<Item = Vector3<f64>>> {
    let circle = |radius: f64, height: f64| {
        (0..AROUND).map(move |i| {
            let (sine, cosine) = (core::f64::consts::TAU * i as f64 / AROUND as f64).sin_cos();
            Vector3::new(radius * cosine, radius * sine, height)
        })
    };
    match part.outline {
        Solid::Cylinder(body) => {
            let (radius, half) = (body.outer_radius(), 0.5 * body.length());
            Box::new(circle(radius, -half).chain(circle(radius, half)))
        }
        Solid::Cuboid(half) => Box::new((0..8).map(move |corner: usize| {
            Vector3::from_fn(|axis, _| if corner >> axis & 1 == 1 { half[axis] } else { -half[axis] })
        })),
        Solid::Sphere(radius) => Box::new((0..=AROUND / 2).flat_map(move |step| {
            let (sine, cosine) = (core::f64::consts::TAU * step as f64 / AROUND as f64).sin_cos();
            circle(radius * sine, radius * cosine)
        })),
    }
}

/// Outline of a cylinder around the axis of `pose`, between two heights (m) over its origin.
pub(super) fn of_cylinder(view: &View, pose: &Pose, heights: [f64; 2], radius: f64) -> Outline {
    let rim = |height: f64| {
        (0..AROUND).map(move |i| {
            let (sine, cosine) = (core::f64::consts::TAU * i as f64 / AROUND as f64).sin_cos();
            view.at(&pose.transform(&Vector3::new(radius * cosine, radius * sine, height)))
        })
    };
    hull(heights.into_iter().flat_map(rim).collect())
}

/// Outline of a rod along these points, with these radii at its start and its end, m.
pub(super) fn of_rod(view: &View, points: &[Vector3<f64>], [start, end]: [f64; 2]) -> Outline {
    let places: Vec<(f64, f64)> = points.iter().map(|point| view.at(point)).collect();
    let side = |sign: f64| {
        let places = &places;
        (0..places.len()).map(move |i| {
            let (before, after) = (places[i.saturating_sub(1)], places[(i + 1).min(places.len() - 1)]);
            let (x, y) = (after.0 - before.0, after.1 - before.1);
            let radius = start + (end - start) * i as f64 / (places.len() - 1).max(1) as f64;
            let factor = sign * 1e3 * radius / x.hypot(y).max(f64::MIN_POSITIVE);
            (places[i].0 - factor * y, places[i].1 + factor * x)
        })
    };
    side(1.0).chain(side(-1.0).rev()).collect()
}

/// Convex hull, by A. M. Andrew, Another efficient algorithm for convex hulls in two dimensions,
/// doi 10.1016/0020-0190(79)90072-3.
fn hull(mut points: Outline) -> Outline {
    points.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
    let chain = |points: &mut dyn Iterator<Item = (f64, f64)>| {
        let mut out: Vec<(f64, f64)> = Vec::new();
        for point in points {
            while let [.., a, b] = out[..]
                && (b.0 - a.0) * (point.1 - a.1) <= (b.1 - a.1) * (point.0 - a.0)
            {
                out.pop();
            }
            out.push(point);
        }
        out.pop();
        out
    };
    let mut out = chain(&mut points.iter().copied());
    out.extend(chain(&mut points.iter().rev().copied()));
    out
}

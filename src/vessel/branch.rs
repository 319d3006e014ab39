//! One vessel: the union of the balls along a centreline.

use core::ops::{Range, RangeInclusive};

use nalgebra::{Vector3, Vector4};

use super::clearance::Clearance;
use crate::error::{Error, check};
use crate::geometry::Pose;
use crate::numerics::spline::{CurvePoint, Spline};

/// Largest turn of the centreline within a piece, rad: within it only one ball is locally the nearest.
const TURN: f64 = 0.2;

/// Largest number of pieces of one interval between two points.
const MOST_PIECES: usize = 64;

/// Number of pieces in a group.
const GROUPED: usize = 8;

/// Steps of the search for the nearest ball; half of them suffice by bisection alone.
const STEPS: usize = 100;

/// Newton's step, relative to the parameter, after which nothing but rounding is left.
const FOUND: f64 = 1e-13;

/// Places per piece at which the radius is checked.
const CHECKED: usize = 4;

/// A vessel along a smooth centreline (a cubic spline, C2) whose radius changes as smoothly.
///
/// The lumen is the union of the balls around all points of the centreline, so that each end is half a ball. The clearance of
/// a point `x` is the largest of `r(t) - |x - c(t)|`.
///
/// ```
/// use mcm::vessel::Branch;
/// use nalgebra::Vector3;
/// let points = [[0.0, 0.0, 0.0], [0.0, 0.0, 0.05], [0.0, 0.0, 0.1]].map(Vector3::from);
/// let straight = Branch::new("straight", &points, &[4e-3; 3])?;
/// let clearance = straight.clearance(&Vector3::new(3e-3, 0.0, 0.04));
/// assert!((clearance.value - 1e-3).abs() < 1e-12);
/// assert!((clearance.gradient + Vector3::x()).norm() < 1e-9); // the wall is at +x
/// assert!(Branch::new("closed", &points, &[4e-3, 0.0, 4e-3]).is_err());
/// # Ok::<(), mcm::error::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Branch {
    name: String,
    /// Centre (m) and radius (m) over the length of the chords between the points.
    curve: Spline<4>,
    pieces: Vec<Piece>,
    /// Pieces that follow one another, with a hull around them.
    groups: Vec<(Range<usize>, Hull)>,
    /// The hull of all of it.
    whole: Hull,
}

/// A part of the centreline within one interval of its points.
#[derive(Debug, Clone, PartialEq)]
struct Piece {
    interval: usize,
    range: [f64; 2],
    /// The centreline at both.
    ends: [CurvePoint<4>; 2],
    hull: Hull,
}

/// What is around a part of the vessel.
#[derive(Debug, Clone, PartialEq)]
struct Hull {
    /// A ball around the centreline: centre and radius, m.
    centre: Vector3<f64>,
    around: f64,
    /// Largest radius of the vessel, m.
    widest: f64,
}

impl Hull {
    /// Around these pieces.
    fn of(pieces: &[Piece]) -> Self {
        let hulls = || pieces.iter().map(|piece| &piece.hull);
        let centre = hulls().map(|hull| hull.centre).sum::<Vector3<f64>>() / pieces.len() as f64;
        let around = hulls().map(|hull| (hull.centre - centre).norm() + hull.around).fold(0.0, f64::max);
        let widest = hulls().map(|hull| hull.widest).fold(0.0, f64::max);
        Self { centre, around, widest }
    }

    /// Upper bound of the clearance of a point in the balls inside.
    fn bound(&self, point: &Vector3<f64>) -> f64 {
        self.widest + self.around - (point - self.centre).norm()
    }
}

/// Numbers with their bounds, that of the largest bound first, which counts as unbounded.
fn largest_first(bounds: impl Iterator<Item = (f64, usize)> + Clone) -> impl Iterator<Item = (f64, usize)> {
    let first = bounds.clone().max_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, number)| number);
    let others = bounds.filter(move |(_, number)| Some(*number) != first);
    first.map(|number| (f64::INFINITY, number)).into_iter().chain(others)
}

/// The ball that is locally the nearest to a point.
struct Nearest {
    place: CurvePoint<4>,
    /// Whether it is inside the centreline, where its place moves with the point.
    moves: bool,
    value: f64,
}

impl Branch {
    /// A vessel of this name through `points` (m) with these radii (m), one for each.
    ///
    /// # Errors
    /// [`Error::Count`] for fewer than two points or another number of radii; [`Error::Range`] for numbers that are not finite,
    /// points that coincide, and where the radius is not positive, grows as fast as the arc length, or is larger than the
    /// centreline's radius of curvature.
    pub fn new(name: &str, points: &[Vector3<f64>], radii: &[f64]) -> Result<Self, Error> {
        if points.len() < 2 || radii.len() != points.len() {
            return Err(Error::Count {
                quantity: format!("list of radii of vessel branch \"{name}\""),
                given: radii.len(),
                expected: format!("{}, one for each of at least 2 points", points.len()),
            });
        }

        for value in points.iter().flat_map(Vector3::iter).chain(radii) {
            check(
                &format!("coordinate or radius (m) of vessel branch \"{name}\""),
                *value,
                |_| true,
                "finite",
            )?;
        }

        // Knots at the chords' lengths: the spline then runs nearly at unit speed, without loops between
        // unequal points.
        let mut knots = vec![0.0];
        for (number, pair) in (2..).zip(points.windows(2)) {
            let quantity =
                format!("distance (m) of point {number} of vessel branch \"{name}\" from the one before");
            let chord = check(&quantity, (pair[1] - pair[0]).norm(), |v| v > 0.0, "> 0")?;
            knots.push(knots[knots.len() - 1] + chord);
        }

        let values = points.iter().zip(radii).map(|(c, r)| Vector4::new(c.x, c.y, c.z, *r)).collect();
        let curve = Spline::new(knots, values)?;
        let pieces = pieces(&curve);

        // Balls around groups of pieces, and around all: a look-up passes over most of them.
        let starts = (0..pieces.len()).step_by(GROUPED).map(|i| i..(i + GROUPED).min(pieces.len()));
        let groups = starts.map(|range| (range.clone(), Hull::of(&pieces[range]))).collect();
        let whole = Hull::of(&pieces);

        let branch = Self { name: name.into(), curve, pieces, groups, whole };
        branch.check_radii()?;
        Ok(branch)
    }

    /// What all else follows from.
    pub(super) fn course(&self) -> &impl core::fmt::Debug {
        &self.curve
    }

    /// Its name.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Range of the centreline's parameter, m: from 0 to the length of the chords between its points.
    #[must_use]
    pub fn range(&self) -> RangeInclusive<f64> {
        self.curve.range()
    }

    /// Centre (m) and radius (m) at parameter `t` (m).
    #[must_use]
    pub fn ball(&self, t: f64) -> (Vector3<f64>, f64) {
        let value = self.curve.at(t).value;
        (value.xyz(), value.w)
    }

    /// Whether its centreline lies on the axis of `frame`.
    pub(super) fn is_coaxial_with(&self, frame: &Pose) -> bool {
        // A spline through points on a line stays on it.
        self.pieces.iter().flat_map(|piece| &piece.ends).all(|end| frame.is_on_axis(&end.value.xyz()))
    }

    /// Distance from `point` (m) to the wall, with exact derivatives.
    ///
    /// With `rho` the distance from the nearest ball's centre `c(t)`, `n` the direction from there and `P = I - n n^T`, the
    /// gradient is `-n` and the second derivative `-P/rho + (P c')(P c')^T / (rho^2 |phi''|)`, where
    /// `phi'' = r'' + n.c'' - |P c'|^2 / rho`; at an end the second part is missing.
    #[must_use]
    pub fn clearance(&self, point: &Vector3<f64>) -> Clearance {
        // There are always two ends, whose depths are numbers.
        self.clearance_above(point, f64::NEG_INFINITY).unwrap_or_else(|| {
            let (centre, radius) = self.ball(0.0);
            Clearance::in_ball(radius, &(point - centre))
        })
    }

    /// Clearance of a point; `None` if that is not larger than `least` (m).
    pub(super) fn clearance_above(&self, point: &Vector3<f64>, least: f64) -> Option<Clearance> {
        let nearest = self.nearest(point, least)?;
        let offset = point - nearest.place.value.xyz();
        let mut out = Clearance::in_ball(nearest.place.value.w, &offset);
        let distance = offset.norm();
        if nearest.moves && distance > 0.0 {
            let across = across(&nearest.place, &offset, distance);
            let bend = second(&nearest.place, &offset, distance);
            out.hessian -= across * across.transpose() / (distance * distance * bend);
        }
        Some(out)
    }

    /// Upper bound of the clearance of a point (m), at little cost.
    pub(super) fn bound(&self, point: &Vector3<f64>) -> f64 {
        let whole = self.whole.bound(point);
        let groups =
            || self.groups.iter().map(|(_, hull)| hull.bound(point)).fold(f64::NEG_INFINITY, f64::max);
        if whole < 0.0 { whole } else { groups() }
    }

    /// The ball in which the point is deepest; `None` if that is not deeper than `least` (m).
    fn nearest(&self, point: &Vector3<f64>, least: f64) -> Option<Nearest> {
        let mut best: Option<Nearest> = None;
        let reaches =
            |bound: f64, best: &Option<Nearest>| bound > best.as_ref().map_or(least, |best| best.value);
        if !reaches(self.whole.bound(point), &best) {
            return None;
        }
        for (piece, end) in [(self.pieces.first()?, 0), (self.pieces.last()?, 1)] {
            let place = piece.ends[end];
            let value = depth(&place, point);
            if reaches(value, &best) {
                best = Some(Nearest { place, moves: false, value });
            }
        }
        // What may be nearest comes first, so that most of the rest needs no search.
        let groups = self.groups.iter().enumerate();
        for (bound, group) in largest_first(groups.map(|(number, (_, hull))| (hull.bound(point), number))) {
            if !reaches(bound, &best) {
                continue;
            }
            let pieces = self.groups[group].0.clone();
            let bounds = pieces.map(|number| (self.pieces[number].hull.bound(point), number));
            for (bound, number) in largest_first(bounds) {
                if !reaches(bound, &best) {
                    continue;
                }
                if let Some(place) = self.local_maximum(&self.pieces[number], point) {
                    let value = depth(&place, point);
                    if reaches(value, &best) {
                        best = Some(Nearest { place, moves: true, value });
                    }
                }
            }
        }
        best
    }

    /// The place within a piece where the point is deepest in the ball; `None` where that is deeper in a neighbouring piece.
    ///
    /// Newton's method for the zero of the derivative, kept within a bracket by bisection.
    fn local_maximum(&self, piece: &Piece, point: &Vector3<f64>) -> Option<CurvePoint<4>> {
        // Derivative of the depth r(t) - |p - c(t)| along the centreline; on the centreline itself, that of
        // the radius alone.
        let slope = |place: &CurvePoint<4>| {
            let offset = point - place.value.xyz();
            let distance = offset.norm();
            if distance == 0.0 {
                place.first.w
            } else {
                place.first.w + offset.dot(&place.first.xyz()) / distance
            }
        };

        let [mut low, mut high] = piece.range;
        let [rise, fall] = [slope(&piece.ends[0]), slope(&piece.ends[1])];
        if rise < 0.0 || fall > 0.0 {
            return None;
        }

        let at = |t: f64| self.curve.within(piece.interval, t);
        let mut t = if rise > fall { low + (high - low) * rise / (rise - fall) } else { low };
        let mut place = at(t);

        for _ in 0..STEPS {
            let rise = slope(&place);

            *(if rise > 0.0 { &mut low } else { &mut high }) = t;
            let offset = point - place.value.xyz();
            let bend = second(&place, &offset, offset.norm());
            let newton = t - rise / bend;
            let found = (newton - t).abs() <= FOUND * piece.range[1];

            let next = if found || newton > low && newton < high { newton } else { 0.5 * (low + high) };
            if found || (next - t).abs() <= f64::EPSILON * piece.range[1] {
                place = at(next);
                break;
            }
            (t, place) = (next, at(next));
        }

        Some(place)
    }

    fn check_radii(&self) -> Result<(), Error> {
        for piece in &self.pieces {
            let [low, high] = piece.range;
            for part in 0..=CHECKED {
                let t = low + (high - low) * part as f64 / CHECKED as f64;
                let CurvePoint { value, first, second } = self.curve.within(piece.interval, t);

                let (centre, along) = (value.xyz() * 1e3, first.xyz());
                let here = |what: &str| {
                    let [x, y, z] = [centre.x, centre.y, centre.z];
                    format!("{what} of vessel branch \"{}\" at ({x:.1}, {y:.1}, {z:.1}) mm", self.name)
                };

                // Where the radius changes as fast as the arc length, each ball holds its neighbour, and no
                // wall is left.
                check(&here("radius (m)"), value.w, |v| v > 0.0, "> 0")?;
                let taper = first.w / along.norm();
                check(
                    &here("change of the radius per length"),
                    taper,
                    |v| v.abs() < 1.0,
                    "between -1 and 1",
                )?;

                let curvature = along.cross(&second.xyz()).norm() / along.norm().powi(3);
                let quantity = here("radius times curvature of the centreline");
                check(&quantity, value.w * curvature, |v| v < 1.0, "< 1, or the wall would fold")?;
            }
        }
        Ok(())
    }
}

/// Depth (m) of a point in the ball at a place.
fn depth(place: &CurvePoint<4>, point: &Vector3<f64>) -> f64 {
    place.value.w - (point - place.value.xyz()).norm()
}

/// `P c'`: how the nearest ball's centre moves across the direction to the point.
fn across(place: &CurvePoint<4>, offset: &Vector3<f64>, distance: f64) -> Vector3<f64> {
    let along = place.first.xyz();
    along - offset * (offset.dot(&along) / (distance * distance))
}

/// Second derivative of the depth in the ball by the centreline's parameter.
fn second(place: &CurvePoint<4>, offset: &Vector3<f64>, distance: f64) -> f64 {
    let across = across(place, offset, distance).norm_squared();
    place.second.w + (offset.dot(&place.second.xyz()) - across) / distance
}

/// Parts of the centreline that turn little.
fn pieces(curve: &Spline<4>) -> Vec<Piece> {
    let mut out = Vec::new();
    for (interval, ends) in curve.knots().windows(2).enumerate() {
        let place = |t: f64| curve.within(interval, t);
        let tangents: Vec<Vector3<f64>> = (0..=CHECKED)
            .map(|i| place(ends[0] + (ends[1] - ends[0]) * i as f64 / CHECKED as f64).first.xyz())
            .collect();
        let turn: f64 = tangents.windows(2).map(|pair| pair[0].angle(&pair[1])).sum();
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small count")]
        let count = ((turn / TURN).ceil() as usize).clamp(1, MOST_PIECES);
        for part in 0..count {
            let at = |share: f64| ends[0] + (ends[1] - ends[0]) * ((part as f64 + share) / count as f64);
            let range = [at(0.0), at(1.0)];
            let centre = place(at(0.5)).value.xyz();
            let samples = (0..=2 * CHECKED).map(|i| place(at(i as f64 / (2 * CHECKED) as f64)));
            let (mut around, mut widest, mut fastest) = (0.0_f64, 0.0_f64, 0.0_f64);
            for sample in samples {
                around = around.max((sample.value.xyz() - centre).norm());
                widest = widest.max(sample.value.w);
                fastest = fastest.max(sample.first.norm());
            }
            // Between two samples neither can change by more than half their distance at the fastest rate.
            let slack = fastest * (range[1] - range[0]) / (4 * CHECKED) as f64;
            let hull = Hull { centre, around: around + slack, widest: widest + slack };
            out.push(Piece { interval, range, ends: range.map(place), hull });
        }
    }
    out
}

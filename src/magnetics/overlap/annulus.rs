//! Depth of a cylinder, ring or flat disc in another one.

use core::f64::consts::FRAC_PI_2;

use nalgebra::Vector3;

use super::PARTS;
use crate::geometry::Pose;
use crate::numerics::maximum::largest;

/// A cylinder or ring about its frame's `z`, centred at the origin, or a flat disc of no height.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Annulus {
    pub(super) inner: f64,
    pub(super) outer: f64,
    pub(super) half: f64,
}

/// A body in the frame of another one, rotated about that one's axis until its own axis lies in the plane of the first
/// and third coordinates of [`Placed::centre`].
struct Placed {
    body: Annulus,
    /// Centre: along the horizontal projection of the axis, across it, and along the other's axis, m.
    centre: [f64; 3],
    /// Sine and cosine of the angle between the axes.
    tilt: [f64; 2],
}

impl Annulus {
    /// Inner radius, m; 0 for a solid body.
    #[must_use]
    pub fn inner_radius(&self) -> f64 {
        self.inner
    }

    /// Outer radius, m.
    #[must_use]
    pub fn outer_radius(&self) -> f64 {
        self.outer
    }

    /// Length along the axis, m.
    #[must_use]
    pub fn length(&self) -> f64 {
        2.0 * self.half
    }

    /// Distance of a point from the surface, m, negative inside.
    pub(super) fn signed_distance(&self, point: &Vector3<f64>) -> f64 {
        let rho = point.x.hypot(point.y);
        let across =
            if self.inner > 0.0 { (rho - self.outer).max(self.inner - rho) } else { rho - self.outer };
        let along = point.z.abs() - self.half;
        if across < 0.0 && along < 0.0 { across.max(along) } else { across.max(0.0).hypot(along.max(0.0)) }
    }

    /// Largest value of `min(h - |z|, b - rho, rho - a)` over this body at `pose` in the other's frame, with the other's radii
    /// `a`, `b` and half length `h`; `None` if they are certainly further apart than `slack`, m.
    ///
    /// For solid bodies this is concave, so that nested golden-section searches find it to 1e-10 of the body's size; in the
    /// direction normal to both axes it is known in closed form. With a bore, a local maximum is found if it is the only one
    /// within a 24th of the body.
    pub(super) fn level_in(&self, other: &Self, pose: &Pose, slack: f64) -> Option<f64> {
        let placed = Placed::new(self, pose);
        if placed.gap(other) >= slack.max(f64::MIN_POSITIVE) {
            return None;
        }
        let parts = if self.inner > 0.0 || other.inner > 0.0 { PARTS } else { 1 };
        let at_height = |s: f64| {
            let level = |turn: f64| placed.level(other, s, self.outer * turn.sin());
            largest(level, [-FRAC_PI_2, FRAC_PI_2], parts, f64::NEG_INFINITY).0
        };
        if self.half == 0.0 {
            return Some(at_height(0.0));
        }
        Some(largest(at_height, [-self.half, self.half], parts, f64::NEG_INFINITY).0)
    }
}

impl Placed {
    fn new(body: &Annulus, pose: &Pose) -> Self {
        let (axis, at) = (pose.axis(), &pose.position);
        let sine = axis.x.hypot(axis.y);
        // Parallel axes: every direction is valid; the one from axis to axis is used.
        let along = if sine > 0.0 {
            Vector3::new(axis.x / sine, axis.y / sine, 0.0)
        } else {
            Vector3::new(at.x, at.y, 0.0).try_normalize(0.0).unwrap_or_else(Vector3::x)
        };
        let across = Vector3::z().cross(&along);
        Self { body: *body, centre: [at.dot(&along), at.dot(&across), at.z], tilt: [sine, axis.z] }
    }

    /// A lower bound of the distance to the other body: the largest separation along or normal to either axis.
    fn gap(&self, other: &Annulus) -> f64 {
        let Self { body, centre: [x, y, z], tilt: [sine, cosine] } = self;
        let across = x.hypot(*y);
        // Extent of the body in the other's frame: along the other's axis, normal to it, inside its bore.
        let height = body.half * cosine.abs() + body.outer * sine;
        let slope = if across > 0.0 { sine * x / across } else { 0.0 };
        let width = body.half * slope.abs() + body.outer * (1.0 - slope * slope).max(0.0).sqrt();
        let widest = body.half * sine + body.outer;
        // Extent of the other in the body's frame.
        let along = x * sine + z * cosine;
        let (side, forward) = (x * cosine - z * sine, other.half * sine);
        let away = side.hypot(*y);
        let slope = if away > 0.0 { sine * side / away } else { 0.0 };
        let reach = other.half * slope.abs() + other.outer * (1.0 - slope * slope).max(0.0).sqrt();
        [
            z.abs() - height - other.half,
            across - width - other.outer,
            other.inner - across - widest,
            along.abs() - (other.half * cosine.abs() + other.outer * sine) - body.half,
            away - reach - body.outer,
            body.inner - away - forward - other.outer,
        ]
        .into_iter()
        .fold(f64::NEG_INFINITY, f64::max)
    }

    /// Largest depth on the chord of the body normal to both axes, at height `s` along its axis and `p` across it.
    fn level(&self, other: &Annulus, s: f64, p: f64) -> f64 {
        let Self { body, centre: [x, y, z], tilt: [sine, cosine] } = self;
        let height = z + s * cosine - p * sine;
        let along = x + s * sine + p * cosine;
        let chord = |radius: f64| (radius * radius - p * p).max(0.0).sqrt();
        let (end, hole) = (chord(body.outer), chord(body.inner));
        let radial = |low: f64, high: f64| {
            let nearest = if low > 0.0 { low } else { high.min(0.0) };
            let (least, most) = (along.hypot(nearest), along.hypot(low.abs().max(high.abs())));
            if other.inner == 0.0 {
                return other.outer - least;
            }
            let best = (0.5 * (other.inner + other.outer)).clamp(least, most);
            (other.outer - best).min(best - other.inner)
        };
        let radial = if hole > 0.0 {
            radial(y - end, y - hole).max(radial(y + hole, y + end))
        } else {
            radial(y - end, y + end)
        };
        radial.min(other.half - height.abs())
    }
}

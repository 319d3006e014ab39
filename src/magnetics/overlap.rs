//! Penetration depth of two bodies: cylinders, rings and flat discs.

use core::f64::consts::FRAC_PI_2;

use nalgebra::Vector3;

use crate::error::Error;
use crate::geometry::Pose;
use crate::numerics::maximum::largest;

/// Number of parts of a body's heights and widths that are searched where a bore allows several local maxima of the
/// depth.
const PARTS: usize = 24;

/// Overlap of two bodies, relative to the smaller radius, that counts as rounding error: bodies may touch.
const HAIR: f64 = 1e-9;

/// The outline of a body: a cylinder or ring about its frame's `z`, centred at the origin, or a flat disc of no height.
///
/// ```
/// use mcm::geometry::Pose;
/// use mcm::magnetics::Outline;
/// let (ring, magnet) = (Outline::new(0.0, 2e-3, 1e-3), Outline::new(5e-3, 20e-3, 30e-3));
/// let beside = |x: f64| Pose::new([x, 0.0, 0.0], [1.0, 0.0, 0.0, 0.0]);
/// assert_eq!(ring.depth_in(&magnet, &Pose::identity()), 0.0); // in the bore
/// assert!((ring.depth_in(&magnet, &beside(3.5e-3)?) - 0.5e-3).abs() < 1e-15); // in its wall
/// # Ok::<(), mcm::error::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Outline {
    inner: f64,
    outer: f64,
    half: f64,
}

/// A body in the frame of another one, rotated about that one's axis until its own axis lies in the plane of the first
/// and third coordinates of [`Placed::centre`].
struct Placed {
    body: Outline,
    /// Centre: along the horizontal projection of the axis, across it, and along the other's axis, m.
    centre: [f64; 3],
    /// Sine and cosine of the angle between the axes.
    tilt: [f64; 2],
}

impl Outline {
    /// The outline of the radii `inner` (0: solid) and `outer` and the length along the axis (0: a disc), m.
    #[must_use]
    pub fn new(inner: f64, outer: f64, length: f64) -> Self {
        Self { inner, outer, half: 0.5 * length }
    }

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

    /// Largest depth of a point of this body, at `pose` in the other's frame, below the other's surface, m; 0 if the
    /// two share no volume.
    ///
    /// It is the maximum of `min(h - |z|, b - rho, rho - a)` over the body, with the other's radii `a`, `b` and half
    /// length `h`. For solid bodies this is concave, so that nested golden-section searches find it to 1e-10 of the
    /// body's size; in the direction normal to both axes it is known in closed form. With a bore, a local maximum is
    /// found if it is the only one within a 24th of the body.
    #[must_use]
    pub fn depth_in(&self, other: &Self, pose: &Pose) -> f64 {
        self.level_in(other, pose, 0.0)
            .map_or(0.0, |level| if level > other.hair(self) { level } else { 0.0 })
    }

    /// As [`Outline::depth_in`], but negative where no point of this body is below the other's surface. It then
    /// increases as they approach, but is not their distance. `None` if they are certainly further apart than `slack`,
    /// m.
    #[must_use]
    pub fn level_in(&self, other: &Self, pose: &Pose, slack: f64) -> Option<f64> {
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

    /// Overlap that counts as rounding error, m.
    fn hair(&self, other: &Self) -> f64 {
        HAIR * self.outer.min(other.outer)
    }
}

/// Penetration depth of two bodies, m: the largest depth of a point of either body below the surface of the other.
///
/// The second body is at `pose` in the first one's frame. The depth is 0 if they share no volume.
#[must_use]
pub fn depth(first: &Outline, second: &Outline, pose: &Pose) -> f64 {
    let forth = second.depth_in(first, pose);
    let back = pose.rotation.transpose();
    if forth == 0.0 {
        return 0.0;
    }
    forth.max(first.depth_in(second, &Pose { position: -(back * pose.position), rotation: back }))
}

/// Returns an error if two magnets overlap, the second at `pose` in the first one's frame.
pub(super) fn check(first: &Outline, second: &Outline, pose: &Pose) -> Result<(), Error> {
    let depth = depth(first, second, pose);
    if depth == 0.0 {
        return Ok(());
    }
    Err(Error::Unsupported(format!(
        "the magnets overlap by {depth:.3e} m: the second one's centre is at ({:.3e}, {:.3e}, {:.3e}) m from the first one's",
        pose.position.x, pose.position.y, pose.position.z
    )))
}

impl Placed {
    fn new(body: &Outline, pose: &Pose) -> Self {
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
    fn gap(&self, other: &Outline) -> f64 {
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
    fn level(&self, other: &Outline, s: f64, p: f64) -> f64 {
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

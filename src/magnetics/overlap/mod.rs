//! Outlines of bodies, and their penetration depth: cylinders, rings and flat discs, cuboids and spheres.

mod annulus;
mod cuboid;

use core::f64::consts::PI;

use nalgebra::Vector3;

pub use annulus::Annulus;

use crate::error::Error;
use crate::geometry::Pose;

/// Number of parts of a body's heights and widths that are searched where a bore allows several local maxima of the
/// depth.
const PARTS: usize = 24;

/// Overlap of two bodies, relative to the smaller radius, that counts as rounding error: bodies may touch.
const HAIR: f64 = 1e-9;

/// The outline of a body, centred at the origin of its frame.
///
/// ```
/// use mcm::geometry::Pose;
/// use mcm::magnetics::Outline;
/// use nalgebra::Vector3;
/// let (ring, magnet) = (Outline::cylinder(0.0, 2e-3, 1e-3), Outline::cylinder(5e-3, 20e-3, 30e-3));
/// let beside = |x: f64| Pose::new([x, 0.0, 0.0], [1.0, 0.0, 0.0, 0.0]);
/// assert_eq!(ring.depth_in(&magnet, &Pose::identity()), 0.0); // in the bore
/// assert!((ring.depth_in(&magnet, &beside(3.5e-3)?) - 0.5e-3).abs() < 1e-15); // in its wall
/// let cuboid = Outline::Cuboid(Vector3::new(5e-3, 4e-3, 3e-3));
/// assert!((ring.depth_in(&cuboid, &beside(6.5e-3)?) - 0.5e-3).abs() < 1e-12); // through a face
/// # Ok::<(), mcm::error::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Outline {
    /// A cylinder or ring about `z`, or a flat disc of no height.
    Cylinder(Annulus),
    /// A cuboid with these halves of its edges, m.
    Cuboid(Vector3<f64>),
    /// A sphere of this radius, m.
    Sphere(f64),
}

impl Outline {
    /// The outline of the radii `inner` (0: solid) and `outer` and the length along the axis (0: a disc), m.
    #[must_use]
    pub fn cylinder(inner: f64, outer: f64, length: f64) -> Self {
        Self::Cylinder(Annulus { inner, outer, half: 0.5 * length })
    }

    /// Volume, m3.
    #[must_use]
    pub fn volume(&self) -> f64 {
        match self {
            Self::Cylinder(Annulus { inner, outer, half }) => {
                PI * (outer - inner) * (outer + inner) * 2.0 * half
            }
            Self::Cuboid(half) => 8.0 * half.product(),
            Self::Sphere(radius) => 4.0 / 3.0 * PI * radius.powi(3),
        }
    }

    /// Halves of the edges of the smallest cuboid along the frame's axes that holds it, m.
    #[must_use]
    pub fn half_extents(&self) -> Vector3<f64> {
        match self {
            Self::Cylinder(Annulus { outer, half, .. }) => Vector3::new(*outer, *outer, *half),
            Self::Cuboid(half) => *half,
            Self::Sphere(radius) => Vector3::repeat(*radius),
        }
    }

    /// Distance of a point from the surface, m, negative inside.
    #[must_use]
    pub fn signed_distance(&self, point: &Vector3<f64>) -> f64 {
        match self {
            Self::Cylinder(annulus) => annulus.signed_distance(point),
            Self::Cuboid(half) => {
                let beyond = point.abs() - half;
                let outside = beyond.sup(&Vector3::zeros()).norm();
                if outside > 0.0 { outside } else { beyond.max() }
            }
            Self::Sphere(radius) => point.norm() - radius,
        }
    }

    /// Largest depth of a point of this body, at `pose` in the other's frame, below the other's surface, m; 0 if the
    /// two share no volume.
    ///
    /// The depth of a point is its distance from the nearest of the other's surfaces, each of which goes on beyond its edges. A cuboid
    /// asks for that of the other one in itself.
    #[must_use]
    pub fn depth_in(&self, other: &Self, pose: &Pose) -> f64 {
        let hair = HAIR * self.radius().min(other.radius());
        self.level_in(other, pose, 0.0).map_or(0.0, |level| if level > hair { level } else { 0.0 })
    }

    /// As [`Outline::depth_in`], but negative where no point of this body is below the other's surface. It then
    /// increases as they approach, but is not their distance. `None` if they are certainly further apart than `slack`,
    /// m.
    #[must_use]
    pub fn level_in(&self, other: &Self, pose: &Pose, slack: f64) -> Option<f64> {
        let inverse = || Pose::identity().seen_from(pose);
        match (self, other) {
            (Self::Cylinder(own), Self::Cylinder(other)) => own.level_in(other, pose, slack),
            (_, Self::Sphere(radius)) => beyond(slack, radius - self.signed_distance(&inverse().position)),
            (Self::Sphere(radius), _) => beyond(slack, radius - other.signed_distance(&pose.position)),
            (_, Self::Cuboid(half)) => cuboid::level_in(self, half, pose, slack),
            (Self::Cuboid(half), Self::Cylinder(_)) => cuboid::level_in(other, half, &inverse(), slack),
        }
    }

    /// Its size, of which [`HAIR`] is a part, m.
    fn radius(&self) -> f64 {
        match self {
            Self::Cylinder(annulus) => annulus.outer,
            Self::Cuboid(half) => half.min(),
            Self::Sphere(radius) => *radius,
        }
    }
}

/// The level, unless it says that the bodies are further apart than `slack`.
fn beyond(slack: f64, level: f64) -> Option<f64> {
    (-level < slack.max(f64::MIN_POSITIVE)).then_some(level)
}

/// Penetration depth of two bodies, m: the largest depth of a point of either body below the surface of the other.
///
/// The second body is at `pose` in the first one's frame. The depth is 0 if they share no volume.
#[must_use]
pub fn depth(first: &Outline, second: &Outline, pose: &Pose) -> f64 {
    let forth = second.depth_in(first, pose);
    if forth == 0.0 {
        return 0.0;
    }
    let back = pose.rotation.transpose();
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

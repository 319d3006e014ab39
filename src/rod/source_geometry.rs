//! Geometry of a ring relative to an element, and the number of quadrature points that its field requires.

use nalgebra::Vector2;

/// Ratio of successive angular harmonics of the field, on the rim at a ring's face, per radian of bend.
///
/// With 0.3 the error of one segment in 30 mT is 3e-4 of its length; from 0.4 on it is no larger than that of the other points.
const HARMONICS: f64 = 0.4;

/// Additional points along a piece: a helical spiral is interpolated, not integrated by Gauss's rule.
///
/// With S = 9 beside the magnet pair the error is 1e-5 of the length without it, 5e-6 with it, 4e-6 with two.
const TURNING: usize = 1;

/// Largest number of points in one direction, for pieces that touch the ring.
const MOST_POINTS: usize = 24;

/// Geometry of a ring relative to an element of the straight manipulator.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SourceGeometry {
    /// Distance from the ring's facing side to the element's nearer end, m.
    pub distance: f64,
    /// Whether the ring is beyond the element's end rather than before its start.
    pub beyond: bool,
    /// Whether the ring is bonded to the disc there, on which it then does not act.
    pub bonded: bool,
    /// Outer radius of the ring, m.
    pub radius: f64,
    /// Largest angle between the axes of ring and element, rad.
    pub bend: f64,
    /// Allowed error of the energy, relative to that of two dipoles one ring width apart.
    pub accuracy: f64,
}

impl SourceGeometry {
    /// Negative natural logarithm of the accuracy needed at a distance from the ring's face (m).
    ///
    /// The energy falls with the cube of that distance.
    fn digits(&self, distance: f64) -> f64 {
        -(self.accuracy * (0.5 * distance / self.radius).max(1.0).powi(3)).ln()
    }

    /// Gauss points for a field with a singularity at these distances from the two ends of an interval.
    ///
    /// The error is `rho^(-2n)` (Trefethen, SIAM Review 50, 2008, doi:10.1137/060659831, Theorem 4.5).
    fn gauss_points(&self, distance: f64, to_ends: [f64; 2], length: f64) -> usize {
        whole(0.5 * self.digits(distance) / decay(to_ends, length))
    }

    /// Points along a piece at this distance from the ring's face.
    pub(super) fn along(&self, distance: f64, length: f64) -> usize {
        (self.gauss_points(distance, [distance, distance + length], length) + TURNING).min(MOST_POINTS)
    }

    /// Points along a piece for a rule other than Gauss's: the error is that of the interpolation, `rho^(-n)`.
    pub(super) fn interpolated(&self, distance: f64, length: f64) -> usize {
        whole(self.digits(distance) / decay([distance, distance + length], length))
    }

    /// Radial points (in the squared radius) of a section: the edge of the ring's face is the singularity.
    pub(super) fn radial(&self, distance: f64, bounds: [f64; 2]) -> usize {
        let [inner, outer] = bounds.map(|r| r * r);
        let edge = Vector2::new(self.radius.powi(2) - distance.powi(2), 2.0 * self.radius * distance);
        let to = |end: f64| (edge - Vector2::new(end, 0.0)).norm();
        self.gauss_points(distance, [to(inner), to(outer)], outer - inner)
    }

    /// Number of non-negligible harmonics of the field around a section, at `radius` from its centre (m).
    pub(super) fn harmonics(&self, distance: f64, radius: f64) -> usize {
        let ratio = HARMONICS * self.bend * radius / self.radius.hypot(distance);
        whole(-self.digits(distance) / ratio.ln() - 1.0)
    }
}

/// Logarithm of `rho`, the factor by which each further polynomial degree reduces the error.
///
/// `rho` is the sum of the half axes of the ellipse through a singularity at these distances from the ends of an interval, with
/// the ends as foci, over half the interval.
fn decay(to_ends: [f64; 2], length: f64) -> f64 {
    let axis = (to_ends[0] + to_ends[1]) / length;
    (axis + (axis * axis - 1.0).max(0.0).sqrt()).ln()
}

/// The number of points rounded up, at most [`MOST_POINTS`].
fn whole(points: f64) -> usize {
    (1..MOST_POINTS).find(|count| *count as f64 >= points).unwrap_or(MOST_POINTS)
}

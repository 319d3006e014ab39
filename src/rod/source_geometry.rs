//! Where a ring is, seen from an element, and how many points its field there takes.

use nalgebra::Vector2;

/// Ratio of one angular harmonic of the field to the one before, on the rim at a ring's face, for each radian of bend: with
/// 0.3 one segment in 30 mT is off by 3e-4 of its length, from 0.4 on by no more than the other points leave.
const HARMONICS: f64 = 0.4;

/// Points along a piece beyond those that a field alone would need: a turning spiral is interpolated, not integrated by
/// Gauss's rule. Without it S = 9 beside the magnet pair is off by 1e-5 of its length, with it by 5e-6, with two by 4e-6.
const TURNING: usize = 1;

/// Most points in one direction, for pieces that touch the ring.
const MOST_POINTS: usize = 24;

/// Where a ring is, seen from an element of the straight manipulator.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SourceGeometry {
    /// Distance of the ring's facing side from the element's nearer end, m.
    pub distance: f64,
    /// Whether the ring is past the element's end, not before its start.
    pub beyond: bool,
    /// Whether it is bonded to the disc there, which it then does not act on.
    pub bonded: bool,
    /// Outer radius of the ring, m.
    pub radius: f64,
    /// Largest angle between its axis and the element's, rad.
    pub bend: f64,
    /// Largest error of the energy, relative to that of two dipoles as far apart as the ring is wide.
    pub accuracy: f64,
}

impl SourceGeometry {
    /// Natural logarithm of the accuracy needed at a distance from the ring's face (m): the energy falls with its cube.
    fn digits(&self, distance: f64) -> f64 {
        -(self.accuracy * (0.5 * distance / self.radius).max(1.0).powi(3)).ln()
    }

    /// Gauss points for a field that is singular so far from the two ends of an interval.
    ///
    /// The error is `rho^(-2n)` (Trefethen, SIAM Review 50, 2008, Theorem 4.5).
    fn gauss_points(&self, distance: f64, to_ends: [f64; 2], length: f64) -> usize {
        whole(0.5 * self.digits(distance) / decay(to_ends, length))
    }

    /// Points along a piece so far from the ring's face.
    pub(super) fn along(&self, distance: f64, length: f64) -> usize {
        (self.gauss_points(distance, [distance, distance + length], length) + TURNING).min(MOST_POINTS)
    }

    /// The same for points that are not Gauss's: the error is that of the interpolation, `rho^(-n)`.
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

    /// Harmonics of the field around a section, at this distance from its centre (m), before they are negligible.
    pub(super) fn harmonics(&self, distance: f64, radius: f64) -> usize {
        let ratio = HARMONICS * self.bend * radius / self.radius.hypot(distance);
        whole(-self.digits(distance) / ratio.ln() - 1.0)
    }
}

/// Logarithm of `rho`, the sum of the half axes of the ellipse through a singularity so far from the ends of an interval,
/// with these as its foci, over half the interval: what each further degree of a polynomial leaves of the error.
fn decay(to_ends: [f64; 2], length: f64) -> f64 {
    let axis = (to_ends[0] + to_ends[1]) / length;
    (axis + (axis * axis - 1.0).max(0.0).sqrt()).ln()
}

/// The next whole number of points.
fn whole(points: f64) -> usize {
    (1..MOST_POINTS).find(|count| *count as f64 >= points).unwrap_or(MOST_POINTS)
}

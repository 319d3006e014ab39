//! Surface integrals over the charged end face of a magnet in the near field of another magnet.
//!
//! An axially magnetised ring is equivalent to magnetic charges on its two end faces. In the field of another magnet
//! the integrand is smooth except near that magnet's edges, where the field grows logarithmically. Gauss nodes in
//! `rho^2` and the trapezoidal rule in the angle converge exponentially, the faster the further those edges are from
//! the face.

use core::f64::consts::{PI, TAU};

use nalgebra::{Vector2, Vector3};

use super::axial_source::AxialSource;
use crate::geometry::Pose;
use crate::numerics::quadrature::gauss_legendre;

/// Largest number of nodes along a radius or around a circle; it is needed only where the distance is almost zero.
const MOST_NODES: usize = 4096;

/// Number of points of an edge at which its distance from a face is evaluated, before the smallest is refined.
const EDGE_POINTS: usize = 24;

/// Number of halvings of the arc between them, down to an eighth of a degree; the error of the distance is of second
/// order in it.
const HALVINGS: usize = 7;

/// Nodes and weights on an annulus in the plane `z = 0`, centred at the origin.
///
/// ```
/// use mcm::magnetics::FaceRule;
/// let rule = FaceRule::new(0.75e-3, 2.0e-3, 0.5e-3, 1e-6);
/// let area = core::f64::consts::PI * (4.0 - 0.5625) * 1e-6;
/// let sum: f64 = rule.points().map(|(_, weight)| weight).sum();
/// assert!((sum / area - 1.0).abs() < 1e-12);
/// assert!(rule.len() > FaceRule::new(0.75e-3, 2.0e-3, 1.0e-3, 1e-6).len());
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct FaceRule {
    circles: Vec<Circle>,
}

/// Equally spaced nodes of equal weight on a circle.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Circle {
    count: usize,
    /// The first node, m.
    first: Vector2<f64>,
    /// Cosine and sine of the angle between neighbouring nodes.
    turn: Vector2<f64>,
    /// Area represented by each node, m2.
    weight: f64,
}

impl FaceRule {
    /// The rule for a face of the radii `inner` and `outer` (m) in the field of sources whose edges are at least
    /// `distance` (m) away; the error of the force is about `tolerance`, relative to its size.
    ///
    /// Each node along the radius, over a width `w`, reduces the error by the factor `exp(-2 asinh(2 d / w))`, each one
    /// around a circle of radius `r` by `exp(-asinh(d / r))`, according to the distances of the singularities in the
    /// complex plane. The factors before these are those measured at 40 random poses of two of the paper's rings at
    /// each of the distances 0.1, 0.2, 0.4, 0.8 and 1.6 mm, rounded up by a factor of about five; at larger distances
    /// the forces on the two faces cancel more and more.
    #[must_use]
    pub fn new(inner: f64, outer: f64, distance: f64, tolerance: f64) -> Self {
        let ratio = distance / outer;
        let cancelled = 1.0 + ratio * ratio;
        let across = 2.0 * ratio * cancelled / tolerance;
        let around = 8.0 * ratio * ratio.sqrt() * cancelled / tolerance;
        let along = count(across, 2.0 * (2.0 * distance / (outer - inner)).asinh(), 1);
        let (nodes, weights) = gauss_legendre(along);
        let (mean, half) = (0.5 * (outer * outer + inner * inner), 0.5 * (outer * outer - inner * inner));
        let circle = |(node, weight): (&f64, &f64)| {
            let radius = (mean + half * node).sqrt();
            let count = count(around, (distance / radius).asinh(), 3);
            let step = TAU / count as f64;
            let (sine, cosine) = (0.5 * step).sin_cos();
            let first = Vector2::new(radius * cosine, radius * sine);
            let (sine, cosine) = step.sin_cos();
            Circle {
                count,
                first,
                turn: Vector2::new(cosine, sine),
                weight: PI * half * weight / count as f64,
            }
        };
        Self { circles: nodes.iter().zip(&weights).map(circle).collect() }
    }

    /// Positions on the face (m) with their weights (m2), which add up to its area.
    pub fn points(&self) -> impl Iterator<Item = (Vector2<f64>, f64)> + '_ {
        self.circles.iter().flat_map(|circle| {
            core::iter::successors(Some(circle.first), |point| Some(turned(point, &circle.turn)))
                .take(circle.count)
                .map(|point| (point, circle.weight))
        })
    }

    /// Number of nodes.
    #[must_use]
    pub fn len(&self) -> usize {
        self.circles.iter().map(|circle| circle.count).sum()
    }

    /// Whether the rule has no nodes: always false.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// The point rotated about the origin by the angle whose cosine and sine are given.
#[inline]
fn turned(point: &Vector2<f64>, by: &Vector2<f64>) -> Vector2<f64> {
    Vector2::new(by.x * point.x - by.y * point.y, by.y * point.x + by.x * point.y)
}

/// Number of nodes, at least `least`, that reduces an error of `excess` times the tolerance to the tolerance, if each
/// node reduces it by the factor `exp(-rate)`.
pub(super) fn count(excess: f64, rate: f64, least: usize) -> usize {
    (least..MOST_NODES).find(|nodes| *nodes as f64 * rate >= excess.ln()).unwrap_or(MOST_NODES)
}

impl AxialSource {
    /// Smallest distance (m) between this magnet's edges and the end face of another magnet.
    ///
    /// The face has the radii `inner` and `outer` (m) and its centre at `face`, in this magnet's frame.
    #[must_use]
    pub fn edge_distance(&self, face: &Pose, inner: f64, outer: f64) -> f64 {
        let half = 0.5 * self.length();
        let turn = face.rotation.transpose();
        let radii = [self.outer_radius(), self.inner_radius()].into_iter().filter(|radius| *radius > 0.0);
        let arc = TAU / EDGE_POINTS as f64;
        let mut angle = 2.0 * arc;
        let steps: [Vector2<f64>; HALVINGS + 1] = core::array::from_fn(|_| {
            angle *= 0.5;
            Vector2::new(angle.cos(), angle.sin())
        });
        let mut least2 = f64::INFINITY;
        for (radius, height) in radii.flat_map(|radius| [(radius, -half), (radius, half)]) {
            // The edge in the frame of the face: its centre and its radii along two perpendicular axes.
            let centre = turn * (Vector3::new(0.0, 0.0, height) - face.position);
            let (x, y) = (turn.column(0) * radius, turn.column(1) * radius);
            let distance2 = |at: &Vector2<f64>| {
                let point = centre + x * at.x + y * at.y;
                let rho = (point.x * point.x + point.y * point.y).sqrt();
                let beside = (rho - outer).max(inner - rho).max(0.0);
                beside * beside + point.z * point.z
            };
            let (mut here, mut next, mut next2) = (Vector2::x(), Vector2::x(), f64::INFINITY);
            for _ in 0..EDGE_POINTS {
                let here2 = distance2(&here);
                if here2 < next2 {
                    (next, next2) = (here, here2);
                }
                here = turned(&here, &steps[0]);
            }
            // Between the sampled points, an edge comes closer by at most half an arc.
            if next2.sqrt() - 0.5 * arc * radius < least2.sqrt() {
                for step in &steps[1..] {
                    let sides = [*step, Vector2::new(step.x, -step.y)].map(|step| turned(&next, &step));
                    for side in sides {
                        let side2 = distance2(&side);
                        if side2 < next2 {
                            (next, next2) = (side, side2);
                        }
                    }
                }
            }
            least2 = least2.min(next2);
        }
        least2.sqrt()
    }
}

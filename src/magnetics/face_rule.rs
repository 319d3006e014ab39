//! Surface integrals over the charged end face of a magnet that another magnet is close to.
//!
//! An axially magnetised ring is a magnetic charge on its two end faces. In the field of another magnet the
//! integrand is smooth but near that magnet's edges, where the field grows logarithmically. Gauss nodes in `rho^2` and
//! the trapezoid rule around converge exponentially, the faster the further those edges are from the face.

use core::f64::consts::{PI, TAU};

use nalgebra::{Vector2, Vector3};

use super::axial_source::AxialSource;
use crate::geometry::Pose;
use crate::numerics::quadrature::gauss_legendre;

/// Most nodes along a radius or around a circle, where the distance is all but zero.
const MOST_NODES: usize = 4096;

/// Points of an edge at which its distance from a face is looked for, before the least is refined.
const EDGE_POINTS: usize = 24;

/// Refinements of that distance: each leaves two thirds of an arc of 30 deg, so that a hundredth of a degree is left.
const REFINEMENTS: usize = 20;

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
    /// Cosine and sine of the angle from node to node.
    turn: [f64; 2],
    /// Area that a node stands for, m2.
    weight: f64,
}

impl FaceRule {
    /// The rule for a face of the radii `inner` and `outer` (m), the edges of whose sources are at least `distance` (m)
    /// away, by which the force of such a source is good to about `tolerance` of its size.
    ///
    /// Along the radius, over a width `w`, the error falls by `exp(-2 asinh(2 d / w))` with each node, around a circle of
    /// radius `r` by `exp(-asinh(d / r))` with each: these are the distances of the singularities in the complex plane.
    /// The factors before them are those that 40 random poses of two of the paper's rings showed at each of the
    /// distances 0.1, 0.2, 0.4, 0.8 and 1.6 mm, rounded up by a factor of about three.
    #[must_use]
    pub fn new(inner: f64, outer: f64, distance: f64, tolerance: f64) -> Self {
        let ratio = distance / outer;
        let (across, around) = (ratio / tolerance, 4.0 * ratio * ratio.sqrt() / tolerance);
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
            Circle { count, first, turn: [cosine, sine], weight: PI * half * weight / count as f64 }
        };
        Self { circles: nodes.iter().zip(&weights).map(circle).collect() }
    }

    /// Positions on the face (m) with their weights (m2), which add up to its area.
    pub fn points(&self) -> impl Iterator<Item = (Vector2<f64>, f64)> + '_ {
        self.circles.iter().flat_map(|circle| {
            let [cosine, sine] = circle.turn;
            let turned = move |p: &Vector2<f64>| {
                Some(Vector2::new(cosine * p.x - sine * p.y, sine * p.x + cosine * p.y))
            };
            core::iter::successors(Some(circle.first), turned)
                .take(circle.count)
                .map(|point| (point, circle.weight))
        })
    }

    /// Number of nodes.
    #[must_use]
    pub fn len(&self) -> usize {
        self.circles.iter().map(|circle| circle.count).sum()
    }

    /// Whether there are none, which no rule has.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// The nodes, `least` or more, with which an error `excess` times as large as allowed has become small enough, if each
/// lowers it by `exp(-rate)`.
fn count(excess: f64, rate: f64, least: usize) -> usize {
    (least..MOST_NODES).find(|nodes| *nodes as f64 * rate >= excess.ln()).unwrap_or(MOST_NODES)
}

impl AxialSource {
    /// Least distance (m) of this magnet's edges from the end face of another one of the radii `inner` and `outer` (m),
    /// whose centre is at `face`, in this magnet's frame.
    #[must_use]
    pub fn edge_distance(&self, face: &Pose, inner: f64, outer: f64) -> f64 {
        let half = 0.5 * self.length();
        let edges = [self.inner_radius(), self.outer_radius()]
            .into_iter()
            .filter(|radius| *radius > 0.0)
            .flat_map(|radius| [(radius, -half), (radius, half)]);
        let nearest = |(radius, height): (f64, f64)| {
            // The edge in the frame of the face: its centre, and where it starts on two axes at right angles.
            let turn = face.rotation.transpose();
            let centre = turn * (Vector3::new(0.0, 0.0, height) - face.position);
            let (x, y) = (turn.column(0) * radius, turn.column(1) * radius);
            let distance2 = |angle: f64| {
                let (sine, cosine) = angle.sin_cos();
                let point = centre + x * cosine + y * sine;
                let rho = point.x.hypot(point.y);
                let beside = (rho - outer).max(inner - rho).max(0.0);
                beside * beside + point.z * point.z
            };
            let step = TAU / EDGE_POINTS as f64;
            let (mut angle, mut least) = (0.0, f64::INFINITY);
            for k in 0..EDGE_POINTS {
                let distance = distance2(step * k as f64);
                if distance < least {
                    (angle, least) = (step * k as f64, distance);
                }
            }
            let (mut from, mut to) = (angle - step, angle + step);
            for _ in 0..REFINEMENTS {
                let (one, two) = (from + (to - from) / 3.0, to - (to - from) / 3.0);
                let (at_one, at_two) = (distance2(one), distance2(two));
                least = least.min(at_one).min(at_two);
                if at_one < at_two {
                    to = two;
                } else {
                    from = one;
                }
            }
            least.sqrt()
        };
        edges.map(nearest).fold(f64::INFINITY, f64::min)
    }
}

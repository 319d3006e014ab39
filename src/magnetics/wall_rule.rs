//! Surface integrals over the charged curved surfaces of a magnet in the near field of another magnet.
//!
//! A ring that is magnetised across its axis is equivalent to magnetic charges on its outer and its inner wall. As on its end faces, the
//! integrand is smooth except near the other magnet's edges: Gauss nodes along the axis and the trapezoidal rule in the angle converge
//! exponentially, the faster the farther those edges are from the wall.

use core::f64::consts::TAU;

use nalgebra::{Vector2, Vector3};

use super::axial_source::AxialSource;
use super::face_rule::count;
use crate::geometry::Pose;
use crate::numerics::quadrature::gauss_legendre;

/// Number of points of an edge at which its distance from the other magnet is evaluated.
const EDGE_POINTS: usize = 48;

/// Nodes on the walls of a ring about the axis `z`, centred at the origin.
///
/// ```
/// use mcm::magnetics::WallRule;
/// let rule = WallRule::new(0.75e-3, 2.0e-3, 1.0e-3, 0.5e-3, 1e-6);
/// let moment: f64 = rule.points().map(|(place, area)| place.x * area.x).sum();
/// let volume = core::f64::consts::PI * (4.0 - 0.5625) * 1e-9;
/// assert!((moment / volume - 1.0).abs() < 1e-12); // the charges of a magnetisation along x have its moment
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct WallRule {
    points: Vec<(Vector3<f64>, Vector2<f64>)>,
}

impl WallRule {
    /// The rule for walls of the radii `inner` (0: none) and `outer` and this length (m), in the field of sources whose edges are at least
    /// `distance` (m) away; the error of the force is about `tolerance`, relative to its size.
    #[must_use]
    pub fn new(inner: f64, outer: f64, length: f64, distance: f64, tolerance: f64) -> Self {
        let ratio = distance / outer;
        let cancelled = 1.0 + ratio * ratio;
        let along = count(2.0 * ratio * cancelled / tolerance, 2.0 * (2.0 * distance / length).asinh(), 2);
        let (heights, weights) = gauss_legendre(along);
        let mut points = Vec::new();
        for (radius, outward) in [(outer, 1.0), (inner, -1.0)].into_iter().filter(|wall| wall.0 > 0.0) {
            let excess = 8.0 * ratio * ratio.sqrt() * cancelled / tolerance;
            // An even number: with each node, the one opposite to it.
            let around = count(excess, (distance / radius).asinh(), 4).next_multiple_of(2);
            for (height, weight) in heights.iter().zip(&weights) {
                let area = outward * 0.5 * length * weight * radius * TAU / around as f64;
                points.extend((0..around).map(|step| {
                    let (sine, cosine) = (TAU * (step as f64 + 0.5) / around as f64).sin_cos();
                    let place = Vector3::new(radius * cosine, radius * sine, 0.5 * length * height);
                    (place, Vector2::new(cosine, sine) * area)
                }));
            }
        }
        Self { points }
    }

    /// Positions on the walls (m), each with the outward normal times the area that it represents (m2), across the axis.
    pub fn points(&self) -> impl Iterator<Item = (&Vector3<f64>, &Vector2<f64>)> {
        self.points.iter().map(|(place, area)| (place, area))
    }
}

impl AxialSource {
    /// Smallest distance (m), to a few percent, between this magnet's edges and another magnet of these radii and this length (m) at
    /// `pose` in this magnet's frame.
    #[must_use]
    pub(super) fn edge_distance_to(&self, pose: &Pose, [inner, outer]: [f64; 2], length: f64) -> f64 {
        let half = 0.5 * self.length();
        let radii = [self.outer_radius(), self.inner_radius()].into_iter().filter(|radius| *radius > 0.0);
        let edges = radii.flat_map(|radius| [-half, half].map(|height| (radius, height)));
        let points = edges.flat_map(|(radius, height)| {
            (0..EDGE_POINTS).map(move |step| {
                let (sine, cosine) = (TAU * step as f64 / EDGE_POINTS as f64).sin_cos();
                Vector3::new(radius * cosine, radius * sine, height)
            })
        });
        let distance = |point: Vector3<f64>| {
            let own = pose.rotation.tr_mul(&(point - pose.position));
            let rho = own.xy().norm();
            let across = (rho - outer).max(inner - rho).max(0.0);
            across.hypot((own.z.abs() - 0.5 * length).max(0.0))
        };
        points.map(distance).fold(f64::INFINITY, f64::min)
    }
}

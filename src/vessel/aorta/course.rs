//! A smooth centreline made of straight parts and bends.

use nalgebra::{Matrix3, Vector3};

use crate::numerics::onset::smooth_step;
use crate::numerics::quadrature::gauss_legendre;

/// Points of the quadrature along one part; they integrate its directions to rounding.
const POINTS: usize = 16;

/// Distance between the points of a centreline, m, where it is not longer for a long part.
const SPACING: f64 = 5e-3;

/// Most intervals of a part whose direction hardly turns.
const MOST: f64 = 12.0;

/// Turn between two points of a centreline, rad; a spline through them is then good to a micrometre.
const TURN: f64 = 0.06;

/// A part along which the direction turns smoothly, with neither curvature nor its slope at the ends.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bend {
    /// Length, m.
    pub(super) length: f64,
    /// Turn of the two angles of the direction, rad.
    pub(super) turn: [f64; 2],
}

impl Bend {
    /// A part that does not turn.
    pub(super) fn straight(length: f64) -> Self {
        Self { length, turn: [0.0; 2] }
    }
}

/// A centreline whose direction is `x sin(a) cos(b) + y sin(b) + z cos(a) cos(b)` with angles `a` and `b` that change along it.
#[derive(Debug, Clone)]
pub(super) struct Course {
    pub(super) origin: Vector3<f64>,
    /// The vectors x, y and z.
    pub(super) axes: Matrix3<f64>,
    /// The angles at the beginning, rad.
    pub(super) heading: [f64; 2],
    pub(super) bends: Vec<Bend>,
}

/// A point of a centreline.
#[derive(Debug, Clone, Copy)]
pub(super) struct CentrelinePoint {
    /// Position, m.
    pub(super) point: Vector3<f64>,
    /// Direction in which the centreline goes on.
    pub(super) direction: Vector3<f64>,
}

impl Course {
    /// Its length, m.
    pub(super) fn length(&self) -> f64 {
        self.bends.iter().map(|bend| bend.length).sum()
    }

    /// The place at this length (m) from its beginning; straight on beyond its end.
    pub(super) fn place(&self, station: f64) -> CentrelinePoint {
        let (nodes, weights) = gauss_legendre(POINTS);
        let (mut point, mut heading, mut left) = (self.origin, self.heading, station);
        for bend in &self.bends {
            let length = bend.length.min(left);
            let mut along = Vector3::zeros();
            for (node, weight) in nodes.iter().zip(&weights) {
                let at = 0.5 * length * (1.0 + node);
                along += self.direction(turned(heading, bend, at / bend.length)) * *weight;
            }
            point += along * (0.5 * length);
            heading = turned(heading, bend, length / bend.length);
            left -= length;
        }
        let direction = self.direction(heading);
        CentrelinePoint { point: point + direction * left, direction }
    }

    /// Lengths (m) from its beginning at which its points are, both ends and those of each part among them.
    pub(super) fn stations(&self) -> Vec<f64> {
        let mut out = vec![0.0];
        let mut start = 0.0;
        for bend in &self.bends {
            let [a, b] = bend.turn;
            let most = (bend.length / SPACING).min(MOST);
            let count = most.max(a.hypot(b) / TURN).max(1.0).ceil();
            let mut step = 1.0;
            while step <= count {
                out.push(start + bend.length * step / count);
                step += 1.0;
            }
            start += bend.length;
        }
        out
    }

    fn direction(&self, [a, b]: [f64; 2]) -> Vector3<f64> {
        self.axes * Vector3::new(a.sin() * b.cos(), b.sin(), a.cos() * b.cos())
    }
}

/// The heading after this share of a bend.
fn turned([a, b]: [f64; 2], bend: &Bend, share: f64) -> [f64; 2] {
    let share = smooth_step(share);
    [a + bend.turn[0] * share, b + bend.turn[1] * share]
}

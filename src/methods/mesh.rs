//! The collocation polynomial on an interval, and the subdivision of intervals.

use nalgebra::{Matrix3, Vector3};

use super::line::{Line, MaterialPoint};
use super::strong_form::{State, Vector12};
use super::surroundings::Surroundings;
use crate::design::SpanKind;
use crate::geometry::{RotationVector, rotation_log};
use crate::numerics::{lagrange, quadrature::gauss_legendre};

/// Largest number of parts into which an interval is divided at once.
const MOST_PARTS: usize = 4;

/// Gauss nodes on [0, 1] and the integration weights of the polynomial through them.
#[derive(Debug, Clone)]
pub(super) struct Tableau {
    pub(super) nodes: Vec<f64>,
    pub(super) weights: Vec<f64>,
    /// Integrals from 0 to each node.
    pub(super) inner: Vec<Vec<f64>>,
    /// Nodes on [-1, 1].
    symmetric: Vec<f64>,
}

/// Part of a span on which the rates of the local coordinates are a polynomial.
#[derive(Debug, Clone)]
pub(super) struct Interval {
    pub(super) place: MaterialPoint,
    pub(super) length: f64,
    /// Rates at the Gauss nodes, in local coordinates relative to the interval's start.
    pub(super) rates: Vec<Vector12>,
}

impl Tableau {
    pub(super) fn new(stages: usize) -> Self {
        let symmetric = gauss_legendre(stages).0;
        let half = |values: Vec<f64>| values.into_iter().map(|v| 0.5 * v).collect::<Vec<f64>>();
        Self {
            nodes: symmetric.iter().map(|x| 0.5 * (1.0 + x)).collect(),
            weights: half(lagrange::integrals(&symmetric, 1.0)),
            inner: symmetric.iter().map(|x| half(lagrange::integrals(&symmetric, *x))).collect(),
            symmetric,
        }
    }

    /// Values at `x` in [0, 1] of the Lagrange polynomials through the nodes.
    fn values(&self, x: f64) -> Vec<f64> {
        lagrange::values(&self.symmetric, 2.0 * x - 1.0)
    }

    /// Their integrals from 0 to `x`.
    fn integrals(&self, x: f64) -> Vec<f64> {
        lagrange::integrals(&self.symmetric, 2.0 * x - 1.0).iter().map(|v| 0.5 * v).collect()
    }
}

/// Weighted sum of rates.
fn sum(rates: &[Vector12], weights: &[f64]) -> Vector12 {
    rates.iter().zip(weights).fold(Vector12::zeros(), |sum, (rate, weight)| sum + rate * *weight)
}

fn turn(local: &Vector12) -> RotationVector {
    RotationVector::new(local.fixed_rows::<3>(3).into_owned())
}

impl Interval {
    /// The intervals of an element of a straight, unloaded chain.
    pub(super) fn straight(line: &Line, element: usize, intervals: usize, stages: usize) -> Vec<Self> {
        let mut rate = Vector12::zeros();
        rate[2] = 1.0;
        let mut out = Vec::new();
        for (piece, span) in line.spans[element].iter().enumerate() {
            let count = if span.kind == SpanKind::Disc { 1 } else { intervals };
            let length = span.length / count as f64;
            out.extend((0..count).map(|i| Self {
                place: MaterialPoint { element, piece, s: i as f64 * length },
                length,
                rates: vec![rate; stages],
            }));
        }
        out
    }

    /// Local coordinates at stage `j`.
    pub(super) fn local(&self, tableau: &Tableau, j: usize) -> Vector12 {
        sum(&self.rates, &tableau.inner[j]) * self.length
    }

    pub(super) fn end(&self, tableau: &Tableau) -> Vector12 {
        sum(&self.rates, &tableau.weights) * self.length
    }

    /// Place of stage `j`.
    pub(super) fn stage(&self, tableau: &Tableau, j: usize) -> MaterialPoint {
        self.at(tableau.nodes[j])
    }

    /// Place at the fraction `x`.
    pub(super) fn at(&self, x: f64) -> MaterialPoint {
        MaterialPoint { s: self.place.s + x * self.length, ..self.place }
    }

    /// Local coordinates at the fraction `x`.
    pub(super) fn local_at(&self, tableau: &Tableau, x: f64) -> Vector12 {
        sum(&self.rates, &tableau.integrals(x)) * self.length
    }

    /// Nondimensional residual of the equations at the ends of the interval, where that of the polynomial is largest.
    pub(super) fn residual(
        &self,
        around: &Surroundings<'_>,
        tableau: &Tableau,
        start: &State,
        scale: &Vector12,
    ) -> Option<f64> {
        let mut worst = 0.0;
        for x in [0.0, 1.0] {
            let required = around.local_rate(&self.at(x), start, &self.local_at(tableau, x))?;
            let missing = required - sum(&self.rates, &tableau.values(x));
            worst = f64::max(worst, missing.component_mul(scale).norm());
        }
        Some(worst)
    }

    /// This polynomial on equal parts, enough to reduce a residual that is `excess` times too large.
    pub(super) fn divided(&self, tableau: &Tableau, excess: f64) -> Vec<Self> {
        let stages = tableau.nodes.len() as f64;
        let parts = (2..MOST_PARTS).find(|n| (*n as f64).powf(stages) >= excess).unwrap_or(MOST_PARTS);
        (0..parts).map(|part| self.part(tableau, part as f64 / parts as f64, 1.0 / parts as f64)).collect()
    }

    /// The part of relative width `width` that starts at the fraction `from`.
    fn part(&self, tableau: &Tableau, from: f64, width: f64) -> Self {
        let start: Matrix3<f64> = turn(&self.local_at(tableau, from)).matrix();
        let rate = |node: &f64| {
            let x = from + width * node;
            let local = turn(&self.local_at(tableau, x));
            let mut rate = sum(&self.rates, &tableau.values(x));
            let turning: Vector3<f64> = local.left_jacobian() * rate.fixed_rows::<3>(3);
            let since = RotationVector::new(rotation_log(&(local.matrix() * start.transpose())));
            let inverse = since.left_jacobian_inverse().unwrap_or_else(Matrix3::identity);
            rate.fixed_rows_mut::<3>(3).copy_from(&(inverse * turning));
            rate
        };
        Self {
            place: self.at(from),
            length: self.length * width,
            rates: tableau.nodes.iter().map(rate).collect(),
        }
    }

    /// The interval rotated by `turn`.
    pub(super) fn turned(&self, turn: &Matrix3<f64>) -> Self {
        let rate = |rate: &Vector12| {
            let mut out = *rate;
            for k in 0..4 {
                out.fixed_rows_mut::<3>(3 * k).copy_from(&(turn * rate.fixed_rows::<3>(3 * k)));
            }
            out
        };
        Self { rates: self.rates.iter().map(rate).collect(), ..*self }
    }
}

//! A free turn: where device and loads are symmetric about the axis of the clamp, a bent shape turns about it without any
//! resistance.
//!
//! Such an equilibrium is neutral, which no eigenvalue shows: quadratures and rounding leave the turn some 1e-4 of the elastic
//! stiffness, of either sign. The symmetry itself shows it, and the turn is held in the search, so that an equilibrium is one
//! shape and not a family of them.

use serde::{Deserialize, Serialize};

use super::chain::Chain;
use crate::numerics::cholesky::dot;
use crate::numerics::eigenvalue::inner;
use crate::numerics::trust_region::norm;

/// Length of the turn by a radian (radian norm) below which a shape counts as straight.
const STRAIGHT: f64 = 1e-4;

/// Pairs of strain components that turn into each other: bending, and shear.
const PAIRS: [[usize; 2]; 2] = [[0, 1], [3, 4]];

/// The turn of a whole shape about the axis of its clamp.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct FreeTurn {
    /// The unknown that is held.
    held: usize,
}

impl FreeTurn {
    /// The turn of this shape; `None` where it is straight.
    pub(crate) fn of(chain: &Chain, metric: &[f64], unknowns: &[f64]) -> Option<Self> {
        let direction = direction(chain, unknowns);
        if norm(metric, &direction) < STRAIGHT * chain.radian_norm() {
            return None;
        }

        let share = |unknown: usize| metric[unknown] * direction[unknown] * direction[unknown];
        let held = (0..direction.len()).max_by(|a, b| share(*a).total_cmp(&share(*b)))?;
        Some(Self { held })
    }

    /// The unknown that is held, with the stiffness that holds it: as much as its own.
    pub(crate) fn hold(self, metric: &[f64]) -> (usize, f64) {
        (self.held, metric[self.held])
    }

    /// Removes the part of a gradient along the turn, which is that of quadratures and rounding.
    pub(crate) fn project(chain: &Chain, metric: &[f64], unknowns: &[f64], gradient: &mut [f64]) {
        let direction = direction(chain, unknowns);
        let square = inner(metric, &direction, &direction);
        if square == 0.0 {
            return;
        }

        let along = dot(gradient, &direction) / square;
        for ((slope, k), by) in gradient.iter_mut().zip(metric).zip(&direction) {
            *slope -= along * k * by;
        }
    }
}

/// Rate of the unknowns per radian of a turn of the whole shape about the axis of its clamp. Every element turns in the frame
/// of its own start.
pub(crate) fn direction(chain: &Chain, unknowns: &[f64]) -> Vec<f64> {
    let mut out = vec![0.0; unknowns.len()];
    for (element, first) in chain.elements.iter().zip(&chain.first) {
        let of = |c: usize| {
            let numbers = element.component.iter().enumerate();
            numbers.filter(move |(_, own)| **own == c).map(move |(i, _)| first + i)
        };
        for [x, y] in PAIRS.into_iter().flat_map(|[x, y]| of(x).zip(of(y)).map(|(x, y)| [x, y])) {
            (out[x], out[y]) = (-unknowns[y], unknowns[x]);
        }
    }
    out
}

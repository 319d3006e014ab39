//! Volume integrals of harmonic functions over an annular cylinder by a few nodes on its axis.
//!
//! A field without sources in a ball around the body is a sum of solid harmonics there. Integrated over an axisymmetric
//! body only the axial ones remain, and on the axis the one of degree `l` is `z^l`. So nodes `z_i` on the axis with
//! weights `w_i` such that `sum w_i z_i^l = M_l`, the volume integral of `r^l P_l(cos theta)`, integrate every
//! component of such a field over the body: a ring costs as many field evaluations as there are nodes, whatever its
//! shape.

use core::f64::consts::PI;

use nalgebra::Vector2;

use super::limits::{MAGNET_INNER_RADIUS, SIZE};
use super::multipole::axial_moment;
use super::sheet::DipoleSheet;
use crate::error::{Error, check};
use crate::numerics::bisection::bisect;

/// Half width of the interval of the nodes, relative to the body's extent `sqrt(a^2 + h^2)`, unless a larger one is
/// better, see [`reach_of`].
///
/// A small half width approaches the Taylor series (weights of alternating sign grow and lose digits); a large one
/// increases the error of the degrees that are not matched. At 0.6 the sum of `|w_i|` of 11 nodes is 3000 volumes, so
/// that rounding costs 1e-12 of the field; from 0.5 to 0.8, error and sum differ by a factor of about 5. More than 13
/// nodes need the larger one because of their weights.
const REACH: f64 = 0.6;
const REACH_OF_MANY: f64 = 0.7;

/// Largest half width tried, number of values tried, and number of bisections of the interval between two of them.
const LONGEST: f64 = 1.0;
const TRIED: usize = 16;
const BISECTIONS: usize = 30;

/// Extent over distance of the dipole for whose field the half width is optimised. It represents a ring at 0.45, whose
/// edges are equally affected by high degrees: from 0.28 to 0.4 the errors of two of the paper's rings are within a
/// factor of two.
const NEAR: f64 = 0.32;

/// Number of terms of the error estimate: the even degrees that follow the matched ones.
const ESTIMATED_DEGREES: usize = 16;

/// Nodes and weights on the axis of an annular cylinder centred at the origin.
///
/// ```
/// use mcm::magnetics::AxialRule;
/// let rule = AxialRule::new(0.75e-3, 2.0e-3, 1.0e-3, 7);
/// let volume = core::f64::consts::PI * (4.0 - 0.5625) * 1e-9;
/// let sum: f64 = rule.points().map(|(_, weight)| weight).sum();
/// assert!((sum / volume - 1.0).abs() < 1e-12);
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct AxialRule {
    points: Vec<(f64, f64)>,
    /// The points as dipoles of these volumes in a plane that contains the axis; their first coordinate is the height above
    /// the lower face.
    upright: DipoleSheet,
    /// `sqrt(a^2 + h^2)`, m.
    extent: f64,
    /// Errors of the even degrees from 2 at a distance of one extent, see [`AxialRule::error`].
    errors: Vec<f64>,
}

impl AxialRule {
    /// Largest number of nodes of a rule.
    pub const MOST_NODES: usize = 15;

    /// The rule with `nodes` nodes for the radii `inner` and `outer` and the length of the body, m.
    ///
    /// It integrates solid harmonics exactly up to the degree `nodes` for an odd and `nodes - 1` for an even number of
    /// nodes: an even number is no better than the odd one below it. A single node is at the centre.
    ///
    /// The dimensions are not checked: the rule is meaningless unless `0 <= inner < outer` and `length > 0`. Beyond
    /// [`AxialRule::MOST_NODES`], the rounding errors of the alternating weights outweigh the gain from the higher
    /// degree.
    #[must_use]
    pub fn new(inner: f64, outer: f64, length: f64, nodes: usize) -> Self {
        let extent = outer.hypot(0.5 * length);
        let shape = [inner / extent, outer / extent, 0.5 * length / extent];
        let moments: Vec<f64> = (0..nodes.div_ceil(2) + ESTIMATED_DEGREES)
            .map(|i| axial_moment(2 * i, shape[0], shape[1], shape[2]))
            .collect();
        let (half, shares) = upper_half(nodes, reach_of(nodes, &moments), &moments);
        let mut points = Vec::with_capacity(nodes);
        let volume = extent * extent * extent;
        for (&z, &share) in half.iter().zip(&shares).rev().filter(|(z, _)| **z > 0.0) {
            points.push((-z * extent, 0.5 * share * volume));
        }
        for (&z, &share) in half.iter().zip(&shares) {
            points.push((z * extent, volume * if z > 0.0 { 0.5 * share } else { share }));
        }
        let errors = errors(&half, &shares, &moments).map(f64::abs).collect();
        let above = |(z, weight): &(f64, f64)| (Vector2::new(z + 0.5 * length, 0.0), *weight);
        let upright = DipoleSheet::new(&points.iter().map(above).collect::<Vec<_>>());
        Self { points, upright, extent, errors }
    }

    /// The rule with the fewest nodes whose [`AxialRule::error`] at `distance` (m) is at most `tolerance`.
    ///
    /// `distance` is the distance of the nearest source of the field from the body's centre.
    ///
    /// # Errors
    /// [`Error::Range`] for dimensions out of range, or a tolerance that 15 nodes do not reach at that distance.
    pub fn for_accuracy(
        inner: f64,
        outer: f64,
        length: f64,
        distance: f64,
        tolerance: f64,
    ) -> Result<Self, Error> {
        SIZE.check("body's outer radius (m)", outer)?;
        MAGNET_INNER_RADIUS.check_beside("body's inner radius (m)", inner, outer)?;
        SIZE.check("body's length (m)", length)?;
        check("distance from the body to the nearest source (m)", distance, |v| v > 0.0, "> 0")?;
        check("relative tolerance", tolerance, |v| v > 0.0, "> 0")?;
        let mut reached = f64::INFINITY;
        for nodes in (1..=Self::MOST_NODES).step_by(2) {
            let rule = Self::new(inner, outer, length, nodes);
            reached = rule.error(distance).min(reached);
            if reached <= tolerance {
                return Ok(rule);
            }
        }
        Err(Error::range("relative tolerance", tolerance, format!(">= {reached:.1e} at this distance")))
    }

    /// Positions on the axis (m), ascending, with their weights (m3); the weights add up to the body's volume,
    /// individual ones may be negative.
    #[must_use]
    pub fn points(&self) -> impl ExactSizeIterator<Item = (f64, f64)> + '_ {
        self.points.iter().copied()
    }

    /// Positions on the axis (m) with their weights (m3), ascending, as a list.
    pub(crate) fn nodes(&self) -> &[(f64, f64)] {
        &self.points
    }

    /// The points as dipoles, by their weights, in a plane that contains the axis; their first coordinate is the height above
    /// the body's lower face.
    pub(crate) fn upright(&self) -> &DipoleSheet {
        &self.upright
    }

    /// Largest relative error for the field of a dipole at the given distance (m) from the centre.
    ///
    /// ```text
    /// sum over even l >= 2 of (l + 1)(l + 2)/2 |M_l - sum_i w_i z_i^l| / (V distance^l)
    /// ```
    ///
    /// A dipole on the axis is the worst case; extended sources, most of which are further away, cause smaller errors.
    /// Within the body's extent the series diverges and the result is infinite.
    #[must_use]
    pub fn error(&self, distance: f64) -> f64 {
        let ratio = self.extent / distance;
        if !(0.0..1.0).contains(&ratio) {
            return f64::INFINITY;
        }
        self.errors.iter().rev().fold(0.0, |sum, error| (sum + error) * ratio * ratio)
    }
}

/// Nodes at heights from 0 up, and their weights, in units of the extent: the Chebyshev nodes between `-reach` and
/// `reach`.
///
/// Each weight is the sum for both signs of the height. An odd number of nodes includes the centre.
fn upper_half(nodes: usize, reach: f64, moments: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let half: Vec<f64> = (0..nodes.div_ceil(2))
        .rev()
        .map(|i| {
            let centre = 2 * i + 1 == nodes;
            if centre { 0.0 } else { reach * (PI * (i as f64 + 0.5) / nodes as f64).cos() }
        })
        .collect();
    let squares: Vec<f64> = half.iter().map(|z| z * z).collect();
    let shares = vandermonde(&squares, moments[..half.len()].to_vec());
    (half, shares)
}

/// Half width of the interval of the nodes, relative to the extent.
///
/// It is the largest one, not below [`REACH`] or [`REACH_OF_MANY`], at which the errors of the degrees that follow the
/// matched ones cancel in the field of a dipole on the axis, so that nearly one more degree is matched; if there is
/// none, it is that limit. For thirteen nodes and the paper's ring, this reduces the error by a factor of ten.
fn reach_of(nodes: usize, moments: &[f64]) -> f64 {
    let shortest = if nodes > 13 { REACH_OF_MANY } else { REACH };
    let error = |reach: f64| {
        let (half, shares) = upper_half(nodes, reach, moments);
        let errors: Vec<f64> = errors(&half, &shares, moments).collect();
        errors.iter().rev().fold(0.0, |sum, error| (sum + error) * NEAR * NEAR)
    };
    let reach = |i: usize| LONGEST + (shortest - LONGEST) * i as f64 / TRIED as f64;
    let first = error(LONGEST);
    let Some(change) = (1..=TRIED).find(|&i| error(reach(i)) * first < 0.0) else { return shortest };
    bisect([reach(change - 1), reach(change)], BISECTIONS, |reach| error(reach) * first >= 0.0)[0]
}

/// `(l + 1)(l + 2)/2 (M_l - sum_i w_i z_i^l) / V` for even `l` from 2, in units of the extent; rounding errors where
/// `l` is matched.
fn errors(half: &[f64], shares: &[f64], moments: &[f64]) -> impl Iterator<Item = f64> {
    let mut powers = shares.to_vec();
    let squares: Vec<f64> = half.iter().map(|z| z * z).collect();
    moments.iter().enumerate().skip(1).map(move |(i, moment)| {
        for (power, square) in powers.iter_mut().zip(&squares) {
            *power *= square;
        }
        let l = 2 * i;
        ((l + 1) * (l + 2) / 2) as f64 * (moment - powers.iter().sum::<f64>()) / moments[0]
    })
}

/// Solves `sum_j x_j^i w_j = b_i` for `w`.
///
/// Source: A. Bjorck and V. Pereyra, Solution of Vandermonde systems of equations, Mathematics of Computation 24
/// (1970): accurate far beyond the condition number for ascending positive `x`.
fn vandermonde(x: &[f64], mut b: Vec<f64>) -> Vec<f64> {
    let n = x.len();
    for (k, &node) in x.iter().enumerate() {
        for i in (k + 1..n).rev() {
            b[i] -= node * b[i - 1];
        }
    }
    for k in (0..n.saturating_sub(1)).rev() {
        for i in k + 1..n {
            b[i] /= x[i] - x[i - k - 1];
        }
        for i in k..n - 1 {
            b[i] -= b[i + 1];
        }
    }
    b
}

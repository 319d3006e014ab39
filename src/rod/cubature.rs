//! Points over a span's section that resolve the field of a ring close by.

use core::f64::consts::{PI, TAU};

use nalgebra::Vector2;

use crate::design::{Span, SpiralKind};
use crate::numerics::quadrature::gauss_legendre;

/// How finely a section is resolved.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Fineness {
    /// Radial Gauss points (in the squared radius) of the spiral and of a disc.
    pub radial: usize,
    /// Angular points of the spiral's sector (Gauss), and of half a full circle (trapezoid).
    pub angular: usize,
}

/// A point of a section with its share of the volume.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SectionPoint {
    /// Position along `d1`, `d2`, m.
    pub position: Vector2<f64>,
    /// Volume, m3.
    pub volume: f64,
}

/// Points of the section of `span` at arc length `s` (m), for a length `weight` (m) of the span.
#[must_use]
pub fn section_points(span: &Span, s: f64, weight: f64, fineness: Fineness) -> Vec<SectionPoint> {
    let mut out = Vec::new();
    // The core's wall is thin against its distance from any ring.
    let radial = if span.spiral.is_some() { 1 } else { fineness.radial };
    let circle = 2 * fineness.angular;
    add_circle(&mut out, [span.inner_radius, span.outer_radius], weight * TAU, radial, circle);
    if let Some(spiral) = &span.spiral {
        let radii = [spiral.inner_radius, spiral.outer_radius];
        match spiral.kind {
            SpiralKind::Axisymmetric => {
                add_circle(&mut out, radii, weight * spiral.sector_angle, fineness.radial, circle);
            }
            SpiralKind::Helical => {
                let from = TAU * spiral.windings * s / span.length;
                add_sector(&mut out, radii, [from, from + spiral.sector_angle], weight, fineness);
            }
        }
    }
    out
}

/// Gauss points in the squared radius: radius and area per radian.
fn radii(bounds: [f64; 2], points: usize) -> impl Iterator<Item = (f64, f64)> {
    let [inner, outer] = bounds.map(|r| r * r);
    let (nodes, weights) = gauss_legendre(points);
    nodes.into_iter().zip(weights).map(move |(x, w)| {
        let square = 0.5 * (inner + outer + x * (outer - inner));
        (square.sqrt(), 0.25 * w * (outer - inner))
    })
}

/// An annulus of which `filled` (length times angle) is material, spread evenly.
fn add_circle(out: &mut Vec<SectionPoint>, bounds: [f64; 2], filled: f64, radial: usize, angular: usize) {
    for (radius, area) in radii(bounds, radial) {
        for k in 0..angular {
            let (sine, cosine) = (TAU * (k as f64 + 0.5) / angular as f64).sin_cos();
            let position = Vector2::new(radius * cosine, radius * sine);
            out.push(SectionPoint { position, volume: filled * area / angular as f64 });
        }
    }
}

fn add_sector(
    out: &mut Vec<SectionPoint>,
    bounds: [f64; 2],
    angles: [f64; 2],
    weight: f64,
    fineness: Fineness,
) {
    let (nodes, weights) = gauss_legendre(fineness.angular);
    let half = 0.5 * (angles[1] - angles[0]);
    debug_assert!(half <= PI, "a sector is at most a full circle");
    for (radius, area) in radii(bounds, fineness.radial) {
        for (x, w) in nodes.iter().zip(&weights) {
            let (sine, cosine) = (angles[0] + half * (1.0 + x)).sin_cos();
            let position = Vector2::new(radius * cosine, radius * sine);
            out.push(SectionPoint { position, volume: weight * area * half * w });
        }
    }
}

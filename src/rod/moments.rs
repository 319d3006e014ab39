//! Distribution of the material of a span: area, first and second moments of the section along the arc length.

use core::f64::consts::PI;

use nalgebra::{Matrix2, Vector2};

use crate::design::{SectorKind, Span};

/// Moments of some material about the centreline, over its section and a weighted length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SectionMoments {
    /// Volume, m3.
    pub volume: f64,
    /// First moment in `d1`, `d2`, m4.
    pub first: Vector2<f64>,
    /// Second moment in `d1`, `d2`, m5.
    pub second: Matrix2<f64>,
}

impl SectionMoments {
    /// No material.
    #[must_use]
    pub fn zero() -> Self {
        Self { volume: 0.0, first: Vector2::zeros(), second: Matrix2::zeros() }
    }

    /// Adds `weight` (m) times the section of `span` at arc length `s` (m) from the span's start.
    pub(super) fn add_section(&mut self, span: &Span, s: f64, weight: f64) {
        let [inner, outer] = span.radii_at(s);
        self.add_circle(inner, outer, 2.0 * PI, weight);
        let Some(spiral) = &span.spiral else { return };
        let (inner, outer, angle) = (spiral.inner_radius, spiral.outer_radius, spiral.sector_angle);
        match spiral.kind {
            SectorKind::Axisymmetric => self.add_circle(inner, outer, angle, weight),
            SectorKind::RightHanded | SectorKind::LeftHanded => {
                let [from, to] = spiral.sector(s, span.length);
                let third = weight * (outer.powi(3) - inner.powi(3)) / 3.0;
                let fourth = weight * (outer.powi(4) - inner.powi(4)) / 4.0;
                self.volume += weight * 0.5 * (outer.powi(2) - inner.powi(2)) * angle;
                self.first += Vector2::new(to.sin() - from.sin(), from.cos() - to.cos()) * third;
                let half_sine = 0.25 * ((2.0 * to).sin() - (2.0 * from).sin());
                let mixed = 0.5 * (to.sin().powi(2) - from.sin().powi(2));
                self.second +=
                    Matrix2::new(0.5 * angle + half_sine, mixed, mixed, 0.5 * angle - half_sine) * fourth;
            }
        }
    }

    /// Adds an annulus filled over `angle` of its circle, averaged around it.
    fn add_circle(&mut self, inner: f64, outer: f64, angle: f64, weight: f64) {
        self.volume += weight * 0.5 * angle * (outer.powi(2) - inner.powi(2));
        self.second += Matrix2::identity() * (weight * 0.125 * angle * (outer.powi(4) - inner.powi(4)));
    }

    /// The moments of the same material averaged around the centreline.
    #[must_use]
    pub fn axisymmetric(&self) -> Self {
        let second = Matrix2::identity() * (0.5 * self.second.trace());
        Self { volume: self.volume, first: Vector2::zeros(), second }
    }

    /// Whether the moments are physical: a positive volume and a positive semidefinite second central moment.
    ///
    /// Sums with negative weights need not be.
    pub(super) fn are_of_material(&self) -> bool {
        let spread = self.central();
        self.volume > 0.0 && spread.m11 >= 0.0 && spread.determinant() >= 0.0
    }

    /// Second moment about the centroid divided by the volume, m2.
    fn central(&self) -> Matrix2<f64> {
        let mean = self.first / self.volume;
        self.second / self.volume - mean * mean.transpose()
    }

    /// Mean square distance of the material from its centroid, m2.
    #[must_use]
    pub fn spread(&self) -> f64 {
        if self.volume <= 0.0 {
            return 0.0;
        }
        self.second.trace() / self.volume - (self.first / self.volume).norm_squared()
    }

    /// Centroid of the section; as a single point it integrates fields that are linear over the section exactly.
    #[must_use]
    pub fn centroid(&self) -> Vector2<f64> {
        if self.volume <= 0.0 { Vector2::zeros() } else { self.first / self.volume }
    }

    /// Four points of equal volume in the section plane with the same zeroth, first and second moments.
    ///
    /// Fields that are quadratic over the section are integrated exactly; for a cubic part the error is due to the section's
    /// third moment about its centroid alone.
    #[must_use]
    pub fn points(&self) -> [Vector2<f64>; 4] {
        if self.volume <= 0.0 {
            return [Vector2::zeros(); 4];
        }
        let mean = self.first / self.volume;
        let spread = self.central();
        // Lower Cholesky factor of the spread, which is positive: the annulus surrounds the centreline.
        let a = spread.m11.max(0.0).sqrt();
        let b = if a > 0.0 { spread.m21 / a } else { 0.0 };
        let c = (spread.m22 - b * b).max(0.0).sqrt();
        let factor = Matrix2::new(a, 0.0, b, c) * core::f64::consts::SQRT_2;
        let (first, second) = (factor.column(0).into_owned(), factor.column(1).into_owned());
        [mean + first, mean - first, mean + second, mean - second]
    }
}

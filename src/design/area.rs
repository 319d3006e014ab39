//! Areas of sections.

use core::f64::consts::PI;

/// Area of an annulus, m2.
pub(super) fn annulus_area(inner_radius: f64, outer_radius: f64) -> f64 {
    PI * (outer_radius - inner_radius) * (outer_radius + inner_radius)
}

//! Whether two bodies share volume.

use core::f64::consts::PI;

use nalgebra::Vector3;

use super::axial_source::AxialSource;
use crate::error::Error;
use crate::geometry::Pose;

/// Samples across the wall, along the axis and around of one body.
const SAMPLES: [usize; 3] = [5, 5, 48];

/// Share of a dimension that two bodies may overlap by rounding.
const HAIR: f64 = 1e-9;

/// Refuses two annular cylinders that overlap, the second at `pose` in the first one's frame.
///
/// Points of either body are looked for inside the other one: an overlap by less than about a tenth of the smaller dimension
/// can be missed.
pub(super) fn check(first: &AxialSource, second: &AxialSource, pose: &Pose) -> Result<(), Error> {
    let extent = |body: &AxialSource| body.outer_radius().hypot(0.5 * body.length());
    if pose.position.norm() > extent(first) + extent(second) {
        return Ok(());
    }
    let into_second = |point: &Vector3<f64>| pose.rotation.transpose() * (point - pose.position);
    let overlaps = points(second).any(|point| first.contains(&pose.transform(&point)))
        || points(first).any(|point| second.contains(&into_second(&point)));
    if overlaps {
        return Err(Error::Unsupported(format!(
            "the magnets overlap: the second one's centre is at ({:.3e}, {:.3e}, {:.3e}) m from the first one's",
            pose.position.x, pose.position.y, pose.position.z
        )));
    }
    Ok(())
}

/// Points all through a body, up to a hair from its surface: bodies may touch.
fn points(body: &AxialSource) -> impl Iterator<Item = Vector3<f64>> {
    let [across, along, around] = SAMPLES;
    let share = |i: usize, n: usize| 0.5 + (i as f64 / (n - 1) as f64 - 0.5) * (1.0 - HAIR);
    let (inner, outer, length) = (body.inner_radius(), body.outer_radius(), body.length());
    (0..across * along * around).map(move |index| {
        let (i, j, k) = (index % across, index / across % along, index / across / along);
        let rho = inner + (outer - inner) * share(i, across);
        let (sine, cosine) = (2.0 * PI * k as f64 / around as f64).sin_cos();
        Vector3::new(rho * cosine, rho * sine, length * (share(j, along) - 0.5))
    })
}

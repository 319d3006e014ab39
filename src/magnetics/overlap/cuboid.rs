//! Depth of a body in a cuboid.

use nalgebra::Vector3;

use super::{Outline, PARTS};
use crate::geometry::Pose;
use crate::numerics::maximum::largest;

/// Most steps along a line to the largest depth, which is the least of six linear functions.
const STEPS: usize = 8;

/// Largest value of `min(h_i - |x_i|)` over a body at `pose` in the frame of a cuboid with the half edges `h`; `None` if they are certainly
/// further apart than `slack`, m.
///
/// The function is concave. Along the body's third axis it is piecewise linear, and its maximum exact; across, nested golden-section
/// searches find it to 1e-10 of the body's size, with a bore as in [`super::Annulus`].
pub(super) fn level_in(body: &Outline, half: &Vector3<f64>, pose: &Pose, slack: f64) -> Option<f64> {
    if gap(body, half, pose) >= slack.max(f64::MIN_POSITIVE) {
        return None;
    }
    let extents = body.half_extents();
    let bore = if let Outline::Cylinder(annulus) = body { annulus.inner } else { 0.0 };
    let is_round = matches!(body, Outline::Cylinder(_));
    let parts = if bore > 0.0 { PARTS } else { 1 };
    let [first, second, axis]: [Vector3<f64>; 3] =
        core::array::from_fn(|i| pose.rotation.column(i).into_owned());

    let chord = |radius: f64, p: f64| (radius * radius - p * p).max(0.0).sqrt();
    let at = |p: f64| {
        let line = |q: f64| on_line(&(pose.position + first * p + second * q), &axis, extents.z, half);
        let best = |range: [f64; 2]| largest(line, range, 1, f64::NEG_INFINITY).0;
        let end = if is_round { chord(extents.x, p) } else { extents.y };
        let hole = chord(bore, p);
        if hole > 0.0 { best([-end, -hole]).max(best([hole, end])) } else { best([-end, end]) }
    };
    Some(largest(at, [-extents.x, extents.x], parts, f64::NEG_INFINITY).0)
}

/// Largest `min(h_i - |x_i|)` on the line through `centre` along `axis`, as far as `reach` to both sides.
fn on_line(centre: &Vector3<f64>, axis: &Vector3<f64>, reach: f64, half: &Vector3<f64>) -> f64 {
    // The least of the six functions and its slope.
    let least = |s: f64| {
        let point = centre + axis * s;
        let each = (0..3).map(|i| (half[i] - point[i].abs(), -axis[i] * point[i].signum()));
        each.fold((f64::INFINITY, 0.0), |least, next| if next.0 < least.0 { next } else { least })
    };
    let [mut from, mut to] = [-reach, reach];
    let [mut rising, mut falling] = [least(from), least(to)];
    for _ in 0..STEPS {
        if rising.1 <= 0.0 || falling.1 >= 0.0 {
            break;
        }
        // Where the lines that are least at the ends meet.
        let at = from + (falling.0 - rising.0 - falling.1 * (to - from)) / (rising.1 - falling.1);
        let here = least(at);
        if here.1 > 0.0 {
            (from, rising) = (at, here);
        } else {
            (to, falling) = (at, here);
        }
    }
    rising.0.max(falling.0)
}

/// A lower bound of the distance of a body from a cuboid: the largest separation along an axis of either.
fn gap(body: &Outline, half: &Vector3<f64>, pose: &Pose) -> f64 {
    let extents = body.half_extents();
    let turn = pose.rotation.abs();
    let own = pose.rotation.tr_mul(&pose.position);

    // Extent of the body along the cuboid's axes: a circle of radius R reaches R times the sine of its axis' angle.
    let of_body = |i: usize| {
        let across = match body {
            Outline::Cylinder(_) => extents.x * turn[(i, 0)].hypot(turn[(i, 1)]),
            Outline::Cuboid(_) => extents.x * turn[(i, 0)] + extents.y * turn[(i, 1)],
            Outline::Sphere(radius) => return *radius,
        };
        across + extents.z * turn[(i, 2)]
    };
    let along = (0..3).map(|i| pose.position[i].abs() - half[i] - of_body(i));
    let along_own = (0..3).map(|i| own[i].abs() - extents[i] - turn.column(i).dot(half));
    along.chain(along_own).fold(f64::NEG_INFINITY, f64::max)
}

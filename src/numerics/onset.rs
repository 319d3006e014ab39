//! A ramp that sets in smoothly, and its slope: a smooth step.

/// From 0 at `t = 0` to 1 at `t = 1`, with two derivatives that vanish at both ends, and constant beyond:
/// `6 t^5 - 15 t^4 + 10 t^3`.
///
/// ```
/// use mcm::numerics::onset::smooth_step;
/// assert_eq!([-1.0, 0.5, 2.0].map(smooth_step), [0.0, 0.5, 1.0]);
/// ```
#[must_use]
pub fn smooth_step(t: f64) -> f64 {
    let t = t.clamp(0.0, 1.0);
    t * t * t * (6.0 * t * t - 15.0 * t + 10.0)
}

/// First and second derivative of [`smooth_step`].
///
/// ```
/// use mcm::numerics::onset::smooth_step_slopes;
/// assert_eq!([-1.0, 0.5, 2.0].map(smooth_step_slopes), [[0.0, 0.0], [1.875, 0.0], [0.0, 0.0]]);
/// ```
#[must_use]
pub fn smooth_step_slopes(t: f64) -> [f64; 2] {
    let t = t.clamp(0.0, 1.0);
    let rest = 1.0 - t;
    [30.0 * t * t * rest * rest, 60.0 * t * rest * (rest - t)]
}

/// The integral of a ramp, the ramp and its slope at `x`; `None` before it sets in.
///
/// The slope rises from 0 at `-width` to 1 at `width` and stays there; the integral has four continuous derivatives:
///
/// ```text
/// slope = smooth_step(t)      t = (x + width) / (2 width)
/// ```
///
/// so that the ramp is `x` beyond the transition.
///
/// ```
/// use mcm::numerics::onset::onset;
/// assert_eq!(onset(-2.0, 1.0), None);
/// assert_eq!(onset(3.0, 1.0).map(|[_, ramp, slope]| (ramp, slope)), Some((3.0, 1.0)));
/// ```
#[must_use]
pub fn onset(x: f64, width: f64) -> Option<[f64; 3]> {
    let t = 0.5 * (x / width + 1.0);
    if t <= 0.0 {
        return None;
    }
    if t >= 1.0 {
        return Some([0.5 * x * x + width * width / 14.0, x, 1.0]);
    }
    let (full, cube) = (2.0 * width, t * t * t);
    Some([
        full * full * cube * t * t * (t * t / 7.0 - 0.5 * t + 0.5),
        full * cube * t * (t * t - 3.0 * t + 2.5),
        smooth_step(t),
    ])
}

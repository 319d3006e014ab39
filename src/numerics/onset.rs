//! A ramp that sets in smoothly.

/// The integral of a ramp, the ramp and its slope at `x`; `None` before it sets in.
///
/// The slope rises from 0 at `-width` to 1 at `width` and stays there; the integral has four continuous derivatives:
///
/// ```text
/// slope = 6 t^5 - 15 t^4 + 10 t^3      t = (x + width) / (2 width)
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
        cube * (6.0 * t * t - 15.0 * t + 10.0),
    ])
}

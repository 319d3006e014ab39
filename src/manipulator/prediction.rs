//! Prediction of a snap: the path parameter at which the stability margin vanishes.
//!
//! Towards a fold the margin goes to zero with the square root of the distance; where a symmetric shape loses its stability
//! without a fold, in proportion to it. Nearly symmetric shapes lie in between.

use crate::numerics::bisection::bisect;

/// Number of solved shapes that are of use.
pub(super) const REMEMBERED: usize = 4;

/// Margin below which a snap is predicted: farther away it does not yet follow the asymptotic power law.
const LARGEST_MARGIN: f64 = 0.35;

/// Powers of the distance with which the margin vanishes: at a fold, and without one.
const POWERS: [f64; 2] = [0.5, 1.0];

/// Largest factor by which the curvature of a law changes the distance of its zero.
const FARTHEST: f64 = 2.0;

/// Number of bisections of the interval of powers.
const HALVINGS: usize = 40;

/// Path parameter and margin of a shape.
type Shape = (f64, f64);

/// The path parameter at which the margin vanishes, from those and the margins of the shapes so far, latest last.
///
/// Two shapes assume the power of a fold. Three in one direction also determine the power within [`POWERS`] or, where it would lie
/// outside, the curvature at the nearer one; four determine power and curvature. `None` where the margin grows or is too large.
pub(super) fn predicted(shapes: &[Shape]) -> Option<f64> {
    let [.., before, last] = shapes else { return None };
    if !(last.1 < before.1 && last.1 < LARGEST_MARGIN) {
        return None;
    }
    let onwards = |pair: &&[Shape]| (pair[1].0 - pair[0].0) * (last.0 - before.0) > 0.0;
    let mut earlier = shapes.windows(2).rev().take_while(onwards).map(|pair| pair[0]).skip(1);

    let Some(third) = earlier.next() else {
        return Some(Law::line([*before, *last], POWERS[0]).zero());
    };
    let three = [third, *before, *last];
    let power = match earlier.next() {
        // Three margins with a power alone, four with a curvature too.
        None => power_of(third, |power| Law::line([*before, *last], power)),
        Some(fourth) => power_of(fourth, |power| Law::parabola(three, power)),
    };
    Some(Law::parabola(three, power).zero())
}

/// The one of [`POWERS`] or between them whose law comes nearest to the margin of `shape`, from which it was not made.
fn power_of(shape: Shape, law: impl Fn(f64) -> Law) -> f64 {
    let miss = |power: f64| law(power).margin(shape.0) - shape.1;
    let [fold, branching] = POWERS;
    let ends = POWERS.map(miss);
    if ends[0] * ends[1] > 0.0 {
        return if ends[0].abs() < ends[1].abs() { fold } else { branching };
    }
    let [low, high] = bisect(POWERS, HALVINGS, |power| miss(power) * ends[0] > 0.0);
    0.5 * (low + high)
}

/// The margin as the power of a parabola in the path parameter.
#[derive(Debug, Clone, Copy)]
struct Law {
    power: f64,
    /// Path parameter of the last shape, from which the parabola counts.
    origin: f64,
    height: f64,
    slope: f64,
    bend: f64,
    /// Slope between the last two shapes, which falls as the margin does.
    secant: f64,
}

impl Law {
    /// Through two margins, without curvature.
    fn line([before, last]: [Shape; 2], power: f64) -> Self {
        let [first, height] = [before.1, last.1].map(|margin| margin.powf(1.0 / power));
        let slope = (height - first) / (last.0 - before.0);
        Self { power, origin: last.0, height, slope, bend: 0.0, secant: slope }
    }

    /// Through three margins.
    fn parabola([third, before, last]: [Shape; 3], power: f64) -> Self {
        let (first, second) = (Self::line([third, before], power), Self::line([before, last], power));
        let bend = (second.slope - first.slope) / (last.0 - third.0);
        Self { slope: second.slope + bend * (last.0 - before.0), bend, ..second }
    }

    fn margin(&self, value: f64) -> f64 {
        let ahead = value - self.origin;
        (self.height + ahead * (self.slope + ahead * self.bend)).max(0.0).powf(self.power)
    }

    /// The zero of the parabola next to the last shape; where the curvature moves it too far from that of its tangent there, the zero
    /// of the tangent, or of the secant where the tangent's lies behind.
    fn zero(&self) -> f64 {
        let falls = self.slope * self.secant > 0.0;
        let tangent = -self.height / if falls { self.slope } else { self.secant };
        // Written so that no digits are lost where the parabola is flat.
        let root = (1.0 - 4.0 * self.bend * self.height / (self.slope * self.slope)).sqrt();
        let times = 2.0 / (1.0 + root);
        let near = falls && times > 1.0 / FARTHEST && times < FARTHEST;
        self.origin + tangent * if near { times } else { 1.0 }
    }
}

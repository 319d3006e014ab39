//! The maximum of a function of one variable.

/// Number of golden-section steps; they reduce an interval to 4e-11 of its width.
const STEPS: usize = 50;

/// Largest value of `f` between `low` and `high`, and its location.
///
/// The function is sampled at the ends of `parts` equal parts of the interval. Around each sample that is above `worth`
/// and not below its neighbours, a golden-section search follows (J. Kiefer, Proc. AMS 4, 1953, doi:10.2307/2032161).
/// It finds a maximum that is the only one in the two parts next to the sample. For a unimodal function one part
/// suffices: the maximum is located to 4e-11 of the interval.
///
/// ```
/// use mcm::numerics::maximum::largest;
/// let (value, place) = largest(|x: f64| -(x - 0.3).abs(), [0.0, 1.0], 1, f64::NEG_INFINITY);
/// assert!(value.abs() < 1e-10 && (place - 0.3).abs() < 1e-10);
/// assert_eq!(largest(|x: f64| x, [0.0, 2.0], 4, f64::NEG_INFINITY).0, 2.0); // at the end
/// ```
pub fn largest(mut f: impl FnMut(f64) -> f64, [low, high]: [f64; 2], parts: usize, worth: f64) -> (f64, f64) {
    let place = |i: usize| low + (high - low) * i as f64 / parts as f64;
    let values: Vec<f64> = (0..=parts).map(|i| f(place(i))).collect();
    let mut best = (f64::NEG_INFINITY, low);
    for (i, &value) in values.iter().enumerate() {
        if value > best.0 {
            best = (value, place(i));
        }
        let (before, after) = (i.saturating_sub(1), (i + 1).min(parts));
        if value > worth && value >= values[before] && value >= values[after] {
            let found = golden(&mut f, place(before), place(after));
            if found.0 > best.0 {
                best = found;
            }
        }
    }
    best
}

/// The maximum inside an interval in which `f` rises and then falls (is unimodal).
fn golden(f: &mut impl FnMut(f64) -> f64, mut low: f64, mut high: f64) -> (f64, f64) {
    let ratio = 0.5 * (5.0_f64.sqrt() - 1.0);
    let inner = |low: f64, high: f64| (high - ratio * (high - low), low + ratio * (high - low));
    let (mut a, mut b) = inner(low, high);
    let (mut at_a, mut at_b) = (f(a), f(b));
    for _ in 0..STEPS {
        if at_a >= at_b {
            (high, b, at_b) = (b, a, at_a);
            a = inner(low, high).0;
            at_a = f(a);
        } else {
            (low, a, at_a) = (a, b, at_b);
            b = inner(low, high).1;
            at_b = f(b);
        }
    }
    if at_a >= at_b { (at_a, a) } else { (at_b, b) }
}

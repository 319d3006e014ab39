//! Minimisation by Newton's method in a trust region, measured in the norm of a given diagonal metric `K`.
//!
//! The step of each iteration minimises the quadratic model inside the region: `(H + shift K) s = -g` with the `shift`
//! that puts `s` on the boundary (Moré and Sorensen, SIAM J. Sci. Stat. Comput. 4, 1983, doi:10.1137/0904038). It ends
//! at a minimum, not at a saddle: a saddle is left along the direction of negative curvature. A step that the model
//! predicts poorly is corrected to follow a curved valley.

use super::eigenvalue::{Lanczos, Search, inner};

/// Function to be minimised.
pub trait Objective {
    /// Computes and stores the gradient at `x`, keeping the Hessian of the last linearisation; returns the value, or
    /// `None` where it is not defined.
    fn slope(&mut self, x: &[f64]) -> Option<f64>;
    /// Computes and stores gradient and Hessian at `x`; returns the value, or `None` where it is not defined.
    fn linearise(&mut self, x: &[f64]) -> Option<f64>;
    /// The gradient of the last call of `slope` or `linearise`.
    fn gradient(&self) -> &[f64];
    /// Factorises `H + shift K`; returns whether it is positive definite.
    fn factorise(&mut self, shift: f64) -> bool;
    /// Whether the damped motion with the last factorised matrix dissipates energy in every direction.
    fn dissipates(&self) -> bool {
        true
    }
    /// Replaces `x` by `(H + shift K)^-1 x` with the last factorisation.
    fn solve(&mut self, x: &mut [f64]);
    /// The diagonal of `K`.
    fn metric(&self) -> &[f64];
}

/// Settings of the trust region; all lengths are in the norm of `K`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Region {
    /// Initial radius.
    pub radius: f64,
    /// Largest radius.
    pub largest: f64,
    /// Dual norm of the gradient at which a point counts as stationary.
    pub tolerance: f64,
    /// Largest number of iterations.
    pub iterations: u32,
}

/// Result of a minimisation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Minimum {
    /// Whether a stationary point with positive definite Hessian was reached.
    pub converged: bool,
    /// Iterations used.
    pub iterations: u32,
    /// Dual norm of the last gradient.
    pub residual: f64,
    /// Whether a saddle was left in a direction that symmetry leaves undetermined (a tie).
    pub tie: bool,
}

/// Radius, relative to the initial one, below which the search is given up.
const SMALLEST: f64 = 1e-10;

/// Relative change of the value below which rounding errors dominate it: values are sums with cancellation.
const ROUNDING: f64 = 1e-8;

/// Relative width of the bracket of the shift at which a step still inside the region is the hard case.
const HARD: f64 = 1e-3;

/// Factor on the radius after a rejected step.
const SHRINKING: f64 = 0.4;

/// Ratio of actual to predicted decrease above which the quadratic model is good.
const GOOD: f64 = 0.75;

/// Ratio from which on a corrected step is good, whose decrease the model predicts less well.
const FAIR: f64 = 0.4;

/// Stiffness, relative to the metric, above which a direction counts as a wall of a valley.
const STIFF: f64 = 0.05;

/// Size of the last correction, relative to the step, below which the corrections have converged.
const BENT: f64 = 0.05;

/// Largest number of corrections of a step.
const BENDS: u32 = 8;

/// Largest number of shifts tried for one step.
const SHIFTS: u32 = 40;

/// Norm of `x` in the metric.
#[must_use]
pub fn norm(metric: &[f64], x: &[f64]) -> f64 {
    inner(metric, x, x).sqrt()
}

/// Distance of two points in the metric.
#[must_use]
pub fn distance(metric: &[f64], a: &[f64], b: &[f64]) -> f64 {
    metric.iter().zip(a).zip(b).map(|((k, x), y)| k * (x - y) * (x - y)).sum::<f64>().sqrt()
}

/// Norm of a gradient in the inverse of the metric.
#[must_use]
pub fn dual_norm(metric: &[f64], g: &[f64]) -> f64 {
    metric.iter().zip(g).map(|(k, v)| v * v / k).sum::<f64>().sqrt()
}

/// Moves `x` to a minimum of `objective`; stops early when `proceed` returns false before an iteration.
pub fn minimise(
    objective: &mut impl Objective,
    x: &mut [f64],
    region: &Region,
    proceed: impl Fn() -> bool,
) -> Minimum {
    let mut radius = region.radius;
    let mut end = Minimum { converged: false, iterations: 0, residual: f64::INFINITY, tie: false };
    let Some(mut value) = objective.linearise(x) else { return end };
    let mut gradient = objective.gradient().to_vec();
    let (mut step, mut back) = (vec![0.0; x.len()], vec![0.0; x.len()]);
    let (mut trial, mut bent) = (vec![0.0; x.len()], vec![0.0; x.len()]);
    while end.iterations < region.iterations && proceed() {
        end.residual = dual_norm(objective.metric(), &gradient);
        let stationary = end.residual <= region.tolerance;
        let definite = objective.factorise(0.0);
        if stationary && definite {
            end.converged = true;
            return end;
        }
        end.iterations += 1;
        end.tie |= stationary;
        let Model { decrease, shift } = model_step(objective, &gradient, definite, radius, &mut step);
        let length = norm(objective.metric(), &step);
        trial.iter_mut().zip(x.iter().zip(&step)).for_each(|(t, (a, b))| *t = a + b);
        // Where rounding dominates the value, the decrease is computed from the gradients by the trapezoidal rule.
        let rounding = decrease.abs() <= ROUNDING * value.abs();
        let gain_at = |objective: &mut dyn Objective, trial: &[f64]| {
            let next = objective.slope(trial)?;
            let slopes = gradient.iter().zip(objective.gradient()).zip(trial.iter().zip(&*x));
            let descent = || slopes.map(|((g, h), (a, b))| -0.5 * (g + h) * (a - b)).sum::<f64>();
            Some(if rounding { descent() } else { value - next } / decrease)
        };
        let (mut gain, mut good) = (gain_at(objective, &trial), GOOD);
        if gain.is_some_and(|gain| gain < good) && objective.factorise(shift + STIFF) {
            for _ in 0..BENDS {
                let by = bend(objective, shift, &step, &mut back);
                bent.iter_mut().zip(trial.iter().zip(&back)).for_each(|(t, (a, b))| *t = a + b);
                let better = if by < length { gain_at(objective, &bent) } else { None };
                let Some(better) = better.filter(|better| gain.is_some_and(|gain| *better > gain)) else {
                    break;
                };
                (gain, good) = (Some(better), FAIR);
                std::mem::swap(&mut trial, &mut bent);
                if better > FAIR && by < BENT * length {
                    break;
                }
            }
        }
        match gain {
            Some(ratio) if ratio > 0.05 => {
                x.copy_from_slice(&trial);
                let Some(next) = objective.linearise(x) else { return end };
                value = next;
                gradient.copy_from_slice(objective.gradient());
                if ratio > good {
                    radius = region.largest.min(radius.max(2.0 * length));
                } else if ratio < 0.25 {
                    radius *= 0.5;
                }
            }
            _ => radius = SHRINKING * radius.min(length),
        }
        if radius < SMALLEST * region.radius {
            return end;
        }
    }
    end.residual = dual_norm(objective.metric(), &gradient);
    end
}

/// Writes the second-order correction of a step to `back`, so that it follows a curved valley; returns its norm.
///
/// The correction `-(H + (shift + STIFF) K)^-1 (g' + shift K s)` leads from the end of the step, where the quadratic
/// model predicts the gradient `-shift K s`, back down the stiff walls. It is the second-order correction of trust
/// regions (Conn, Gould and Toint, Trust-Region Methods, SIAM 2000, doi:10.1137/1.9780898719857, section 15.3.2.3),
/// with stiff walls in place of constraints.
fn bend(objective: &mut impl Objective, shift: f64, step: &[f64], back: &mut [f64]) -> f64 {
    let metric = objective.metric();
    for (((b, g), k), s) in back.iter_mut().zip(objective.gradient()).zip(metric).zip(step) {
        *b = -g - shift * k * s;
    }
    objective.solve(back);
    norm(objective.metric(), back)
}

/// Prediction of the quadratic model for its step.
struct Model {
    /// Predicted decrease.
    decrease: f64,
    /// Shift of the step.
    shift: f64,
}

/// The step inside `radius` that minimises the quadratic model.
fn model_step(
    objective: &mut impl Objective,
    gradient: &[f64],
    definite: bool,
    radius: f64,
    step: &mut [f64],
) -> Model {
    let mut shift = 0.0;
    let (mut low, mut high) = (0.0_f64, f64::INFINITY);
    let mut factored = definite;
    for _ in 0..SHIFTS {
        if factored {
            step.iter_mut().zip(gradient).for_each(|(s, g)| *s = -g);
            objective.solve(step);
            let length = norm(objective.metric(), step);
            if (length <= radius && shift == 0.0) || (length - radius).abs() <= 0.1 * radius {
                break;
            }
            if length < radius {
                high = high.min(shift);
                if high - low <= HARD * high {
                    let decrease = along_negative_curvature(objective, gradient, shift, radius, step);
                    return Model { decrease, shift };
                }
            } else {
                low = low.max(shift);
            }
            // Newton's method on 1/length, which is nearly linear in the shift.
            let mut image: Vec<f64> = step.iter().zip(objective.metric()).map(|(s, k)| s * k).collect();
            let weighted = image.clone();
            objective.solve(&mut image);
            let slope: f64 = image.iter().zip(&weighted).map(|(a, b)| a * b).sum();
            let newton = shift + (length * length / slope) * (length - radius) / radius;
            let inside = newton > low && newton < high;
            shift = if inside { newton } else { middle(low, high) };
        } else {
            low = low.max(shift);
            shift = middle(low, high);
        }
        if high.is_finite() && high - low <= HARD * high {
            shift = high;
        }
        factored = objective.factorise(shift);
    }
    let length = norm(objective.metric(), step);
    if length > radius {
        for s in step.iter_mut() {
            *s *= radius / length;
        }
    }
    // g.s + s.H s / 2 with H s = -g - shift K s holds for the unscaled step; for a scaled step it is conservative.
    let linear: f64 = gradient.iter().zip(step.iter()).map(|(g, s)| g * s).sum();
    let length = norm(objective.metric(), step);
    Model { decrease: 0.5 * (shift * length * length - linear), shift }
}

/// A value between the bounds of the shift; the eigenvalues relative to the metric are of order one.
fn middle(low: f64, high: f64) -> f64 {
    if high.is_finite() {
        (low * high).sqrt().max(0.5 * low + 0.01 * high).min(0.5 * (low + high).max(low))
    } else {
        (4.0 * low).max(0.05)
    }
}

/// Extends `step` to the boundary of the region along the direction of most negative curvature (hard case).
///
/// `step` solves `(H + shift K) s = -g` inside the region; the direction `z` has curvature `lambda`: the hard case of
/// Moré and Sorensen, as at a saddle. Returns the decrease that the model predicts, with `H s = -g - shift K s`.
fn along_negative_curvature(
    objective: &mut impl Objective,
    gradient: &[f64],
    shift: f64,
    radius: f64,
    step: &mut [f64],
) -> f64 {
    let metric = objective.metric().to_vec();
    let linear: f64 = gradient.iter().zip(step.iter()).map(|(g, s)| g * s).sum();
    let length = norm(&metric, step);
    let inside = 0.5 * (shift * length * length - linear);
    let mut direction = vec![0.0; step.len()];
    spread(&metric, &mut direction, 1.0);
    let search = Search { vectors: 40, settled: 1e-2 };
    let lambda =
        Lanczos::default().smallest(metric.as_slice(), shift, &mut direction, search, |x| objective.solve(x));
    let size = norm(&metric, &direction);
    let along =
        metric.iter().zip(&direction).zip(step.iter()).map(|((k, z), s)| k * z * s).sum::<f64>() / size;
    let root = (along * along + radius * radius - length * length).max(0.0).sqrt();
    let decrease = |tau: f64| tau * shift * along - 0.5 * tau * tau * lambda;
    // A tie is broken towards a positive sum of the components, for repeatability.
    let sign = if direction.iter().sum::<f64>() < 0.0 { -1.0 } else { 1.0 };
    let (one, other) = (sign * root - along, -sign * root - along);
    let tau = if decrease(one) >= decrease(other) { one } else { other };
    for (s, z) in step.iter_mut().zip(&direction) {
        *s += tau * z / size;
    }
    inside + decrease(tau)
}

/// Adds to `x` a fixed vector of norm about `size` in the metric, all of whose components are positive.
pub fn spread(metric: &[f64], x: &mut [f64], size: f64) {
    let golden = 0.618_033_988_749_894_9;
    let scale = size / (metric.len() as f64).sqrt();
    for (i, (entry, k)) in x.iter_mut().zip(metric).enumerate() {
        *entry += scale * (0.5 + (golden * (i + 1) as f64).fract()) / k.sqrt();
    }
}

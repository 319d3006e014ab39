//! Minimisation by Newton's method in a trust region, measured in the norm of a given diagonal metric `K`.
//!
//! The step of each iteration minimises the quadratic model inside the region: `(H + shift K) s = -g` with the
//! `shift` that puts `s` on the rim (Moré and Sorensen, SIAM J. Sci. Stat. Comput. 4, 1983). It ends at a
//! minimum, not at a saddle: from a saddle it leaves along the direction of negative curvature.

use super::eigenvalue::{Lanczos, Search, inner};

/// What is minimised.
pub trait Objective {
    /// Value at `x`; `None` where it is not defined.
    fn value(&mut self, x: &[f64]) -> Option<f64>;
    /// Computes gradient and Hessian at `x` and keeps them; the value, or `None` where it is not defined.
    fn linearise(&mut self, x: &[f64]) -> Option<f64>;
    /// The gradient of the last linearisation.
    fn gradient(&self) -> &[f64];
    /// Factorises `H + shift K`; whether it is positive definite.
    fn factorise(&mut self, shift: f64) -> bool;
    /// Replaces `x` by `(H + shift K)^-1 x` with the last factorisation.
    fn solve(&mut self, x: &mut [f64]);
    /// The diagonal of `K`.
    fn metric(&self) -> &[f64];
}

/// Knobs of the trust region; all lengths are in the norm of `K`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Region {
    /// First radius.
    pub radius: f64,
    /// Largest radius.
    pub largest: f64,
    /// The gradient's dual norm at which a point is stationary.
    pub tolerance: f64,
    /// Iterations at most.
    pub iterations: u32,
}

/// How a minimisation ended.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Minimum {
    /// Whether a stationary point with positive definite Hessian was reached.
    pub converged: bool,
    /// Iterations used.
    pub iterations: u32,
    /// Dual norm of the last gradient.
    pub residual: f64,
    /// Whether a saddle was left along a direction that its symmetry leaves open (a tie).
    pub tie: bool,
}

/// Smallest radius, relative to the first, before the search is given up.
const SMALLEST: f64 = 1e-10;

/// Change of the value, relative to it, of which its rounding leaves nothing to compare.
const ROUNDING: f64 = 1e-12;

/// Width of the bracket of the shift, relative to it, at which a step that is still inside the region is the hard case.
const HARD: f64 = 1e-3;

/// Shifts at most that are tried for one step.
const SHIFTS: u32 = 40;

/// Norm of `x` in the metric.
#[must_use]
pub fn norm(metric: &[f64], x: &[f64]) -> f64 {
    inner(metric, x, x).sqrt()
}

/// Norm of a gradient in the inverse of the metric.
#[must_use]
pub fn dual_norm(metric: &[f64], g: &[f64]) -> f64 {
    metric.iter().zip(g).map(|(k, v)| v * v / k).sum::<f64>().sqrt()
}

/// Moves `x` to a minimum of `objective`.
pub fn minimise(objective: &mut impl Objective, x: &mut [f64], region: &Region) -> Minimum {
    let mut radius = region.radius;
    let mut end = Minimum { converged: false, iterations: 0, residual: f64::INFINITY, tie: false };
    let Some(mut value) = objective.linearise(x) else { return end };
    let mut step = vec![0.0; x.len()];
    let mut trial = vec![0.0; x.len()];
    while end.iterations < region.iterations {
        end.residual = dual_norm(objective.metric(), objective.gradient());
        let stationary = end.residual <= region.tolerance;
        let definite = objective.factorise(0.0);
        if stationary && definite {
            end.converged = true;
            return end;
        }
        end.iterations += 1;
        end.tie |= stationary;
        let predicted = model_step(objective, definite, radius, &mut step);
        for (t, (a, b)) in trial.iter_mut().zip(x.iter().zip(&step)) {
            *t = a + b;
        }
        let gain = objective.value(&trial).map(|next| (value - next) / predicted);
        // Below the rounding of the value the ratio says nothing; the model is then trusted.
        let rounding = predicted.abs() <= ROUNDING * value.abs();
        match gain {
            Some(ratio) if ratio > 0.05 || (rounding && definite) => {
                x.copy_from_slice(&trial);
                let Some(next) = objective.linearise(x) else { return end };
                value = next;
                if ratio > 0.75 {
                    radius = region.largest.min(radius.max(2.0 * norm(objective.metric(), &step)));
                } else if ratio < 0.25 && !rounding {
                    radius *= 0.5;
                }
            }
            _ => radius = 0.25 * radius.min(norm(objective.metric(), &step)),
        }
        if radius < SMALLEST * region.radius {
            return end;
        }
    }
    end.residual = dual_norm(objective.metric(), objective.gradient());
    end
}

/// The step inside `radius` that minimises the quadratic model; returns the decrease that it predicts.
fn model_step(objective: &mut impl Objective, definite: bool, radius: f64, step: &mut [f64]) -> f64 {
    let mut shift = 0.0;
    let (mut low, mut high) = (0.0_f64, f64::INFINITY);
    let mut factored = definite;
    for _ in 0..SHIFTS {
        if factored {
            for (s, g) in step.iter_mut().zip(objective.gradient()) {
                *s = -g;
            }
            objective.solve(step);
            let length = norm(objective.metric(), step);
            if (length <= radius && shift == 0.0) || (length - radius).abs() <= 0.1 * radius {
                break;
            }
            if length < radius {
                high = high.min(shift);
                if high - low <= HARD * high {
                    return along_negative_curvature(objective, shift, radius, step);
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
    // g.s + s.H s / 2 with H s = -g - shift K s holds for the unscaled step; scaling errs on the safe side.
    let linear: f64 = objective.gradient().iter().zip(step.iter()).map(|(g, s)| g * s).sum();
    let length = norm(objective.metric(), step);
    0.5 * (shift * length * length - linear)
}

/// Between the bounds of the shift; the eigenvalues relative to the metric are of order one.
fn middle(low: f64, high: f64) -> f64 {
    if high.is_finite() {
        (low * high).sqrt().max(0.5 * low + 0.01 * high).min(0.5 * (low + high).max(low))
    } else {
        (4.0 * low).max(0.05)
    }
}

/// Lengthens `step`, which solves `(H + shift K) s = -g` inside the region, to its rim along the direction `z` of most
/// negative curvature `lambda`: the hard case of Moré and Sorensen, as at a saddle. Returns the decrease that the model
/// predicts, with `H s = -g - shift K s`.
fn along_negative_curvature(
    objective: &mut impl Objective,
    shift: f64,
    radius: f64,
    step: &mut [f64],
) -> f64 {
    let metric = objective.metric().to_vec();
    let linear: f64 = objective.gradient().iter().zip(step.iter()).map(|(g, s)| g * s).sum();
    let length = norm(&metric, step);
    let inside = 0.5 * (shift * length * length - linear);
    let mut direction = vec![0.0; step.len()];
    spread(&metric, &mut direction, 1.0);
    let search = Search { vectors: 40, settled: 1e-2 };
    let lambda = Lanczos::default().smallest(&metric, shift, &mut direction, search, |x| objective.solve(x));
    let size = norm(&metric, &direction);
    let along =
        metric.iter().zip(&direction).zip(step.iter()).map(|((k, z), s)| k * z * s).sum::<f64>() / size;
    let reach = (along * along + radius * radius - length * length).max(0.0).sqrt();
    let decrease = |tau: f64| tau * shift * along - 0.5 * tau * tau * lambda;
    // A tie is broken towards positive first components, for repeatability.
    let sign = if direction.iter().sum::<f64>() < 0.0 { -1.0 } else { 1.0 };
    let (one, other) = (sign * reach - along, -sign * reach - along);
    let tau = if decrease(one) >= decrease(other) { one } else { other };
    for (s, z) in step.iter_mut().zip(&direction) {
        *s += tau * z / size;
    }
    inside + decrease(tau)
}

/// Adds to `x` a fixed vector of norm `size` in the metric with a part in every direction.
pub fn spread(metric: &[f64], x: &mut [f64], size: f64) {
    let golden = 0.618_033_988_749_894_9;
    let scale = size / (metric.len() as f64).sqrt();
    for (i, (entry, k)) in x.iter_mut().zip(metric).enumerate() {
        *entry += scale * (0.5 + (golden * (i + 1) as f64).fract()) / k.sqrt();
    }
}

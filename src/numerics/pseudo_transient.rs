//! Pseudo-transient continuation: the overdamped motion `K dx/dt = -g(x)` followed by implicit Euler steps until it rests.
//!
//! It finds the equilibrium that a slow, damped motion ends at, also where the forces have no potential to descend. The steps
//! grow as the residual shrinks, so that the end is Newton's method. Source: Kelley and Keyes, SIAM J. Numer. Anal. 35, 508
//! (1998), doi:10.1137/S0036142996304796.

use super::trust_region::{Minimum, Objective, Region, dual_norm, norm};

/// First shift, the inverse of the first step in time: some tenths of the time constant of the elastic forces.
const FIRST: f64 = 2.0;

/// Growth of the shift after a step that was refused, and its least decrease after one that was taken.
const GROWTH: f64 = 4.0;
const DECREASE: f64 = 0.5;

/// Largest growth of the residual in one step: on the way over a hill it grows.
const UPHILL: f64 = 2.0;

/// Largest shift: steps so short lead nowhere.
const LARGEST: f64 = 1e8;

/// Moves `x` along the damped motion until the gradient's dual norm is within the tolerance of `region`, no step being longer
/// than its first radius, as long as `proceed` is true before a step. `converged` tells nothing about stability.
pub fn settle(
    objective: &mut impl Objective,
    x: &mut [f64],
    region: &Region,
    proceed: impl Fn() -> bool,
) -> Minimum {
    let mut end = Minimum { converged: false, iterations: 0, residual: f64::INFINITY, tie: false };
    let mut shift = FIRST;
    let (mut step, mut trial) = (vec![0.0; x.len()], vec![0.0; x.len()]);
    if objective.linearise(x).is_none() {
        return end;
    }
    let mut gradient = objective.gradient().to_vec();
    while end.iterations < region.iterations && shift < LARGEST && proceed() {
        end.residual = dual_norm(objective.metric(), &gradient);
        if end.residual <= region.tolerance {
            end.converged = true;
            return end;
        }
        end.iterations += 1;
        if !(objective.factorise(shift) && objective.dissipates()) {
            shift *= GROWTH;
            continue;
        }
        step.iter_mut().zip(&gradient).for_each(|(s, g)| *s = -g);
        objective.solve(&mut step);
        let work: f64 = gradient.iter().zip(&step).map(|(g, s)| g * s).sum();
        trial.iter_mut().zip(x.iter().zip(&step)).for_each(|(t, (a, b))| *t = a + b);
        let short = norm(objective.metric(), &step) <= region.radius;
        let residual = if short && work < 0.0 && objective.slope(&trial).is_some() {
            dual_norm(objective.metric(), objective.gradient())
        } else {
            f64::INFINITY
        };
        if residual > UPHILL * end.residual {
            shift *= GROWTH;
            continue;
        }
        x.copy_from_slice(&trial);
        if objective.linearise(x).is_none() {
            return end;
        }
        gradient.copy_from_slice(objective.gradient());
        shift *= (residual / end.residual).min(DECREASE);
    }
    end
}

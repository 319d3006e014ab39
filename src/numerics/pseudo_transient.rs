//! Pseudo-transient continuation: implicit Euler steps of the overdamped motion `K dx/dt = -g(x)` to rest.
//!
//! It finds the equilibrium in which a slow, damped motion ends, also where the forces are not conservative and there
//! is no potential to minimise. The steps grow as the residual shrinks, so that the method becomes Newton's at the end.
//! Source: Kelley and Keyes, SIAM J. Numer. Anal. 35, 508 (1998), doi:10.1137/S0036142996304796.

use super::trust_region::{Minimum, Objective, Region, dual_norm, norm};

/// Initial shift, the inverse of the first time step: that step is some tenths of the elastic forces' time constant.
const FIRST: f64 = 2.0;

/// Growth of the shift after a rejected step, and its minimum decrease after an accepted one.
const GROWTH: f64 = 4.0;
const DECREASE: f64 = 0.5;

/// Largest growth factor of the residual in one step: the motion may pass through a maximum of the residual.
const UPHILL: f64 = 2.0;

/// Largest shift: the time steps are then too short for progress.
const LARGEST: f64 = 1e8;

/// Moves `x` along the damped motion until the gradient's dual norm is within the tolerance of `region`.
///
/// No step is longer than the initial radius of `region`. The method stops early when `proceed` returns false before a
/// step. `converged` does not imply stability.
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

        // An implicit Euler step: (H + shift K) step = -g.
        step.iter_mut().zip(&gradient).for_each(|(s, g)| *s = -g);
        objective.solve(&mut step);
        let work: f64 = gradient.iter().zip(&step).map(|(g, s)| g * s).sum();
        trial.iter_mut().zip(x.iter().zip(&step)).for_each(|(t, (a, b))| *t = a + b);

        // A step uphill, or too long for the quadratic model, is taken anew with a shorter time step.
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

        // Switched evolution relaxation: the time step grows as the residual falls.
        shift *= (residual / end.residual).min(DECREASE);
    }
    end
}

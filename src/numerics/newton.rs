//! Newton's method, damped by the natural monotonicity test.
//!
//! A step is shortened until the *next* correction with the same derivative is smaller than the last: unlike the norm
//! of a residual, the norm of a correction does not depend on the scaling of the equations, and it estimates the
//! distance to the root. Source: Deuflhard, Newton Methods for Nonlinear Problems, Springer 2004, ch. 3 (algorithm
//! NLEQ-ERR).

use super::levenberg_marquardt::Ending;

/// Nonlinear equations in an unknown that may lie on a manifold.
pub trait Equations {
    /// The unknown.
    type Point: Clone;
    /// Computes and stores the residual at a point; returns its norm, or `None` where it is not defined.
    fn evaluate(&mut self, at: &Self::Point) -> Option<f64>;
    /// Computes and stores the residual and the factorised derivative; returns the residual's norm.
    fn linearise(&mut self, at: &Self::Point) -> Option<f64>;
    /// The correction for the last residual with the last derivative, in nondimensional coordinates.
    fn correction(&mut self) -> Option<Vec<f64>>;
    /// The point moved by the fraction `factor` of a correction.
    fn moved(&self, at: &Self::Point, step: &[f64], factor: f64) -> Self::Point;
}

/// Smallest damping factor that is tried.
const SMALLEST: f64 = 1e-4;

/// Norm of a correction (in the coordinates' unit) below which it consists of rounding errors only.
const ROUNDING: f64 = 1e-11;

fn norm(step: &[f64]) -> f64 {
    step.iter().map(|entry| entry * entry).sum::<f64>().sqrt()
}

/// Moves `x` to a root, in at most `iterations` linearisations.
///
/// The method has converged when the residual's norm is at most `tolerance`. If rounding keeps the residual above that
/// but within a thousand tolerances, a negligible correction also counts as convergence.
pub fn solve<E: Equations>(equations: &mut E, x: &mut E::Point, tolerance: f64, iterations: u32) -> Ending {
    let mut end = Ending { converged: false, iterations: 0, residual: f64::INFINITY };
    let mut damping = 1.0_f64;
    // Norm of the last correction, and the simplified correction that followed it.
    let mut last: Option<(f64, Vec<f64>)> = None;
    while end.iterations < iterations {
        let Some(residual) = equations.linearise(x) else { break };
        end.residual = residual;
        if residual <= tolerance {
            end.converged = true;
            break;
        }
        end.iterations += 1;
        let Some(step) = equations.correction() else { break };
        let length = norm(&step);
        if !length.is_finite() {
            break;
        }
        if length < ROUNDING {
            end.converged = residual <= 1e3 * tolerance;
            break;
        }
        if let Some((before, simplified)) = &last {
            // The change of the derivative over the last step predicts the damping of this one.
            let change: Vec<f64> = simplified.iter().zip(&step).map(|(a, b)| a - b).collect();
            let guess = before * norm(simplified) / (norm(&change) * length).max(f64::MIN_POSITIVE) * damping;
            damping = guess.clamp(SMALLEST, 1.0);
        }
        loop {
            let trial = equations.moved(x, &step, damping);
            let after =
                equations.evaluate(&trial).and_then(|residual| Some((residual, equations.correction()?)));
            let Some((residual, simplified)) = after.filter(|(_, next)| norm(next).is_finite()) else {
                damping *= 0.5;
                if damping < SMALLEST {
                    return end;
                }
                continue;
            };
            let left: Vec<f64> =
                simplified.iter().zip(&step).map(|(next, step)| next - (1.0 - damping) * step).collect();
            let best = 0.5 * length * damping * damping / norm(&left).max(f64::MIN_POSITIVE);
            if norm(&simplified) < (1.0 - 0.25 * damping) * length || residual <= tolerance {
                *x = trial;
                end.residual = residual;
                if residual <= tolerance {
                    end.converged = true;
                    return end;
                }
                last = Some((length, simplified));
                break;
            }
            if damping <= SMALLEST {
                return end;
            }
            damping = best.min(0.5 * damping).max(SMALLEST);
        }
    }
    end
}

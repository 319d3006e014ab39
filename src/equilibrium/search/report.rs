//! Report of a solve.

use super::outcome::Outcome;

/// Report of one solve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Report {
    /// How the solve ended; see [`Report::solved`].
    pub outcome: Outcome,
    /// Fraction of the input change that was reached, from 0 to 1; 1 where it is solved.
    pub progress: f64,
    /// Newton iterations.
    pub iterations: u32,
    /// Residual: dual norm of the gradient in the radian norm (1: one element's end turned by a radian).
    pub residual: f64,
    /// Stability margin: an upper bound, close near a fold, of the smallest eigenvalue of the Hessian in the
    /// elastic norm; see [`super::Equilibrium::margin`]. Along small steps it is that of the last factorisation, from
    /// which the present margin differs by some percent at most.
    pub margin: f64,
    /// Whether the equilibrium is stable; `None` where non-conservative forces leave it undetermined.
    pub stable: Option<bool>,
    /// Number of snaps to another branch in this solve.
    pub snaps: u32,
    /// Potential energy, J.
    pub energy: f64,
}

impl Report {
    /// Whether an equilibrium was found at the requested inputs.
    #[must_use]
    pub fn solved(&self) -> bool {
        self.outcome.is_solved()
    }

    pub(crate) fn start() -> Self {
        Self {
            outcome: Outcome::BranchEnds,
            progress: 0.0,
            iterations: 0,
            residual: f64::INFINITY,
            margin: 0.0,
            stable: None,
            snaps: 0,
            energy: 0.0,
        }
    }
}

//! What a solve tells.

use super::outcome::Outcome;

/// What a solve did.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Report {
    /// How it ended; see [`Report::solved`].
    pub outcome: Outcome,
    /// How far along the change of the inputs it got, from 0 to 1; 1 where it is solved.
    pub progress: f64,
    /// Newton iterations.
    pub iterations: u32,
    /// Dual norm of the gradient, relative to turning one element by a radian.
    pub residual: f64,
    /// Upper bound, close near a fold, of the smallest eigenvalue of the Hessian relative to the elastic
    /// energy; see [`super::Equilibrium::margin`]. Along small steps it is that of the last factorisation, which the
    /// present one undercuts or exceeds by some percent at most.
    pub margin: f64,
    /// Whether the equilibrium is stable; `None` where the forces have no potential to tell.
    pub stable: Option<bool>,
    /// Jumps to another branch in this solve.
    pub snaps: u32,
    /// Potential energy, J.
    pub energy: f64,
}

impl Report {
    /// Whether an equilibrium was found at the inputs asked for.
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

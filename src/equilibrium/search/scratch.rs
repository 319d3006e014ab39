//! Buffers of a solve, kept so that a step along the branch allocates nothing.

use crate::equilibrium::model::{Chain, EigenSearch};

/// Maximum number of Newton corrections for one part of an input change.
pub(super) const CORRECTIONS: usize = 12;

/// All buffers of a solve.
#[derive(Debug, Clone)]
pub(super) struct Scratch {
    /// The shape from which the solve has begun.
    pub(super) last: Vec<f64>,
    pub(super) buffers: Buffers,
    pub(super) eigen: EigenSearch,
}

/// Buffers of corrections.
#[derive(Debug, Clone)]
pub(super) struct Buffers {
    pub(super) trial: Vec<f64>,
    /// Difference of two shapes, and the step back.
    pub(super) between: Vec<f64>,
    /// Steps with one factorisation.
    pub(super) steps: Vec<Vec<f64>>,
}

impl Scratch {
    pub(super) fn new(chain: &Chain) -> Self {
        let zeros = vec![0.0; chain.freedoms()];
        let buffers =
            Buffers { trial: zeros.clone(), between: zeros.clone(), steps: vec![zeros.clone(); CORRECTIONS] };
        Self { last: zeros, buffers, eigen: EigenSearch::default() }
    }
}

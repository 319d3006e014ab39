//! The loads of rings on rings and on spans; kept, as they depend on the shape alone.

use super::chain::Chain;
use crate::geometry::Pose;
use crate::rod::Load;

/// Loads of all pairs at the shape for which they were last made.
#[derive(Debug, Clone)]
pub(super) struct PairLoads {
    /// On the nodes: forces and couples only.
    pub(super) nodes: Vec<Load>,
    /// On the stations, element by element.
    pub(super) stations: Vec<Vec<Load>>,
    /// `None` where they were not finished.
    pub(super) made: Option<Made>,
    pub(super) base: Pose,
    pub(super) unknowns: Vec<f64>,
}

/// How the loads were made.
#[derive(Debug, Clone, Copy)]
pub(super) struct Made {
    pub(super) energy: f64,
    /// Number of the rules.
    pub(super) rules: u64,
    pub(super) tabulated: bool,
}

impl PairLoads {
    pub(super) fn new(chain: &Chain) -> Self {
        Self {
            nodes: vec![Load::zero(); chain.elements.len() + 1],
            stations: chain.elements.iter().map(|e| vec![Load::zero(); e.stations.len()]).collect(),
            made: None,
            base: Pose::identity(),
            unknowns: vec![0.0; chain.freedoms()],
        }
    }

    /// The energy, if these are the loads at that shape with those rules; tabulated ones do where tables may stand.
    pub(super) fn at(&self, unknowns: &[f64], base: &Pose, rules: u64, tabulated: bool) -> Option<f64> {
        let alike = |made: &Made| made.rules == rules && (tabulated || !made.tabulated);
        let made = self.made.filter(|made| alike(made) && self.base == *base && self.unknowns == unknowns);
        made.map(|made| made.energy)
    }
}

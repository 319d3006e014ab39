//! Loads of rings on rings and on spans; stored, as they depend on the shape alone.

use super::chain::Chain;
use crate::geometry::Pose;
use crate::rod::Load;

/// Loads of all pairs at the shape at which they were last computed.
#[derive(Debug, Clone)]
pub(crate) struct PairLoads {
    /// Loads on the nodes: forces and couples only.
    pub(crate) nodes: Vec<Load>,
    /// Loads on the stations, element by element.
    pub(crate) stations: Vec<Vec<Load>>,
    /// `None` where their computation was not completed.
    pub(crate) made: Option<Made>,
    /// Pose of the first node, and the growth of the shaft.
    pub(crate) placed: (Pose, f64),
    pub(crate) unknowns: Vec<f64>,
}

/// Energy of the loads, and how they were computed.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Made {
    pub(crate) energy: f64,
    /// Version number of the quadrature rules.
    pub(crate) rules: u64,
}

impl PairLoads {
    pub(crate) fn new(chain: &Chain) -> Self {
        Self {
            nodes: vec![Load::zero(); chain.elements.len() + 1],
            stations: chain.elements.iter().map(|e| vec![Load::zero(); e.stations.len()]).collect(),
            made: None,
            placed: (Pose::identity(), 1.0),
            unknowns: vec![0.0; chain.freedoms()],
        }
    }

    /// The energy, if the loads are those at this shape with these rules.
    pub(crate) fn at(&self, unknowns: &[f64], placed: (Pose, f64), rules: u64) -> Option<f64> {
        let alike = |made: &Made| made.rules == rules && self.placed == placed && self.unknowns == unknowns;
        let made = self.made.filter(alike);
        made.map(|made| made.energy)
    }
}

//! The quadrature of each pair of rings: as few nodes as its distance and the accuracy allow.

use super::chain::Chain;
use crate::design::Ring;
use crate::geometry::Pose;
use crate::magnetics::AxialRule;

/// One quadrature rule per pair, upper triangle row by row, out of a table made once.
#[derive(Debug, Clone)]
pub(super) struct PairRules {
    /// Rules of each ring, by number of nodes.
    tables: Vec<Vec<AxialRule>>,
    chosen: Vec<usize>,
}

impl PairRules {
    pub(super) fn new(chain: &Chain) -> Self {
        let tables: Vec<Vec<AxialRule>> = chain.rings.iter().map(|body| table(&body.ring)).collect();
        let count = tables.len() * tables.len().saturating_sub(1) / 2;
        Self { tables, chosen: vec![0; count] }
    }

    /// Chooses the rules for the present node poses.
    pub(super) fn choose(&mut self, chain: &Chain, nodes: &[Pose], accuracy: f64) {
        let mut chosen = self.chosen.iter_mut();
        for (i, first) in chain.rings.iter().enumerate() {
            for second in &chain.rings[i + 1..] {
                let from = nodes[first.node].advanced(0.5 * first.ring.length);
                let to = nodes[second.node].advanced(0.5 * second.ring.length);
                let local = from.rotation.tr_mul(&(to.position - from.position));
                let reach = first.source.distance(&local);
                if let Some(slot) = chosen.next() {
                    *slot = choose(&second.ring, reach, accuracy);
                }
            }
        }
    }

    /// The rule of pair number `pair`, whose second ring is number `second`.
    pub(super) fn pair(&self, pair: usize, second: usize) -> &AxialRule {
        &self.tables[second][self.chosen[pair]]
    }

    /// The rule of ring number `ring` in a field whose sources are `reach` (m) away.
    pub(super) fn external(&self, ring: usize, body: &Ring, reach: f64, accuracy: f64) -> &AxialRule {
        &self.tables[ring][choose(body, reach, accuracy)]
    }
}

/// Largest table entry: rules of 1, 3, 5 ... nodes.
const LARGEST: usize = 9;

/// Rules of 1, 3, 5 ... nodes for one ring.
fn table(ring: &Ring) -> Vec<AxialRule> {
    (0..=LARGEST)
        .map(|k| AxialRule::new(ring.inner_radius, ring.outer_radius, ring.length, 2 * k + 1))
        .collect()
}

/// The table entry for sources `reach` (m) from the ring's centre: `2 k + 1` nodes leave out the terms of
/// degree `2 k + 2` and higher of the field's expansion, whose ratio is ring size to reach.
fn choose(ring: &Ring, reach: f64, accuracy: f64) -> usize {
    let ratio = ring.outer_radius.hypot(0.5 * ring.length) / reach;
    (0..LARGEST).find(|k| ratio.powi(2 * *k as i32 + 2) <= accuracy).unwrap_or(LARGEST)
}

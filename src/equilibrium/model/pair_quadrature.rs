//! Quadrature of each pair of rings: as few nodes as its distance and the accuracy allow.

use std::sync::Arc;

use super::chain::Chain;
use super::settings::Settings;
use super::span_quadrature::SpanQuadratures;
use crate::geometry::Pose;
use crate::magnetics::{AxialRule, PairRule, PairTable};

/// One quadrature rule for each pair, upper triangle row by row, from a table made once.
#[derive(Debug, Clone)]
pub(crate) struct PairQuadrature {
    /// One table for each ring; equal rings share theirs.
    tables: Vec<Arc<PairTable>>,
    chosen: Vec<usize>,
    /// The level of every element and ring, element by element; empty where rings do not act on spans.
    spans: Vec<usize>,
    /// Number of changes of the rules.
    number: u64,
    accuracy: f64,
}

impl PairQuadrature {
    /// For the chain and the settings that it was made with.
    pub(crate) fn new(chain: &Chain, settings: &Settings) -> Self {
        let count = chain.rings.len() * chain.rings.len().saturating_sub(1) / 2;
        let elements = if settings.interaction.acts_on_spans() { chain.elements.len() } else { 0 };
        let spans = vec![0; elements * chain.rings.len()];
        Self {
            tables: chain.pair_tables.clone(),
            chosen: vec![0; count],
            spans,
            number: 0,
            accuracy: settings.pair_accuracy,
        }
    }

    /// Chooses the rules for the present node poses; returns whether any rule has changed.
    pub(crate) fn choose(&mut self, chain: &Chain, nodes: &[Pose]) -> bool {
        let mut changed = false;
        let mut chosen = self.chosen.iter_mut();
        for (i, first) in chain.rings.iter().enumerate() {
            let from = first.centre(&nodes[first.node]);
            for (j, second) in chain.rings.iter().enumerate().skip(i + 1) {
                // Bodies that are welded to one another do not act on each other; their slot stays.
                if first.node == second.node {
                    chosen.next();
                    continue;
                }
                let to = second.centre(&nodes[second.node]);
                let seen = Pose {
                    position: from.rotation.tr_mul(&(to.position - from.position)),
                    rotation: from.rotation.tr_mul(&to.rotation),
                };
                if let Some(slot) = chosen.next() {
                    let rule = self.tables[j].choose(&first.source, &seen);
                    changed |= rule != std::mem::replace(slot, rule);
                }
            }
        }

        for (element, levels) in self.spans.chunks_exact_mut(chain.rings.len().max(1)).enumerate() {
            for (slot, body) in levels.iter_mut().zip(&chain.rings) {
                let level = chain.span_quadratures.level(element, body, nodes);
                changed |= level != std::mem::replace(slot, level);
            }
        }
        self.number += u64::from(changed);
        changed
    }

    /// Checksum that tells the chosen rules and levels from others: unlike [`Self::number`], equal choices of two equal devices have
    /// equal ones.
    pub(crate) fn fingerprint(&self) -> u32 {
        let mut sum = crc32fast::Hasher::new();
        self.chosen().for_each(|number| sum.update(&(number as u64).to_le_bytes()));
        sum.finalize()
    }

    /// The numbers of the chosen rules, then the levels.
    pub(crate) fn chosen(&self) -> impl Iterator<Item = usize> + '_ {
        self.chosen.iter().chain(&self.spans).copied()
    }

    /// Chooses the rules and levels with these numbers; returns false, without a change, if they do not exist.
    pub(crate) fn restore(&mut self, chosen: &[usize]) -> bool {
        let Some((pairs, spans)) = chosen.split_at_checked(self.chosen.len()) else { return false };
        let most = self.tables.iter().map(|table| table.len()).min().unwrap_or(0);
        let known = spans.len() == self.spans.len()
            && pairs.iter().all(|&number| number < most)
            && spans.iter().all(|&level| level < SpanQuadratures::LEVELS);
        if known && !self.chosen().eq(chosen.iter().copied()) {
            self.chosen.copy_from_slice(pairs);
            self.spans.copy_from_slice(spans);
            self.number += 1;
        }
        known
    }

    /// Relative accuracy that the rules are made for.
    pub(crate) fn accuracy(&self) -> f64 {
        self.accuracy
    }

    /// Version number of the rules: equal numbers mean equal rules.
    pub(crate) fn number(&self) -> u64 {
        self.number
    }

    /// The level of the samples of an element for a ring.
    pub(crate) fn span(&self, element: usize, ring: usize) -> usize {
        self.spans[element * self.tables.len() + ring]
    }

    /// The rule of pair number `pair`, whose second ring is number `second`.
    pub(crate) fn pair(&self, pair: usize, second: usize) -> PairRule<'_> {
        self.tables[second].rule(self.chosen[pair])
    }

    /// The rule of the pair of two rings, the proximal one first.
    pub(crate) fn between(&self, first: usize, second: usize) -> PairRule<'_> {
        let rings = self.tables.len();
        self.pair(first * (2 * rings - first - 1) / 2 + second - first - 1, second)
    }

    /// The rule of ring number `ring` in a field whose sources are `reach` (m) away.
    pub(crate) fn external(&self, ring: usize, reach: f64) -> &AxialRule {
        self.tables[ring].external(reach)
    }
}

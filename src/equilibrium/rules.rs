//! The quadrature of each pair of rings: as few nodes as its distance and the accuracy allow.

use super::chain::Chain;
use super::settings::Settings;
use super::views::Views;
use crate::design::Ring;
use crate::geometry::Pose;
use crate::magnetics::AxialRule;

/// Rules of one ring, fewest nodes first, each with the distances (m) of the nearest source from which on it
/// is accurate enough: for a field of given size, and for that of another ring, which decays.
type Table = Vec<(f64, f64, AxialRule)>;

/// Bisections of that distance.
const BISECTIONS: usize = 40;

/// One quadrature rule per pair, upper triangle row by row, out of a table made once.
#[derive(Debug, Clone)]
pub(super) struct PairRules {
    tables: Vec<Table>,
    chosen: Vec<usize>,
    /// The level of every element and ring, element by element; none where rings do not act on spans.
    spans: Vec<usize>,
    /// How often they have changed.
    number: u64,
}

impl PairRules {
    /// Tables for the accuracy and the interaction of `settings`.
    pub(super) fn new(chain: &Chain, settings: &Settings) -> Self {
        let accuracy = settings.pair_accuracy;
        let tables: Vec<Table> = chain.rings.iter().map(|body| table(&body.ring, accuracy)).collect();
        let count = tables.len() * tables.len().saturating_sub(1) / 2;
        let elements = if settings.interaction.acts_on_spans() { chain.elements.len() } else { 0 };
        let spans = vec![0; elements * chain.rings.len()];
        Self { tables, chosen: vec![0; count], spans, number: 0 }
    }

    /// Chooses the rules for the present node poses; whether any is another one than before.
    pub(super) fn choose(&mut self, chain: &Chain, nodes: &[Pose]) -> bool {
        let mut changed = false;
        let mut chosen = self.chosen.iter_mut();
        for (i, first) in chain.rings.iter().enumerate() {
            for (j, second) in chain.rings.iter().enumerate().skip(i + 1) {
                let from = first.centre(&nodes[first.node]);
                let to = second.centre(&nodes[second.node]);
                let local = from.rotation.tr_mul(&(to.position - from.position));
                if let Some(slot) = chosen.next() {
                    let rule = fewest(&self.tables[j], |entry| entry.1 <= first.source.distance(&local));
                    changed |= rule != std::mem::replace(slot, rule);
                }
            }
        }
        for (slot, (ends, body)) in self
            .spans
            .iter_mut()
            .zip(nodes.windows(2).flat_map(|ends| chain.rings.iter().map(move |body| (ends, body))))
        {
            let level = Views::level(&nodes[body.node], [&ends[0], &ends[1]]);
            changed |= level != std::mem::replace(slot, level);
        }
        self.number += u64::from(changed);
        changed
    }

    /// The numbers of the chosen rules, then the levels.
    pub(super) fn chosen(&self) -> impl Iterator<Item = usize> + '_ {
        self.chosen.iter().chain(&self.spans).copied()
    }

    /// Chooses by these numbers; false, and nothing happens, if there are no such rules or levels.
    pub(super) fn restore(&mut self, chosen: &[usize]) -> bool {
        let Some((pairs, spans)) = chosen.split_at_checked(self.chosen.len()) else { return false };
        let most = self.tables.iter().map(Vec::len).min().unwrap_or(0);
        let known = spans.len() == self.spans.len()
            && pairs.iter().all(|&number| number < most)
            && spans.iter().all(|&level| level < Views::LEVELS);
        if known && !self.chosen().eq(chosen.iter().copied()) {
            self.chosen.copy_from_slice(pairs);
            self.spans.copy_from_slice(spans);
            self.number += 1;
        }
        known
    }

    /// How often the rules have changed: the same number, the same rules.
    pub(super) fn number(&self) -> u64 {
        self.number
    }

    /// The level of the samples of an element for a ring.
    pub(super) fn span(&self, element: usize, ring: usize) -> usize {
        self.spans[element * self.tables.len() + ring]
    }

    /// The rule of pair number `pair`, whose second ring is number `second`.
    pub(super) fn pair(&self, pair: usize, second: usize) -> &AxialRule {
        &self.tables[second][self.chosen[pair]].2
    }

    /// The rule of the pair of two rings, the earlier first.
    pub(super) fn between(&self, first: usize, second: usize) -> &AxialRule {
        let rings = self.tables.len();
        self.pair(first * (2 * rings - first - 1) / 2 + second - first - 1, second)
    }

    /// The rule of ring number `ring` in a field whose sources are `reach` (m) away.
    pub(super) fn external(&self, ring: usize, reach: f64) -> &AxialRule {
        let table = &self.tables[ring];
        &table[fewest(table, |entry| entry.0 <= reach)].2
    }
}

/// Rules of 1, 3, 5 ... nodes for one ring, with the distance from which on each is accurate.
fn table(ring: &Ring, accuracy: f64) -> Table {
    let extent = ring.outer_radius.hypot(0.5 * ring.length);
    (1..=AxialRule::MOST_NODES)
        .step_by(2)
        .map(|nodes| {
            let rule = AxialRule::new(ring.inner_radius, ring.outer_radius, ring.length, nodes);
            // The energy of two dipoles falls with the cube of their distance.
            let field = reach_of(|ratio| rule.error(extent / ratio) <= accuracy);
            let pair = reach_of(|ratio| rule.error(extent / ratio) * (2.0 * ratio).powi(3) <= accuracy);
            (extent / field, extent / pair, rule)
        })
        .collect()
}

/// Bisects the ratio of extent to distance, between infinitely far and touching, up to which `holds`.
fn reach_of(holds: impl Fn(f64) -> bool) -> f64 {
    let (mut far, mut near) = (0.0, 1.0);
    for _ in 0..BISECTIONS {
        let middle = 0.5 * (near + far);
        if holds(middle) {
            far = middle;
        } else {
            near = middle;
        }
    }
    far
}

/// The first entry that is accurate enough, or else the last.
fn fewest(table: &Table, accurate: impl Fn(&(f64, f64, AxialRule)) -> bool) -> usize {
    table.iter().position(accurate).unwrap_or(table.len() - 1)
}

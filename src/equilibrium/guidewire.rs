//! A guidewire inside the device: the bending stiffness that it adds as far as it reaches.
//!
//! Covered and bare parts of the arc length that a station stands for bend in series: their compliances add up. The covered part
//! grows smoothly while the wire's end passes, from the middle of the share of the station before to that of the station behind; at the port, where the shaft ends, and at the faces of rings it ends with
//! the station's own share. So nothing jumps, and nothing changes while the end is in a ring, which is rigid.

use super::chain::Chain;
use super::workspace::Workspace;
use crate::design::Guidewire;
use crate::numerics::onset::{smooth_step, smooth_step_slopes};
use crate::rod::{Element, Station};

/// Stiffness of the guidewire, and where it sets in at each station.
#[derive(Debug, Clone)]
pub(super) struct Lining {
    /// Bending stiffness of the wire, N m2.
    stiffness: f64,
    /// Number of elements of the shaft.
    shaft: usize,
    /// Length of the shaft's tables, m.
    tables: f64,
    /// By element and station: arc lengths (m) of the wire's end between which the wire sets in, those of the shaft in its tables,
    /// the others from the end of the shaft.
    windows: Vec<Vec<[f64; 2]>>,
    /// By element and station: ratio of the wire's bending stiffness to that of the section.
    ratios: Vec<Vec<f64>>,
    /// By element and station: weight in the mean over the element, per its length, 1/m.
    rotational: Vec<Vec<f64>>,
}

/// Stiffness of the wire at a station, and its derivatives.
#[derive(Debug, Clone, Copy)]
struct Share {
    value: f64,
    by_reach: f64,
    by_insertion: f64,
    by_both: f64,
}

impl Lining {
    pub(super) fn new(wire: &Guidewire, elements: &[Element], shaft: usize) -> Self {
        let mut windows: Vec<Vec<[f64; 2]>> = Vec::new();
        let mut start = 0.0;
        let joined = |k: usize| k > 0 && k != shaft && elements[k].offset == 0.0;
        for (k, element) in elements.iter().enumerate().filter(|(k, _)| !joined(*k)) {
            let together = (k + 1..elements.len()).take_while(|next| joined(*next)).count() + 1;
            start = element.offset + if k == shaft { 0.0 } else { start };
            let run = &elements[k..k + together];
            let places = windows_of(&mut start, run.iter().flat_map(|element| &element.stations));
            let mut places = places.into_iter();
            windows.extend(run.iter().map(|element| places.by_ref().take(element.stations.len()).collect()));
        }
        let tables = elements[..shaft].iter().map(|element| element.length).sum();
        let rotational = elements.iter().map(|element| {
            let square = element.length * element.length;
            element.stations.iter().map(|station| station.weight / square).collect()
        });
        let rotational = rotational.collect();
        let stiffness = wire.bending_stiffness();
        let ratios = elements.iter().map(|element| {
            element.stations.iter().map(|station| stiffness / station.stiffness.bending).collect()
        });
        Self { stiffness, shaft, tables, windows, ratios: ratios.collect(), rotational }
    }

    /// The wire at the stations of an element, for the growth of the shaft and the reach of the wire (m).
    fn shares(&self, element: usize, [growth, reach]: [f64; 2]) -> impl Iterator<Item = Share> + '_ {
        let in_shaft = element < self.shaft;
        self.windows[element].iter().zip(&self.ratios[element]).map(move |([from, to], ratio)| {
            let width = to - from;
            // Where the wire's end is on the scale of the window, and its derivatives.
            let (at, by_reach, by_insertion, by_both) = if in_shaft {
                let square = growth * growth * self.tables;
                (reach / growth, 1.0 / growth, -reach / square, -1.0 / square)
            } else {
                (reach - growth * self.tables, 1.0, -1.0, 0.0)
            };
            let t = (at - from) / width;
            let (covered, [slope, curve]) = (smooth_step(t), smooth_step_slopes(t));
            let bare = 1.0 + ratio * (1.0 - covered);
            // The stiffness by the covered part, then by where the end is.
            let rate = self.stiffness * (1.0 + ratio) / (bare * bare);
            let curve = rate * (curve + 2.0 * ratio / bare * slope * slope) / (width * width);
            let slope = rate * slope / width;
            Share {
                value: self.stiffness * covered / bare,
                by_reach: slope * by_reach,
                by_insertion: slope * by_insertion,
                by_both: curve * by_reach * by_insertion + slope * by_both,
            }
        })
    }
}

/// Windows of stations without a rigid part between them, the first share of which begins at `start`, which moves on to the end of
/// the last.
fn windows_of<'a>(start: &mut f64, stations: impl Iterator<Item = &'a Station>) -> Vec<[f64; 2]> {
    let mut ends = vec![*start];
    for station in stations {
        *start += station.weight;
        ends.push(*start);
    }
    let last = ends.len() - 1;
    let middle = |share: usize| 0.5 * (ends[share] + ends[share + 1]);
    let window = |own: usize| {
        let from = if own == 0 { ends[0] } else { middle(own - 1) };
        let to = if own + 1 == last { ends[last] } else { middle(own + 1) };
        [from, to]
    };
    (0..last).map(window).collect()
}

impl Workspace {
    /// Gives every station the wire's stiffness there.
    pub(super) fn line(&mut self, lining: &Lining) {
        let lengths = [self.growth, self.reach];
        for (k, (configuration, total)) in self.configurations.iter_mut().zip(&mut self.lined).enumerate() {
            *total = 0.0;
            for ((state, share), weight) in
                configuration.stations.iter_mut().zip(lining.shares(k, lengths)).zip(&lining.rotational[k])
            {
                state.lining = share.value;
                *total += share.value * weight / configuration.growth;
            }
        }
    }

    /// Derivative of the wire's energy with respect to the inserted length of the shaft (N) at a fixed shape, but for what the growth
    /// of the elements changes.
    pub(super) fn lining_push(&self, chain: &Chain) -> f64 {
        self.lining_energy(chain, chain.elements.len(), |share| share.by_insertion)
    }

    /// Derivative of the same push, with what growth changes, with respect to the reach of the wire, N/m.
    pub(super) fn lining_push_by_reach(&self, chain: &Chain) -> f64 {
        let shaft = self.lining_energy(chain, chain.shaft, |share| share.by_reach);
        self.lining_energy(chain, chain.elements.len(), |share| share.by_both)
            - shaft / chain.inserted(self.growth)
    }

    /// Derivatives of the gradient with respect to the reach of the wire; `None` without a wire.
    pub(super) fn lining_gradient_by_reach(&self, chain: &Chain) -> Option<Vec<f64>> {
        let lining = chain.lining.as_ref()?;
        let of = |(k, element): (usize, &Element)| {
            let rates = lining.shares(k, [self.growth, self.reach]).map(|share| share.by_reach);
            self.configurations[k].lining_gradient(element, rates)
        };
        Some(chain.elements.iter().enumerate().flat_map(of).collect())
    }

    /// Energy (J) of the first `count` elements for linings of the stiffness that `part` takes of the wire's; 0 without a wire.
    fn lining_energy(&self, chain: &Chain, count: usize, part: fn(Share) -> f64) -> f64 {
        let Some(lining) = &chain.lining else { return 0.0 };
        let of = |(k, element): (usize, &Element)| {
            self.configurations[k]
                .lining_energy(element, lining.shares(k, [self.growth, self.reach]).map(part))
        };
        chain.elements[..count].iter().enumerate().map(of).sum()
    }
}

//! What a guidewire does to the device: stiffness of every station, energy, and its derivatives by length and reach.

use super::chain::Chain;
use super::guidewire::{Lining, Share};
use super::workspace::Workspace;
use crate::rod::Element;

impl Workspace {
    /// Gives every station the wire's stiffness there.
    pub(crate) fn line(&mut self, lining: &Lining) {
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
    pub(crate) fn lining_push(&self, chain: &Chain) -> f64 {
        self.lining_energy(chain, chain.elements.len(), |share| share.by_insertion)
    }

    /// Derivative of the same push, with what growth changes, with respect to the reach of the wire, N/m.
    pub(crate) fn lining_push_by_reach(&self, chain: &Chain) -> f64 {
        let shaft = self.lining_energy(chain, chain.shaft, |share| share.by_reach);
        self.lining_energy(chain, chain.elements.len(), |share| share.by_both)
            - shaft / chain.inserted(self.growth)
    }

    /// Derivatives of the gradient with respect to the reach of the wire; `None` without a wire.
    pub(crate) fn lining_gradient_by_reach(&self, chain: &Chain) -> Option<Vec<f64>> {
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

//! Helices and rings that differ along a chain: the quantities of each, and the one that every segment has.

use core::ptr;

use super::quantities as of;
use super::specification::{Helix, RingMagnet, Segmented};
use super::value_list::ValueList;
use crate::error::Quantity;

impl ValueList {
    /// Whether it has one value for each ring, not for each segment.
    #[must_use]
    pub fn is_of_rings(&self) -> bool {
        RingMagnet::QUANTITIES.iter().any(|quantity| self.is_of(quantity))
    }
}

impl Helix {
    /// The quantities of a helix.
    pub const QUANTITIES: [&'static Quantity; 11] = [
        &of::HELIX_LENGTH,
        &of::HELIX_BOUNDARY_ANGLE,
        &of::HELIX_RADIUS,
        &of::HELIX_WINDINGS,
        &of::HELIX_CORE_OUTER_RADIUS,
        &of::HELIX_CORE_INNER_RADIUS,
        &of::HELIX_SHORE_A,
        &of::HELIX_POISSON,
        &of::HELIX_VOLUME_FRACTION,
        &of::HELIX_PARTICLE_REMANENCE,
        &of::HELIX_DENSITY,
    ];

    /// The number that holds a quantity; `None` for a quantity of something else.
    pub fn entry(&mut self, quantity: &'static Quantity) -> Option<&mut f64> {
        let number = Self::QUANTITIES.iter().position(|own| ptr::eq(*own, quantity))?;
        let entries: [fn(&mut Self) -> &mut f64; 11] = [
            |helix| &mut helix.length,
            |helix| &mut helix.boundary_angle,
            |helix| &mut helix.radius,
            |helix| &mut helix.windings,
            |helix| &mut helix.core_outer_radius,
            |helix| &mut helix.core_inner_radius,
            |helix| &mut helix.shore_a,
            |helix| &mut helix.poisson,
            |helix| &mut helix.volume_fraction,
            |helix| &mut helix.particle_remanence,
            |helix| helix.density.get_or_insert(0.0),
        ];
        Some(entries[number](self))
    }
}

impl RingMagnet {
    /// The quantities of a ring.
    pub const QUANTITIES: [&'static Quantity; 4] =
        [&of::RING_LENGTH, &of::RING_REMANENCE, &of::RING_RECOIL_PERMEABILITY, &of::RING_DENSITY];

    /// The number that holds a quantity; `None` for a quantity of something else.
    pub fn entry(&mut self, quantity: &'static Quantity) -> Option<&mut f64> {
        let number = Self::QUANTITIES.iter().position(|own| ptr::eq(*own, quantity))?;
        let entries: [fn(&mut Self) -> &mut f64; 4] = [
            |ring| &mut ring.length,
            |ring| &mut ring.remanence,
            |ring| &mut ring.recoil_permeability,
            |ring| &mut ring.density,
        ];
        Some(entries[number](self))
    }
}

impl Segmented {
    /// The list of a quantity, if there is one.
    #[must_use]
    pub fn list_of(&self, quantity: &'static Quantity) -> Option<&[f64]> {
        self.lists.iter().find(|list| list.is_of(quantity)).map(|list| &list.values[..])
    }

    /// The list of a quantity, to be changed.
    pub fn list_mut(&mut self, quantity: &'static Quantity) -> Option<&mut [f64]> {
        self.lists.iter_mut().find(|list| list.is_of(quantity)).map(|list| &mut list.values[..])
    }

    /// The helix of segment number `index`, from 0.
    #[must_use]
    pub fn helix_of(&self, index: usize) -> Helix {
        let mut helix = self.helix;
        for list in self.lists.iter().filter(|list| !list.is_of_rings()) {
            let Some(value) = list.values.get(index) else { continue };
            // 0 stands for the density of the mixture.
            if list.is_of(&of::HELIX_DENSITY) {
                helix.density = Some(*value).filter(|density| *density != 0.0);
            } else if let Some(entry) = helix.entry(list.quantity) {
                *entry = *value;
            }
        }
        helix
    }

    /// The magnet of ring number `index`, from 0.
    #[must_use]
    pub fn ring_of(&self, index: usize) -> RingMagnet {
        let mut ring = self.ring;
        for list in &self.lists {
            if let (Some(entry), Some(value)) = (ring.entry(list.quantity), list.values.get(index)) {
                *entry = *value;
            }
        }
        ring.direction = self.ring_directions.get(index).copied().or(ring.direction);
        ring
    }

    /// The helices of all segments, base to tip.
    pub fn helices(&self) -> impl Iterator<Item = Helix> + '_ {
        (0..self.segments).map(|index| self.helix_of(index))
    }

    /// All rings, base to tip, each with the helix whose radii it has: the one before it, or behind it at the base.
    pub fn ring_magnets(&self) -> impl Iterator<Item = (RingMagnet, Helix)> + '_ {
        let first = usize::from(!self.base_magnet);
        (0..self.ring_count()).map(move |index| {
            let segment = (index + first).saturating_sub(1);
            (self.ring_of(index), self.helix_of(segment))
        })
    }
}

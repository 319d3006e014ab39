//! Tables `[design.helix]` and `[design.ring]`: numbers for all segments or rings, or lists with one for each.

use serde::{Deserialize, Serialize};

use super::names::Unit;
use super::numbers::{self, Numbers};
use crate::design::{Helix, RingMagnet, ValueList};
use crate::error::Quantity;

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, default)]
pub(super) struct HelixEntries {
    /// Length of the helix.
    pub(super) length_mm: Numbers,
    /// Bending of a segment at which adjacent windings touch.
    pub(super) boundary_angle_deg: Numbers,
    /// Outer radius, of the rings too.
    pub(super) radius_mm: Numbers,
    /// Number of windings.
    pub(super) windings: Numbers,
    /// Outer radius of the tube about which the spiral is wound.
    pub(super) core_outer_radius_mm: Numbers,
    /// Radius of that tube's bore, and of the rings'.
    pub(super) core_inner_radius_mm: Numbers,
    /// Shore A hardness of the rubber without particles.
    pub(super) shore_a: Numbers,
    /// Poisson's ratio.
    pub(super) poisson: Numbers,
    /// Volume fraction of magnetic particles; at 1/1.35 the stiffness of the mixture diverges.
    pub(super) volume_fraction: Numbers,
    /// Remanence of the particles.
    pub(super) particle_remanence_t: Numbers,
    /// Density; left out: that of the mixture.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) density_kg_m3: Option<Numbers>,
}

impl Default for HelixEntries {
    /// Table 1 of Richter et al.
    fn default() -> Self {
        Self {
            length_mm: Numbers::Same(4.0),
            boundary_angle_deg: Numbers::Same(40.0),
            radius_mm: Numbers::Same(2.0),
            windings: Numbers::Same(2.0),
            core_outer_radius_mm: Numbers::Same(0.95),
            core_inner_radius_mm: Numbers::Same(0.75),
            shore_a: Numbers::Same(33.0),
            poisson: Numbers::Same(0.4),
            volume_fraction: Numbers::Same(0.25),
            particle_remanence_t: Numbers::Same(1.0),
            density_kg_m3: None,
        }
    }
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, default)]
pub(super) struct RingEntries {
    /// Length along the axis.
    #[serde(deserialize_with = "numbers::of_rings")]
    pub(super) length_mm: Numbers,
    /// Remanence along the axis or the direction; in a list, or with a direction, it may be negative: reversed.
    #[serde(deserialize_with = "numbers::of_rings")]
    pub(super) remanence_t: Numbers,
    /// Direction of the magnetisation in the material frame, a unit vector; left out: along the axis.
    ///
    /// One for all rings, or a list with one for each.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) direction: Option<Directions>,
    /// Relative recoil permeability: 1.05 for sintered `NdFeB`, which its own field weakens.
    #[serde(deserialize_with = "numbers::of_rings")]
    pub(super) recoil_permeability: Numbers,
    /// Density.
    #[serde(deserialize_with = "numbers::of_rings")]
    pub(super) density_kg_m3: Numbers,
}

impl Default for RingEntries {
    /// Table 1 of Richter et al.; the density is that of `NdFeB`, rounded.
    fn default() -> Self {
        Self {
            length_mm: Numbers::Same(1.0),
            remanence_t: Numbers::Same(1.35),
            direction: None,
            recoil_permeability: Numbers::Same(1.0),
            density_kg_m3: Numbers::Same(7000.0),
        }
    }
}

/// One direction for all, or one for each.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(untagged, expecting = "a unit vector, or a list with one for each ring")]
pub(super) enum Directions {
    Same([f64; 3]),
    Each(Vec<[f64; 3]>),
}

impl HelixEntries {
    /// The numbers of the table, in the order of [`Helix::QUANTITIES`].
    fn numbers_mut(&mut self) -> [Option<&mut Numbers>; 11] {
        [
            Some(&mut self.length_mm),
            Some(&mut self.boundary_angle_deg),
            Some(&mut self.radius_mm),
            Some(&mut self.windings),
            Some(&mut self.core_outer_radius_mm),
            Some(&mut self.core_inner_radius_mm),
            Some(&mut self.shore_a),
            Some(&mut self.poisson),
            Some(&mut self.volume_fraction),
            Some(&mut self.particle_remanence_t),
            self.density_kg_m3.as_mut(),
        ]
    }

    /// Makes the number under this key a list with one for each of so many segments.
    pub(super) fn spread(&mut self, key: &str, segments: usize) {
        let own = Helix::QUANTITIES.into_iter().zip(self.numbers_mut());
        let own = own.filter(|(quantity, _)| quantity.key == key).filter_map(|(_, numbers)| numbers);
        own.for_each(|numbers| numbers.spread(segments));
    }

    /// The helix of all segments, and what is not the same for all.
    pub(super) fn si(mut self) -> (Helix, Vec<ValueList>) {
        let mut helix = Helix::paper();
        let mut lists = Vec::new();
        for (quantity, numbers) in Helix::QUANTITIES.into_iter().zip(self.numbers_mut()) {
            let Some(numbers) = numbers else { continue };
            let (first, list) = in_si(quantity, numbers);
            if let Some(entry) = helix.entry(quantity) {
                *entry = first;
            }
            lists.extend(list);
        }
        (helix, lists)
    }
}

impl RingEntries {
    /// The numbers of the table, in the order of [`RingMagnet::QUANTITIES`].
    fn numbers_mut(&mut self) -> [&mut Numbers; 4] {
        [&mut self.length_mm, &mut self.remanence_t, &mut self.recoil_permeability, &mut self.density_kg_m3]
    }

    /// Makes the number under this key a list with one for each of so many rings.
    pub(super) fn spread(&mut self, key: &str, rings: usize) {
        let own = RingMagnet::QUANTITIES.into_iter().zip(self.numbers_mut());
        own.filter(|(quantity, _)| quantity.key == key).for_each(|(_, numbers)| numbers.spread(rings));
    }

    /// The rings, what is not the same for all, and the directions, where they are not the same for all.
    pub(super) fn si(mut self) -> (RingMagnet, Vec<ValueList>, Vec<[f64; 3]>) {
        let mut ring = RingMagnet::paper();
        let mut lists = Vec::new();
        for (quantity, numbers) in RingMagnet::QUANTITIES.into_iter().zip(self.numbers_mut()) {
            let (first, list) = in_si(quantity, numbers);
            if let Some(entry) = ring.entry(quantity) {
                *entry = first;
            }
            lists.extend(list);
        }
        let directions = match self.direction {
            None => Vec::new(),
            Some(Directions::Same(direction)) => {
                ring.direction = Some(direction);
                Vec::new()
            }
            Some(Directions::Each(list)) => list,
        };
        (ring, lists, directions)
    }
}

/// The first number of a quantity in SI units, and the list if it is one.
fn in_si(quantity: &'static Quantity, numbers: &Numbers) -> (f64, Option<ValueList>) {
    let unit = Unit::of(quantity.key);
    let list = numbers
        .list()
        .map(|list| ValueList { quantity, values: list.iter().map(|number| unit.in_si(*number)).collect() });
    (unit.in_si(numbers.first()), list)
}

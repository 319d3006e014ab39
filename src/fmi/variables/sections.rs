//! Parameters of a device made of sections, and of segments or rings with one value for each.

use core::ptr;

use super::super::dependency::Known;
use super::super::host_values::HostValues;
use super::super::units::{
    CURVATURE, DENSITY, HARDNESS, LENGTH, LINE_STIFFNESS, MATERIAL_DIRECTION, MODULUS, Quantity as Measure,
    RATIO, REMANENCE, ROTATIONAL_STIFFNESS, TURN,
};
use super::super::variable::{Access, Index};
use super::rows::{Draft, Rows};
use crate::design::Specification::{self, Segmented};
use crate::design::{self, Helix, RingMagnet, Section, SectionBody, quantities as of};
use crate::error::Quantity;

/// The quantities of sections, with what they are measured in.
const MEASURES: [(&Quantity, Measure); 17] = [
    (&of::SECTION_LENGTH, LENGTH),
    (&of::SECTION_OUTER, LENGTH),
    (&of::SECTION_INNER, LENGTH),
    (&of::SECTION_SHORE_A, HARDNESS),
    (&of::SECTION_ELASTIC_MODULUS, MODULUS),
    (&of::SECTION_POISSON, RATIO),
    (&of::SECTION_BENDING, ROTATIONAL_STIFFNESS),
    (&of::SECTION_TORSION, ROTATIONAL_STIFFNESS),
    (&of::SECTION_AXIAL, LINE_STIFFNESS),
    (&of::SECTION_SHEAR, LINE_STIFFNESS),
    (&of::SECTION_DENSITY, DENSITY),
    (&of::SECTION_REMANENCE, REMANENCE),
    (&of::SECTION_VOLUME_FRACTION, RATIO),
    (&of::SECTION_PARTICLE_REMANENCE, REMANENCE),
    (&of::SECTION_DIRECTION, MATERIAL_DIRECTION),
    (&of::SECTION_TURN, TURN),
    (&of::SECTION_REST, CURVATURE),
];

/// Most numbers of one quantity of a section: the components of a vector.
const COMPONENTS: usize = 3;

/// A number of a section. The index of the row counts its quantity and component together.
const OF_SECTION: Access = Access::Real {
    get: |values, index| {
        let (quantity, component) = numbered(index);
        let section = section(values, index).and_then(|own| own.number(quantity, component));
        section.unwrap_or(f64::NAN)
    },
    set: |values, index, value| {
        let (quantity, component) = numbered(index);
        if let Specification::Sections(device) = &mut values.specification
            && let Some(section) = device.sections.get_mut(index.item)
        {
            section.set(quantity, component, value);
        }
    },
};

/// A value of a list of segments.
const OF_SEGMENTS: Access = Access::Real {
    get: |values, index| listed(values, Helix::QUANTITIES[index.item], index.component),
    set: |values, index, value| set_listed(values, Helix::QUANTITIES[index.item], index.component, value),
};

/// A value of a list of rings.
const OF_RINGS: Access = Access::Real {
    get: |values, index| listed(values, RingMagnet::QUANTITIES[index.item], index.component),
    set: |values, index, value| {
        set_listed(values, RingMagnet::QUANTITIES[index.item], index.component, value);
    },
};

fn section(values: &HostValues, index: Index) -> Option<&Section> {
    match &values.specification {
        Specification::Sections(device) => device.sections.get(index.item),
        _ => None,
    }
}

fn numbered(index: Index) -> (&'static Quantity, usize) {
    (MEASURES[index.component / COMPONENTS].0, index.component % COMPONENTS)
}

fn listed(values: &HostValues, quantity: &'static Quantity, place: usize) -> f64 {
    let Segmented(chain) = &values.specification else { return f64::NAN };
    chain.list_of(quantity).and_then(|list| list.get(place)).copied().unwrap_or(f64::NAN)
}

fn set_listed(values: &mut HostValues, quantity: &'static Quantity, place: usize, value: f64) {
    if let Segmented(chain) = &mut values.specification
        && let Some(entry) = chain.list_mut(quantity).and_then(|list| list.get_mut(place))
    {
        *entry = value;
    }
}

/// What is known of a quantity of a section: whether arc lengths depend on it, and which.
fn known(section: &Section, quantity: &'static Quantity) -> Known {
    let length = match section.body {
        SectionBody::Ball => &of::SECTION_OUTER,
        _ => &of::SECTION_LENGTH,
    };
    match (ptr::eq(quantity, length), section.is_rigid()) {
        (false, _) => Known::Other,
        (true, true) => Known::RingLength,
        (true, false) => Known::BodyLength,
    }
}

impl Rows {
    /// The parameters of all sections.
    pub(super) fn sections(&mut self, device: &design::Sections) {
        for (item, section) in device.sections.iter().enumerate() {
            for (quantity, count) in section.quantities() {
                let Some(number) = MEASURES.iter().position(|(own, _)| ptr::eq(*own, quantity)) else {
                    continue;
                };
                let draft = Draft::holding(quantity, MEASURES[number].1, OF_SECTION).of_item(item);
                let draft = draft.known(known(section, quantity));
                for component in 0..count {
                    let index = if count > 1 { format!("[{}]", component + 1) } else { String::new() };
                    let draft = draft.clone().indexed(&index);
                    self.component_of(item, number * COMPONENTS + component, draft);
                }
            }
        }
    }

    /// A quantity of the helices or rings: one variable, or one for each value of the list that the packed design has. The list is read
    /// and set by the number of its quantity.
    pub(super) fn for_each(&mut self, chain: &design::Segmented, draft: Draft, quantity: &'static Quantity) {
        let Some(list) = chain.list_of(quantity) else { return self.scalar(draft) };
        let of_helix = Helix::QUANTITIES.iter().position(|own| ptr::eq(*own, quantity));
        let of_ring = RingMagnet::QUANTITIES.iter().position(|own| ptr::eq(*own, quantity));
        let (item, access) = match (of_helix, of_ring) {
            (Some(number), _) => (number, OF_SEGMENTS),
            (None, number) => (number.unwrap_or_default(), OF_RINGS),
        };
        // In a list a remanence may be negative: reversed.
        let signed =
            [&of::RING_REMANENCE, &of::HELIX_PARTICLE_REMANENCE].iter().any(|own| ptr::eq(*own, quantity));
        let draft = draft.access(access);
        let draft = if signed { draft.min(-REMANENCE_LIMIT) } else { draft };
        self.array_of(item, list.len(), &draft);
    }
}

/// Largest remanence, T, of either sign.
const REMANENCE_LIMIT: f64 = 20.0;

//! Whether a specification is within the allowed ranges, and what must fit together.

use super::limits::{SIGNED_REMANENCE, SPIRAL_START};
use super::modulus::Modulus;
use super::quantities as of;
use super::section_limits;
use super::specification::{
    Backbone, Cylinder, CylinderMaterial, Guidewire, Helix, RingMagnet, Segmented, SpiralStart,
};
use super::value_list::ValueList;
use crate::error::{Error, Quantity};

pub(super) use section_limits::sections;

/// Relative excess of one radius over another, into which it has to fit, that counts as rounding of a unit conversion.
const FIT: f64 = 1e-9;

/// Checks the dimensions of a helix.
pub(super) fn helix_dimensions(helix: &Helix) -> Result<(), Error> {
    of::HELIX_LENGTH.check(helix.length)?;
    of::HELIX_BOUNDARY_ANGLE.check(helix.boundary_angle)?;
    of::HELIX_RADIUS.check(helix.radius)?;
    of::HELIX_WINDINGS.check(helix.windings)?;
    of::HELIX_CORE_OUTER_RADIUS.check_beside(helix.core_outer_radius, helix.radius)?;
    of::HELIX_CORE_INNER_RADIUS.check_beside(helix.core_inner_radius, helix.core_outer_radius).map(|_| ())
}

/// Checks a helix; its remanence may be negative where it is `signed`.
fn helix(helix: &Helix, signed: bool) -> Result<(), Error> {
    helix_dimensions(helix)?;

    of::HELIX_SHORE_A.check(helix.shore_a)?;
    of::HELIX_POISSON.check(helix.poisson)?;
    of::HELIX_VOLUME_FRACTION.check(helix.volume_fraction)?;
    remanence(&of::HELIX_PARTICLE_REMANENCE, helix.particle_remanence, signed)?;
    of::HELIX_DENSITY.check(helix.density.unwrap_or_default()).map(|_| ())
}

/// Checks a ring magnet; its remanence may be negative where it is `signed`.
fn ring(ring: &RingMagnet, signed: bool) -> Result<(), Error> {
    of::RING_LENGTH.check(ring.length)?;
    remanence(&of::RING_REMANENCE, ring.remanence, signed)?;
    of::RING_RECOIL_PERMEABILITY.check(ring.recoil_permeability)?;
    of::RING_DENSITY.check(ring.density).map(|_| ())
}

/// Checks a remanence, which may be negative where it is `signed`.
fn remanence(quantity: &'static Quantity, value: f64, signed: bool) -> Result<(), Error> {
    let interval = if signed { &SIGNED_REMANENCE } else { &quantity.interval };
    interval.check(quantity.name, value).map(|_| ()).map_err(|error| error.of(quantity))
}

/// Checks a backbone that runs through bores of radius `bore` (m).
pub(super) fn backbone(backbone: &Backbone, bore: f64) -> Result<(), Error> {
    let widest = bore * (1.0 + FIT);
    of::BACKBONE_OUTER.check_beside(backbone.outer_radius, widest)?;
    let [inner, shore_a, elastic_modulus] =
        [&of::BACKBONE_INNER, &of::BACKBONE_SHORE_A, &of::BACKBONE_ELASTIC_MODULUS];
    tube(backbone, [inner, shore_a, elastic_modulus, &of::BACKBONE_POISSON, &of::BACKBONE_DENSITY])
}

/// Checks the tube behind the base.
pub(super) fn shaft(shaft: &Backbone) -> Result<(), Error> {
    of::SHAFT_OUTER.check(shaft.outer_radius)?;
    let [inner, shore_a, elastic_modulus] =
        [&of::SHAFT_INNER, &of::SHAFT_SHORE_A, &of::SHAFT_ELASTIC_MODULUS];
    tube(shaft, [inner, shore_a, elastic_modulus, &of::SHAFT_POISSON, &of::SHAFT_DENSITY])
}

/// Checks bore and material of a tube, whose quantities are given in the order in which they are checked; of hardness and modulus one is.
fn tube(tube: &Backbone, of: [&'static Quantity; 5]) -> Result<(), Error> {
    let [inner_radius, shore_a, elastic_modulus, poisson, density] = of;
    inner_radius.check_beside(tube.inner_radius, tube.outer_radius)?;
    match tube.modulus {
        Modulus::ShoreA(hardness) => shore_a.check(hardness)?,
        Modulus::Elastic(modulus) => elastic_modulus.check(modulus)?,
    };
    poisson.check(tube.poisson)?;
    density.check(tube.density).map(|_| ())
}

/// Checks a guidewire that runs through `lumens`, each with its name and radius (m).
pub(super) fn guidewire(wire: &Guidewire, lumens: &[(&str, f64)]) -> Result<(), Error> {
    for (body, radius) in lumens {
        if *radius == 0.0 {
            let reason = format!("guidewire: the {body} has no lumen for it, its inner radius is 0");
            return Err(Error::Unsupported(reason));
        }
        of::WIRE_RADIUS.check_beside(wire.radius, *radius).map_err(|_| {
            let allowed = format!("> 0 and < {radius} (inner radius of the {body})");
            Error::range(of::WIRE_RADIUS.name, wire.radius, allowed).of(&of::WIRE_RADIUS)
        })?;
    }
    of::WIRE_ELASTIC_MODULUS.check(wire.elastic_modulus).map(|_| ())
}

/// Checks a chain of segments.
pub(super) fn segmented(chain: &Segmented) -> Result<(), Error> {
    of::NUMBER_OF_SEGMENTS.check(chain.segments as f64)?;
    lists(chain)?;
    // Where a list states a quantity, the error names the entry.
    let of_entry = |number: usize| {
        move |error: Error| {
            let listed = error.identity().is_some_and(|own| chain.list_of(own.quantity).is_some());
            if listed { error.of_item(number) } else { error }
        }
    };

    let signed = chain.list_of(&of::HELIX_PARTICLE_REMANENCE).is_some();
    for (number, own) in (1..).zip(chain.helices()) {
        helix(&own, signed).map_err(of_entry(number))?;
        chain.backbone.map_or(Ok(()), |tube| backbone(&tube, own.core_inner_radius))?;
    }
    let listed = chain.list_of(&of::RING_REMANENCE).is_some();
    ring(&chain.ring, listed || chain.ring.direction.is_some())?;
    for (number, (own, _)) in (1..).zip(chain.ring_magnets()) {
        ring(&own, listed || own.direction.is_some()).map_err(of_entry(number))?;
    }
    spiral_start(&chain.spiral_start, chain.segments)
}

/// Checks that each list has as many values as there are segments, or rings.
fn lists(chain: &Segmented) -> Result<(), Error> {
    let (segments, rings) = (chain.segments, chain.ring_count());
    let counted = |key: &str, given: usize, for_rings: bool| {
        let (count, of) = if for_rings { (rings, "ring") } else { (segments, "segment") };
        if given == count {
            return Ok(());
        }
        Err(Error::Count { quantity: key.into(), given, expected: format!("{count}, one for each {of}") })
    };
    let of_list = |list: &ValueList| counted(list.quantity.key, list.values.len(), list.is_of_rings());
    chain.lists.iter().try_for_each(of_list)?;
    match chain.ring_directions.len() {
        0 => Ok(()),
        given => counted("design.ring.direction", given, true),
    }
}

/// Checks the angles by which the spirals of so many segments are turned.
fn spiral_start(start: &SpiralStart, segments: usize) -> Result<(), Error> {
    let angle = |name: &str, value: f64| {
        let refused = |_| Error::range(name, value, SPIRAL_START.to_string()).of(&of::SPIRAL_START_ANGLE);
        SPIRAL_START.check(name, value / (1.0 + FIT)).map(|_| ()).map_err(refused)
    };
    match start {
        SpiralStart::Same(value) => angle(of::SPIRAL_START_ANGLE.name, *value),
        SpiralStart::Each(values) if values.len() != segments => Err(Error::Count {
            quantity: "start angles of the spirals".into(),
            given: values.len(),
            expected: format!("{segments}, one for each segment"),
        }),
        SpiralStart::Each(values) => (1..).zip(values).try_for_each(|(index, value)| {
            let name = format!("start angle of the spiral of segment {index} (rad)");
            angle(&name, *value).map_err(|error| error.of_item(index))
        }),
    }
}

/// Checks a plain magnetised rod.
pub(super) fn cylinder(rod: &Cylinder) -> Result<(), Error> {
    of::ROD_LENGTH.check(rod.length)?;
    of::ROD_RADIUS.check(rod.radius)?;
    of::ROD_INNER.check_beside(rod.inner_radius, rod.radius)?;
    match rod.material {
        CylinderMaterial::Composite { shore_a, poisson, volume_fraction, particle_remanence } => {
            of::ROD_SHORE_A.check(shore_a)?;
            of::ROD_POISSON.check(poisson)?;
            of::ROD_VOLUME_FRACTION.check(volume_fraction)?;
            of::ROD_PARTICLE_REMANENCE.check(particle_remanence)?;
        }
        CylinderMaterial::Bulk { elastic_modulus, poisson, remanence } => {
            of::ROD_ELASTIC_MODULUS.check(elastic_modulus)?;
            of::ROD_POISSON.check(poisson)?;
            of::ROD_REMANENCE.check(remanence)?;
        }
    }
    of::ROD_DENSITY.check(rod.density.unwrap_or_default()).map(|_| ())
}

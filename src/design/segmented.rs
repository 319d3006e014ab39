//! The bodies of a chain of rings and helices.

use core::f64::consts::PI;

use super::area::annulus_area;
use super::checks;
use super::demagnetisation::polarisation;
use super::direction::Direction;
use super::material::{Moduli, composite_density};
use super::quantities::RING_DIRECTION;
use super::section::{RigidShape, Ring, SectorKind, Span, SpanKind, Spiral, Stiffness};
use super::segment::Segment;
use super::specification::{Helix, RingMagnet, Segmented, SpiralKind};
use super::tube::Tube;
use crate::constants::VACUUM_PERMEABILITY;
use crate::error::Error;

/// The rings at the base and the segments of a chain of rings and helices.
pub(super) fn bodies(chain: &Segmented) -> Result<(Vec<Ring>, Vec<Segment>), Error> {
    checks::segmented(chain)?;
    let tube = chain.backbone.as_ref().map(Tube::of).unwrap_or_default();
    let listed = !chain.ring_directions.is_empty();
    let rings = (1..).zip(chain.ring_magnets()).map(|(number, (magnet, helix))| {
        ring(&magnet, &helix, &tube).map_err(|error| if listed { error.of_item(number) } else { error })
    });
    let mut rings = rings.collect::<Result<Vec<_>, Error>>()?.into_iter();

    let base = rings.by_ref().take(usize::from(chain.base_magnet)).collect();
    let segments = chain.helices().enumerate().map(|(index, helix)| {
        let spans = spans(chain, index, &helix, &tube)?;
        Ok(Segment { spans, rings: rings.next().into_iter().collect() })
    });
    Ok((base, segments.collect::<Result<_, Error>>()?))
}

/// A ring with the radii of a helix.
fn ring(magnet: &RingMagnet, helix: &Helix, tube: &Tube) -> Result<Ring, Error> {
    let direction = magnet.direction.map_or(Ok(Direction::Axial), Direction::new);
    let direction = direction.map_err(|error| error.of(&RING_DIRECTION))?;
    let (remanence, direction) = polarisation(magnet, helix, direction);
    let mass = (magnet.density * annulus_area(helix.core_inner_radius, helix.radius) + tube.line_density)
        * magnet.length;
    Ok(Ring {
        shape: RigidShape::Tube,
        inner_radius: helix.core_inner_radius,
        outer_radius: helix.radius,
        length: magnet.length,
        remanence,
        direction,
        mass,
    })
}

/// The disc, the core and the other disc of segment number `index`, from 0.
fn spans(chain: &Segmented, index: usize, helix: &Helix, tube: &Tube) -> Result<Vec<Span>, Error> {
    let geometry = helix.geometry()?;
    let moduli = Moduli::composite(helix.shore_a, helix.poisson, helix.volume_fraction);
    let body = |kind, length, outer_radius, spiral| Span {
        kind,
        length,
        inner_radius: helix.core_inner_radius,
        outer_radius,
        stiffness: Stiffness::annulus(helix.core_inner_radius, outer_radius, moduli) + tube.stiffness,
        magnetisation: helix.volume_fraction * helix.particle_remanence / VACUUM_PERMEABILITY,
        density: helix.density.unwrap_or_else(|| composite_density(helix.volume_fraction)),
        line_density: tube.line_density,
        spiral,
        ..Span::plain()
    };

    let disc = body(SpanKind::Disc, geometry.height, helix.radius, None);
    let (kind, start) = sector(chain, index);
    let spiral = Spiral {
        inner_radius: helix.core_outer_radius,
        outer_radius: helix.radius,
        sector_angle: geometry.sector_angle,
        windings: helix.windings,
        kind,
        start,
        boundary_angle: helix.boundary_angle,
        closed_bending: disc.stiffness.bending,
    };

    let core = body(SpanKind::Core, geometry.core_length, helix.core_outer_radius, Some(spiral));
    Ok(vec![disc.clone(), core, disc])
}

/// How the sector of the spiral of segment number `index` (from 0) lies, and where it begins (rad).
fn sector(chain: &Segmented, index: usize) -> (SectorKind, f64) {
    let start = chain.spiral_start.of(index);
    match chain.spiral {
        // The same for all segments, so that they remain alike.
        SpiralKind::Axisymmetric => (SectorKind::Axisymmetric, 0.0),
        // Opposite to the end of the previous spiral, whole turns left out.
        SpiralKind::Alternating if index % 2 == 1 => {
            let windings = chain.helix_of(index - 1).windings;
            (SectorKind::LeftHanded, start + PI * (1.0 + 2.0 * windings.fract()))
        }
        SpiralKind::Helical | SpiralKind::Alternating => (SectorKind::RightHanded, start),
    }
}

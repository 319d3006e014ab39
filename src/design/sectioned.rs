//! The bodies of a device made of sections.

use nalgebra::Vector3;

use super::checks;
use super::direction::Direction;
use super::material::Moduli;
use super::modulus::Modulus;
use super::section::{RigidShape, Ring, Span, SpanKind, Stiffness, Taper};
use super::sections::{Section, SectionBody, Sections};
use super::segment::Segment;
use crate::constants::VACUUM_PERMEABILITY;
use crate::error::Error;

/// The rigid bodies at the base, and the segments: elastic sections in a row and the rigid ones behind them.
pub(super) fn bodies(device: &Sections) -> Result<(Vec<Ring>, Vec<Segment>), Error> {
    checks::sections(device)?;
    let (mut base, mut segments) = (Vec::new(), Vec::<Segment>::new());
    for (number, section) in (1..).zip(&device.sections) {
        let direction = Direction::new(section.direction).map_err(|error| error.of_item(number))?;
        if section.is_rigid() {
            let ring = ring(section, direction);
            match segments.last_mut() {
                Some(segment) => segment.rings.push(ring),
                None => base.push(ring),
            }
            continue;
        }
        let span = span(section, direction);
        match segments.last_mut().filter(|segment| segment.rings.is_empty()) {
            Some(segment) => segment.spans.push(span),
            None => segments.push(Segment { spans: vec![span], rings: Vec::new() }),
        }
    }
    Ok((base, segments))
}

/// A rigid section.
fn ring(section: &Section, direction: Direction) -> Ring {
    let (sign, direction) = direction.signed();
    let (shape, inner_radius) = match section.body {
        SectionBody::Ball => (RigidShape::Ball, 0.0),
        _ => (RigidShape::Tube, section.inner_radius[0]),
    };
    let ring = Ring {
        shape,
        inner_radius,
        outer_radius: section.outer_radius[0],
        length: section.length,
        remanence: sign * section.magnet.remanence(),
        direction,
        mass: 0.0,
    };
    Ring { mass: section.density() * ring.volume(), ..ring }
}

/// An elastic section.
fn span(section: &Section, direction: Direction) -> Span {
    let (sign, direction) = direction.signed();
    let fraction = section.magnet.volume_fraction();
    let ([inner_radius, inner_end], [outer_radius, outer_end]) = (section.inner_radius, section.outer_radius);
    let (stiffness, moduli) = match section.body {
        SectionBody::Elastic { modulus, poisson } => {
            let moduli = match modulus {
                Modulus::ShoreA(shore_a) => Moduli::composite(shore_a, poisson, fraction),
                Modulus::Elastic(modulus) => Moduli::bulk(modulus, poisson),
            };
            (Stiffness::annulus(inner_radius, outer_radius, moduli), Some(moduli))
        }
        SectionBody::Measured(measured) => (measured.stiffness(outer_radius), None),
        // Rigid ones are no spans.
        SectionBody::Rigid | SectionBody::Ball => (Span::plain().stiffness, None),
    };
    let taper = moduli.filter(|_| section.is_tapered());
    Span {
        kind: SpanKind::Section,
        length: section.length,
        inner_radius,
        outer_radius,
        taper: taper.map(|moduli| Taper { inner_radius: inner_end, outer_radius: outer_end, moduli }),
        stiffness,
        magnetisation: sign * section.magnet.remanence() / VACUUM_PERMEABILITY,
        direction,
        turn: section.turn,
        rest_curvature: Vector3::from(section.rest_curvature),
        density: section.density(),
        ..Span::plain()
    }
}

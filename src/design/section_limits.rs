//! The allowed range of every quantity of a section, and what must fit together.

use core::f64::consts::TAU;

use nalgebra::Vector3;

use super::direction::Direction;
use super::limits::MOST_SECTIONS;
use super::modulus::Modulus;
use super::quantities as of;
use super::sections::{MeasuredStiffness, Section, SectionBody, SectionMagnet, Sections};
use crate::error::{Error, Quantity};

/// Largest angle by which a section is bent and twisted without loads, or the direction of its magnetisation turns, rad: sixteen
/// turns. A longer helix is made of several sections.
const MOST_TURNED: f64 = 16.0 * TAU;

/// Relative deviation of a ball's length from its diameter that counts as rounding of a unit conversion.
const ROUNDED: f64 = 1e-9;

/// Checks a device made of sections.
pub(super) fn sections(device: &Sections) -> Result<(), Error> {
    let count = device.sections.len();
    if !(1..=MOST_SECTIONS).contains(&count) {
        let allowed = format!("from 1 to {MOST_SECTIONS}, with what is repeated");
        return Err(Error::range("design.section: number of sections", count as f64, allowed));
    }
    for (number, own) in (1..).zip(&device.sections) {
        section(own).map_err(|error| error.of_item(number))?;
    }
    if device.sections.iter().all(Section::is_rigid) {
        return Err(Error::Unsupported(
            "design.section: all sections are rigid; a device needs at least one that is elastic".into(),
        ));
    }
    Ok(())
}

/// Checks one section.
fn section(section: &Section) -> Result<(), Error> {
    of::SECTION_LENGTH.check(section.length)?;
    for (outer, inner) in section.outer_radius.into_iter().zip(section.inner_radius) {
        of::SECTION_OUTER.check(outer)?;
        if section.body != SectionBody::Ball {
            of::SECTION_INNER.check_beside(inner, outer)?;
        }
    }
    body(section)?;
    magnet(section)?;
    of::SECTION_DENSITY.check(section.density.unwrap_or_default())?;
    at_rest(section)
}

/// Checks how a section deforms.
fn body(section: &Section) -> Result<(), Error> {
    match section.body {
        SectionBody::Elastic { modulus, poisson } => {
            match modulus {
                Modulus::ShoreA(hardness) => of::SECTION_SHORE_A.check(hardness)?,
                Modulus::Elastic(modulus) => of::SECTION_ELASTIC_MODULUS.check(modulus)?,
            };
            of::SECTION_POISSON.check(poisson).map(|_| ())
        }
        SectionBody::Measured(MeasuredStiffness { bending, torsion, axial, shear }) => {
            of::SECTION_BENDING.check(bending)?;
            of::SECTION_TORSION.check(torsion)?;
            of::SECTION_AXIAL.check(axial)?;
            shear.map_or(Ok(0.0), |shear| of::SECTION_SHEAR.check(shear))?;
            constant(section, "a section with measured stiffness has no taper")
        }
        SectionBody::Rigid => constant(section, "a rigid section has no taper"),
        SectionBody::Ball => {
            constant(section, "a ball has no taper")?;
            let diameter = 2.0 * section.outer_radius[0];
            let fits = (section.length - diameter).abs() <= ROUNDED * diameter;
            let allowed = || format!("{diameter}, twice the outer radius: it is a ball");
            refuse_unless(fits, &of::SECTION_LENGTH, section.length, allowed)
        }
    }
}

/// Checks that the radii do not change along a section.
fn constant(section: &Section, why: &str) -> Result<(), Error> {
    for (quantity, [start, end]) in
        [(&of::SECTION_OUTER, section.outer_radius), (&of::SECTION_INNER, section.inner_radius)]
    {
        let same = start.to_bits() == end.to_bits();
        refuse_unless(same, quantity, end, || format!("{start} as at the start: {why}"))?;
    }
    Ok(())
}

/// Checks remanence and direction of a section.
fn magnet(section: &Section) -> Result<(), Error> {
    match section.magnet {
        SectionMagnet::Bulk(remanence) => of::SECTION_REMANENCE.check(remanence)?,
        SectionMagnet::Composite { volume_fraction, particle_remanence } => {
            of::SECTION_VOLUME_FRACTION.check(volume_fraction)?;
            of::SECTION_PARTICLE_REMANENCE.check(particle_remanence)?
        }
    };
    Direction::new(section.direction)?;

    let turn = of::SECTION_TURN.check(section.turn)?;
    let most = MOST_TURNED / section.length;
    let allowed = || format!("at most {most} of either sign: sixteen turns in the section");
    refuse_unless(turn.abs() <= most, &of::SECTION_TURN, turn, allowed)?;
    let still = !section.is_rigid() || turn == 0.0;
    refuse_unless(still, &of::SECTION_TURN, turn, || "0: a rigid section is magnetised uniformly".into())
}

/// Checks the shape of a section without loads.
fn at_rest(section: &Section) -> Result<(), Error> {
    for value in section.rest_curvature {
        of::SECTION_REST.check(value)?;
    }
    let rest = Vector3::from(section.rest_curvature);
    let (bend, whole) = (rest.xy().norm(), rest.norm());
    let refuse =
        |fits: bool, value: f64, allowed: String| refuse_unless(fits, &of::SECTION_REST, value, || allowed);
    refuse(!section.is_rigid() || whole == 0.0, whole, "0: a rigid section is straight".into())?;

    let most = MOST_TURNED / section.length;
    refuse(whole <= most, whole, format!("at most {most} as a whole: sixteen turns in the section"))?;

    // On the inner side of a bend the material is compressed to nothing.
    let radius = section.outer_radius.into_iter().fold(0.0, f64::max);
    let tightest = 1.0 / radius;
    refuse(
        bend < tightest,
        bend,
        format!("< {tightest:.6} in bending: the inner side of the tube would close on itself"),
    )?;

    // A helix of curvature k and torsion t has the radius k / (k^2 + t^2) and rises by 2 pi t / (k^2 + t^2) in a turn.
    let round = bend / (whole * whole) > radius && whole * section.length >= TAU;
    let rises = TAU * rest.z.abs() / (whole * whole) >= 2.0 * radius;
    let closed = TAU / section.length;
    refuse(
        !round || rises,
        whole,
        format!(
            "< {closed:.6} as a whole, less than a full turn, or with so much twist that the turns pass one another: \
             the tube would close on itself"
        ),
    )
}

/// Refuses a value of a quantity unless it fits.
fn refuse_unless(
    fits: bool,
    quantity: &'static Quantity,
    value: f64,
    allowed: impl FnOnce() -> String,
) -> Result<(), Error> {
    if fits { Ok(()) } else { Err(Error::range(quantity.name, value, allowed()).of(quantity)) }
}

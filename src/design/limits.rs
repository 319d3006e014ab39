//! The allowed range of every quantity of a specification.

use core::f64::consts::{PI, TAU};

use super::material::DENSEST_PACKING;
use super::specification::{
    Backbone, Cylinder, CylinderMaterial, Guidewire, Helix, Modulus, RingMagnet, Segmented, SpiralStart,
};
use crate::error::{Error, check};

/// Largest number of segments of a manipulator.
pub const MOST_SEGMENTS: usize = 64;

/// Largest recoil permeability of the rings.
///
/// Ferrites and rare-earth magnets have 1.03 to 1.3. Alnico has 2 to 7, but a flat ring's own field exceeds the knee of
/// its demagnetisation curve, which is not linear there. At 2 the moment of a uniform magnetisation is accurate to a
/// percent.
pub const MOST_PERMEABLE: f64 = 2.0;

/// Relative excess of one radius over another, into which it has to fit, that counts as rounding of a unit conversion.
const FIT: f64 = 1e-9;

/// Checks the given quantities of a helix.
pub(super) fn helix(helix: &Helix) -> Result<(), Error> {
    length("helix length L (m)", helix.length)?;
    check("boundary angle Theta (rad)", helix.boundary_angle, |v| v > 0.0 && v <= PI, "> 0 and <= pi")?;
    length("helix radius R (m)", helix.radius)?;
    check("windings W", helix.windings, |v| (1.0..=100.0).contains(&v), "from 1 to 100")?;
    check(
        "core outer radius r_oc (m)",
        helix.core_outer_radius,
        |v| v > 0.0 && v < helix.radius,
        "> 0 and < the helix radius",
    )?;
    check(
        "core inner radius r_ic (m)",
        helix.core_inner_radius,
        |v| v >= 0.0 && v < helix.core_outer_radius,
        ">= 0 and < the core outer radius",
    )?;
    composite(helix.shore_a, helix.poisson, helix.volume_fraction, helix.particle_remanence)?;
    helix.density.map_or(Ok(()), density)
}

/// Checks the given quantities of the ring magnets.
pub(super) fn ring(ring: &RingMagnet) -> Result<(), Error> {
    length("ring length L_mag (m)", ring.length)?;
    remanence("ring remanence B_r (T)", ring.remanence)?;
    check(
        "ring recoil permeability mu_r",
        ring.recoil_permeability,
        |v| (1.0..=MOST_PERMEABLE).contains(&v),
        "from 1 to 2",
    )?;
    density(ring.density)
}

/// Checks a backbone that runs through bores of radius `bore` (m).
pub(super) fn backbone(backbone: &Backbone, bore: f64) -> Result<(), Error> {
    check(
        "backbone outer radius (m)",
        backbone.outer_radius,
        |v| v > 0.0 && v <= bore * (1.0 + FIT),
        "> 0 and <= the core inner radius",
    )?;
    tube("backbone", backbone)
}

/// Checks the tube behind the base.
pub(super) fn shaft(shaft: &Backbone) -> Result<(), Error> {
    length("shaft outer radius (m)", shaft.outer_radius)?;
    tube("shaft", shaft)
}

/// Checks a guidewire that runs through `lumens`, each with its name and radius (m).
pub(super) fn guidewire(wire: &Guidewire, lumens: &[(&str, f64)]) -> Result<(), Error> {
    for (body, radius) in lumens {
        if *radius == 0.0 {
            let reason = format!("guidewire: the {body} has no lumen for it, its inner radius is 0");
            return Err(Error::Unsupported(reason));
        }
        check(
            "guidewire radius (m)",
            wire.radius,
            |v| v > 0.0 && v < *radius,
            &format!("> 0 and < {radius} (inner radius of the {body})"),
        )?;
    }
    elastic(wire.elastic_modulus)
}

/// Checks bore and material of a tube.
fn tube(name: &str, backbone: &Backbone) -> Result<(), Error> {
    check(
        &format!("{name} inner radius (m)"),
        backbone.inner_radius,
        |v| v >= 0.0 && v < backbone.outer_radius,
        ">= 0 and < its outer radius",
    )?;
    match backbone.modulus {
        Modulus::ShoreA(hardness) => shore_a(hardness)?,
        Modulus::Elastic(modulus) => elastic(modulus)?,
    }
    poisson(backbone.poisson)?;
    density(backbone.density)
}

/// Checks a chain of segments.
pub(super) fn segmented(chain: &Segmented) -> Result<(), Error> {
    check(
        "number of segments",
        chain.segments as f64,
        |v| v >= 1.0 && v <= MOST_SEGMENTS as f64,
        "from 1 to 64",
    )?;
    helix(&chain.helix)?;
    ring(&chain.ring)?;
    spiral_start(&chain.spiral_start, chain.segments)?;
    chain.backbone.map_or(Ok(()), |tube| backbone(&tube, chain.helix.core_inner_radius))
}

/// Checks the angles by which the spirals of so many segments are turned.
fn spiral_start(start: &SpiralStart, segments: usize) -> Result<(), Error> {
    let angle = |quantity: &str, value: f64| {
        let turn = TAU * (1.0 + FIT);
        check(quantity, value, |v| v.abs() <= turn, "from -2 pi to 2 pi").map(|_| ())
    };
    match start {
        SpiralStart::Same(value) => angle("start angle of the spirals (rad)", *value),
        SpiralStart::Each(values) if values.len() != segments => Err(Error::Count {
            quantity: "start angles of the spirals".into(),
            given: values.len(),
            expected: format!("{segments}, one for each segment"),
        }),
        SpiralStart::Each(values) => (1..).zip(values).try_for_each(|(index, value)| {
            angle(&format!("start angle of the spiral of segment {index} (rad)"), *value)
        }),
    }
}

/// Checks a plain magnetised rod.
pub(super) fn cylinder(rod: &Cylinder) -> Result<(), Error> {
    length("cylinder length (m)", rod.length)?;
    length("cylinder radius (m)", rod.radius)?;
    check(
        "cylinder inner radius (m)",
        rod.inner_radius,
        |v| v >= 0.0 && v < rod.radius,
        ">= 0 and < its radius",
    )?;
    match rod.material {
        CylinderMaterial::Composite { shore_a, poisson, volume_fraction, particle_remanence } => {
            composite(shore_a, poisson, volume_fraction, particle_remanence)?;
        }
        CylinderMaterial::Bulk { elastic_modulus, poisson: ratio, remanence: axial } => {
            elastic(elastic_modulus)?;
            poisson(ratio)?;
            remanence("cylinder remanence (T)", axial)?;
        }
    }
    rod.density.map_or(Ok(()), density)
}

fn composite(hardness: f64, ratio: f64, volume_fraction: f64, particle_remanence: f64) -> Result<(), Error> {
    shore_a(hardness)?;
    poisson(ratio)?;
    check(
        "volume fraction Phi",
        volume_fraction,
        |v| (0.0..DENSEST_PACKING).contains(&v),
        ">= 0 and < 1/1.35, where Eq. (15) diverges",
    )?;
    remanence("particle remanence B_r (T)", particle_remanence)
}

/// Checks a length or radius; the upper limit detects millimetres given as metres.
fn length(quantity: &str, value: f64) -> Result<(), Error> {
    check(quantity, value, |v| v > 0.0 && v <= 1.0, "> 0 and <= 1").map(|_| ())
}

fn remanence(quantity: &str, value: f64) -> Result<(), Error> {
    check(quantity, value, |v| (0.0..=2.0).contains(&v), "from 0 to 2").map(|_| ())
}

fn shore_a(value: f64) -> Result<(), Error> {
    check("Shore A hardness", value, |v| v > 0.0 && v < 100.0, "> 0 and < 100").map(|_| ())
}

fn poisson(value: f64) -> Result<(), Error> {
    check("Poisson's ratio", value, |v| (0.0..0.5).contains(&v), ">= 0 and < 0.5").map(|_| ())
}

fn elastic(value: f64) -> Result<(), Error> {
    check("Young's modulus (Pa)", value, |v| v > 0.0 && v <= 1e12, "> 0 and <= 1e12").map(|_| ())
}

fn density(value: f64) -> Result<(), Error> {
    check("density (kg/m3)", value, |v| (0.0..=25_000.0).contains(&v), "from 0 to 25000").map(|_| ())
}

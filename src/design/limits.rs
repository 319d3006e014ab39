//! The allowed range of every quantity of a specification.

use core::f64::consts::{PI, TAU};

use super::material::DENSEST_PACKING;
use super::specification::{
    Backbone, Cylinder, CylinderMaterial, Guidewire, Helix, Modulus, RingMagnet, Segmented, SpiralStart,
};
use crate::error::{Error, Interval};

/// Largest number of segments of a manipulator.
pub const MOST_SEGMENTS: usize = 64;

/// Largest recoil permeability of the rings.
///
/// Ferrites and rare-earth magnets have 1.03 to 1.3. Alnico has 2 to 7, but a flat ring's own field exceeds the knee of
/// its demagnetisation curve, which is not linear there. At 2 the moment of a uniform magnetisation is accurate to a
/// percent.
pub const MOST_PERMEABLE: f64 = 2.0;

/// Number of segments.
pub const SEGMENTS: Interval = Interval::at_least(1.0).at_most(MOST_SEGMENTS as f64);

/// Lengths and radii of the device, m; the upper limit detects millimetres given as metres.
pub const LENGTH: Interval = Interval::above(0.0).at_most(1.0);

/// Boundary angle of a helix, rad.
pub const BOUNDARY_ANGLE: Interval = Interval::above(0.0).at_most(PI);

/// Windings of a helix.
pub const WINDINGS: Interval = Interval::at_least(1.0).at_most(100.0);

/// Outer radius of a helix's core, m.
pub const CORE_OUTER_RADIUS: Interval = Interval::above(0.0).less_than("the helix radius");

/// Inner radius of a helix's core, m.
pub const CORE_INNER_RADIUS: Interval = Interval::at_least(0.0).less_than("the core outer radius");

/// Shore A hardness; Gent's relation diverges at both ends.
pub const SHORE_A: Interval = Interval::above(0.0).below(100.0);

/// Poisson's ratio.
pub const POISSON: Interval = Interval::at_least(0.0).below(0.5);

/// Volume fraction of magnetic particles; Eq. (15) diverges at its upper end.
pub const VOLUME_FRACTION: Interval = Interval::at_least(0.0).below(DENSEST_PACKING);

/// Remanence of rings, particles and rods, T. No magnet has more than 2 T, but scenes raise the remanence of a magnet that stands for a
/// stronger one; what is above 20 T is given in another unit.
pub const REMANENCE: Interval = Interval::at_least(0.0).at_most(20.0);

/// Recoil permeability of the rings.
pub const RECOIL_PERMEABILITY: Interval = Interval::at_least(1.0).at_most(MOST_PERMEABLE);

/// Densities, kg/m3.
pub const DENSITY: Interval = Interval::at_least(0.0).at_most(25_000.0);

/// Young's modulus, Pa.
pub const ELASTIC_MODULUS: Interval = Interval::above(0.0).at_most(1e12);

/// Outer radius of a backbone, m.
pub const BACKBONE_OUTER_RADIUS: Interval = Interval::above(0.0).not_above("the core inner radius");

/// Inner radius of a backbone or a shaft, m.
pub const TUBE_INNER_RADIUS: Interval = Interval::at_least(0.0).less_than("its outer radius");

/// Inner radius of a rod, m.
pub const ROD_INNER_RADIUS: Interval = Interval::at_least(0.0).less_than("its radius");

/// Radius of a guidewire, m.
pub const GUIDEWIRE_RADIUS: Interval =
    Interval::above(0.0).less_than("the inner radii of the bodies that it is in");

/// Angle by which a spiral is turned about the axis, rad.
pub const SPIRAL_START: Interval = Interval::within(TAU);

/// Relative excess of one radius over another, into which it has to fit, that counts as rounding of a unit conversion.
const FIT: f64 = 1e-9;

/// Checks the given quantities of a helix.
pub(super) fn helix(helix: &Helix) -> Result<(), Error> {
    LENGTH.check("helix length L (m)", helix.length)?;
    BOUNDARY_ANGLE.check("boundary angle Theta (rad)", helix.boundary_angle)?;
    LENGTH.check("helix radius R (m)", helix.radius)?;
    WINDINGS.check("windings W", helix.windings)?;
    CORE_OUTER_RADIUS.check_beside("core outer radius r_oc (m)", helix.core_outer_radius, helix.radius)?;
    CORE_INNER_RADIUS.check_beside(
        "core inner radius r_ic (m)",
        helix.core_inner_radius,
        helix.core_outer_radius,
    )?;
    composite(helix.shore_a, helix.poisson, helix.volume_fraction, helix.particle_remanence)?;
    helix.density.map_or(Ok(()), density)
}

/// Checks the given quantities of the ring magnets.
pub(super) fn ring(ring: &RingMagnet) -> Result<(), Error> {
    LENGTH.check("ring length L_mag (m)", ring.length)?;
    REMANENCE.check("ring remanence B_r (T)", ring.remanence)?;
    RECOIL_PERMEABILITY.check("ring recoil permeability mu_r", ring.recoil_permeability)?;
    density(ring.density)
}

/// Checks a backbone that runs through bores of radius `bore` (m).
pub(super) fn backbone(backbone: &Backbone, bore: f64) -> Result<(), Error> {
    let widest = bore * (1.0 + FIT);
    BACKBONE_OUTER_RADIUS.check_beside("backbone outer radius (m)", backbone.outer_radius, widest)?;
    tube("backbone", backbone)
}

/// Checks the tube behind the base.
pub(super) fn shaft(shaft: &Backbone) -> Result<(), Error> {
    LENGTH.check("shaft outer radius (m)", shaft.outer_radius)?;
    tube("shaft", shaft)
}

/// Checks a guidewire that runs through `lumens`, each with its name and radius (m).
pub(super) fn guidewire(wire: &Guidewire, lumens: &[(&str, f64)]) -> Result<(), Error> {
    for (body, radius) in lumens {
        if *radius == 0.0 {
            let reason = format!("guidewire: the {body} has no lumen for it, its inner radius is 0");
            return Err(Error::Unsupported(reason));
        }
        let quantity = "guidewire radius (m)";
        GUIDEWIRE_RADIUS.check_beside(quantity, wire.radius, *radius).map_err(|_| {
            let allowed = format!("> 0 and < {radius} (inner radius of the {body})");
            Error::range(quantity, wire.radius, allowed)
        })?;
    }
    elastic(wire.elastic_modulus)
}

/// Checks bore and material of a tube.
fn tube(name: &str, backbone: &Backbone) -> Result<(), Error> {
    let quantity = format!("{name} inner radius (m)");
    TUBE_INNER_RADIUS.check_beside(&quantity, backbone.inner_radius, backbone.outer_radius)?;
    match backbone.modulus {
        Modulus::ShoreA(hardness) => shore_a(hardness)?,
        Modulus::Elastic(modulus) => elastic(modulus)?,
    }
    poisson(backbone.poisson)?;
    density(backbone.density)
}

/// Checks a chain of segments.
pub(super) fn segmented(chain: &Segmented) -> Result<(), Error> {
    SEGMENTS.check("number of segments", chain.segments as f64)?;
    helix(&chain.helix)?;
    ring(&chain.ring)?;
    spiral_start(&chain.spiral_start, chain.segments)?;
    chain.backbone.map_or(Ok(()), |tube| backbone(&tube, chain.helix.core_inner_radius))
}

/// Checks the angles by which the spirals of so many segments are turned.
fn spiral_start(start: &SpiralStart, segments: usize) -> Result<(), Error> {
    let angle = |quantity: &str, value: f64| {
        let checked = SPIRAL_START.check(quantity, value / (1.0 + FIT));
        checked.map(|_| ()).map_err(|_| Error::range(quantity, value, SPIRAL_START.to_string()))
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
    LENGTH.check("cylinder length (m)", rod.length)?;
    LENGTH.check("cylinder radius (m)", rod.radius)?;
    ROD_INNER_RADIUS.check_beside("cylinder inner radius (m)", rod.inner_radius, rod.radius)?;
    match rod.material {
        CylinderMaterial::Composite { shore_a, poisson, volume_fraction, particle_remanence } => {
            composite(shore_a, poisson, volume_fraction, particle_remanence)?;
        }
        CylinderMaterial::Bulk { elastic_modulus, poisson: ratio, remanence: axial } => {
            elastic(elastic_modulus)?;
            poisson(ratio)?;
            REMANENCE.check("cylinder remanence (T)", axial)?;
        }
    }
    rod.density.map_or(Ok(()), density)
}

fn composite(hardness: f64, ratio: f64, volume_fraction: f64, particle_remanence: f64) -> Result<(), Error> {
    shore_a(hardness)?;
    poisson(ratio)?;
    VOLUME_FRACTION.check("volume fraction Phi", volume_fraction)?;
    REMANENCE.check("particle remanence B_r (T)", particle_remanence).map(|_| ())
}

fn shore_a(value: f64) -> Result<(), Error> {
    SHORE_A.check("Shore A hardness", value).map(|_| ())
}

fn poisson(value: f64) -> Result<(), Error> {
    POISSON.check("Poisson's ratio", value).map(|_| ())
}

fn elastic(value: f64) -> Result<(), Error> {
    ELASTIC_MODULUS.check("Young's modulus (Pa)", value).map(|_| ())
}

fn density(value: f64) -> Result<(), Error> {
    DENSITY.check("density (kg/m3)", value).map(|_| ())
}

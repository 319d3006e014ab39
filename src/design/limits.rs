//! The allowed range of every quantity of a specification.

use core::f64::consts::{PI, TAU};

use super::material::DENSEST_PACKING;
use crate::error::Interval;

/// Largest number of segments of a manipulator.
pub const MOST_SEGMENTS: usize = 64;

/// Largest number of sections of a device made of sections.
pub const MOST_SECTIONS: usize = 128;

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

/// Remanence along a direction, T: negative, it is reversed.
pub const SIGNED_REMANENCE: Interval = Interval::within(20.0);

/// Radius of a section, m: a hundredth of a hair is none.
pub const SECTION_RADIUS: Interval = Interval::at_least(1e-6).at_most(1.0);

/// Inner radius of a section, m.
pub const SECTION_INNER_RADIUS: Interval = Interval::at_least(0.0).less_than("its outer radius");

/// Measured bending and torsional stiffness, N m2.
pub const ROTATIONAL_STIFFNESS: Interval = Interval::above(0.0).at_most(1e3);

/// Measured axial and shear stiffness, N.
pub const LINE_STIFFNESS: Interval = Interval::above(0.0).at_most(1e9);

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

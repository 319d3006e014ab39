//! The allowed range of every quantity of magnets and coils.

use crate::error::Interval;

/// Outer radii and lengths of magnets and windings, m.
pub const SIZE: Interval = Interval::above(1e-9).at_most(1e3);

/// Inner radius of a magnet, m; 0: a solid cylinder.
pub const MAGNET_INNER_RADIUS: Interval = Interval::at_least(0.0).less_than("the outer radius");

/// Distance of a cylinder's centre from its magnet's along the axis, m.
pub const MAGNET_OFFSET: Interval = Interval::within(1e3);

/// Remanence of a magnet, T; negative: against its axis. No magnet has more than 2 T, but scenes use it as a factor on the field of one
/// that stands for a stronger one; what is above 20 T is given in another unit.
pub const MAGNET_REMANENCE: Interval = Interval::within(20.0);

/// Edges, radii and lengths of a magnet that a scene gives by its shape, m: smaller ones were meant in another unit.
pub const DIRECTED_MAGNET_SIZE: Interval = Interval::at_least(2e-4).at_most(2.0);

/// A component of a unit vector whose length is within 0.001 of 1.
pub const DIRECTION_COMPONENT: Interval = Interval::within(1.001);

/// Remanence of a magnet that a scene gives by its shape, T; negative: against its direction. No permanent magnet has more.
pub const DIRECTED_MAGNET_REMANENCE: Interval = Interval::within(2.0);

/// Inner radius of a winding, m.
pub const COIL_INNER_RADIUS: Interval = Interval::above(0.0).less_than("the outer radius");

/// Number of turns of a winding.
pub const COIL_TURNS: Interval = Interval::above(0.0).at_most(1e6);

/// A multipole of degree `l` of a coil with an iron core, T m^(l + 2) / A.
pub const COIL_MULTIPOLE: Interval = Interval::within(1e3);

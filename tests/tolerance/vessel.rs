//! Distances to the wall of a vessel.

/// Distances, m: rounding of lengths of some centimetres.
pub(crate) const CLEARANCE: f64 = 1e-16;

/// Derivatives beside differences of fourth order, relative to a unit gradient and to the second derivative.
pub(crate) const CLEARANCE_SLOPE: f64 = 1e-8;

/// Measures of arteries searched in steps of 0.02 mm, m; that their walls taper counts less.
pub(crate) const MEASURE: f64 = 6e-5;

/// Angles between arteries, rad: a spline turns a little already before a bend begins.
pub(crate) const MEASURED_ANGLE: f64 = 1e-3;

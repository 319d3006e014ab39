//! Distances to the wall of a vessel.

/// Distances, m: rounding of lengths of some centimetres.
pub(crate) const CLEARANCE: f64 = 1e-16;

/// Derivatives beside differences of fourth order, relative to a unit gradient and to the second derivative.
pub(crate) const CLEARANCE_SLOPE: f64 = 1e-8;

//! Distances to the wall of a vessel.

/// Distances, m: rounding of lengths of some centimetres.
pub(crate) const CLEARANCE: f64 = 1e-16;

/// Derivatives beside differences of fourth order, relative to a unit gradient and to the second derivative.
pub(crate) const CLEARANCE_SLOPE: f64 = 1e-8;

/// Distances from a mesh by another formula, m: rounding of lengths of some centimetres, through triangles that are acute.
pub(crate) const MESH_DISTANCE: f64 = 1e-15;

/// Gradient and second derivative (1/m) outside a grid beside differences with a step of 1e-6 m, across planes of nodes where
/// the third derivative changes by some 1000 1/m2.
pub(crate) const GRID_OUTSIDE: [f64; 2] = [1e-7, 0.01];

/// Jumps of value (m), gradient and second derivative (1/m) where the grid changes: rounding of some centimetres to single
/// precision, over powers of half a millimetre.
pub(crate) const GRID_ACROSS_LEVELS: [f64; 3] = [2e-9, 1e-5, 0.1];

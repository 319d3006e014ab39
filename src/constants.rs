//! Physical constants, each with its source.

use core::f64::consts::PI;

/// Vacuum permeability `mu_0 = 4 pi 1e-7`, T m/A.
///
/// The value used by Richter et al.; CODATA 2022 differs by 1.3e-10 of it.
pub const VACUUM_PERMEABILITY: f64 = 4.0e-7 * PI;

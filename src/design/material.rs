//! Elastic moduli and densities of the elastomer and of the magnetic polymer composite (MPC).

use super::modulus::Modulus;

/// Density of the magnetic particles and of the rings, kg/m3.
///
/// Sintered and powdered rare-earth magnets are between 7000 and 7600.
pub const PARTICLE_DENSITY: f64 = 7000.0;

/// Density of the elastomer, kg/m3.
pub const ELASTOMER_DENSITY: f64 = 1000.0;

/// Volume fraction at which the Mooney model's stiffness diverges: `1 / 1.35`.
pub const DENSEST_PACKING: f64 = 1.0 / 1.35;

/// Young's modulus of an elastomer from its Shore A hardness `H` in `(0, 100)`, Pa (Gent's relation).
///
/// ```text
/// E = 0.0981 (56 + 7.66 H) 1e6 / (0.137505 (254 - 2.54 H))
/// ```
///
/// ```
/// let elastic = mcm::design::gent_modulus(33.0);
/// assert!((elastic / 1.29447e6 - 1.0).abs() < 1e-5);
/// ```
///
/// Source: Richter et al., Eq. (14).
#[must_use]
pub fn gent_modulus(shore_a: f64) -> f64 {
    0.0981e6 * (56.0 + 7.66 * shore_a) / (0.137_505 * (254.0 - 2.54 * shore_a))
}

/// Shore A hardness of an elastomer from its Young's modulus, Pa: the inverse of [`gent_modulus`].
///
/// ```
/// use mcm::design::{gent_hardness, gent_modulus};
/// assert!((gent_hardness(gent_modulus(33.0)) - 33.0).abs() < 1e-12);
/// ```
#[must_use]
pub fn gent_hardness(elastic_modulus: f64) -> f64 {
    let ratio = 0.137_505 * elastic_modulus / 0.0981e6;
    (254.0 * ratio - 56.0) / (7.66 + 2.54 * ratio)
}

/// Shear modulus of a composite with the volume fraction `Phi` of particles, Pa (Mooney model).
///
/// ```text
/// G = E / (2 (1 + nu)) exp(2.5 Phi / (1 - 1.35 Phi))
/// ```
///
/// `elastic_modulus` (Pa) and `poisson` are the elastomer's; `volume_fraction` lies in `[0, 1/1.35)`.
///
/// ```
/// let shear = mcm::design::composite_shear_modulus(mcm::design::gent_modulus(33.0), 0.4, 0.25);
/// assert!((shear / 1.18753e6 - 1.0).abs() < 1e-5);
/// ```
///
/// Source: Richter et al., Eq. (15).
#[must_use]
pub fn composite_shear_modulus(elastic_modulus: f64, poisson: f64, volume_fraction: f64) -> f64 {
    shear_modulus(elastic_modulus, poisson) * (2.5 * volume_fraction / (1.0 - 1.35 * volume_fraction)).exp()
}

/// Shear modulus of an isotropic material, `G = E / (2 (1 + nu))`, Pa.
#[must_use]
pub fn shear_modulus(elastic_modulus: f64, poisson: f64) -> f64 {
    elastic_modulus / (2.0 * (1.0 + poisson))
}

/// Density of the composite, `7000 Phi + 1000 (1 - Phi)`, kg/m3.
#[must_use]
pub fn composite_density(volume_fraction: f64) -> f64 {
    PARTICLE_DENSITY * volume_fraction + ELASTOMER_DENSITY * (1.0 - volume_fraction)
}

impl Modulus {
    /// Young's modulus, Pa: the given one, or that of the Shore A hardness (Eq. 14).
    #[must_use]
    pub fn elastic(self) -> f64 {
        match self {
            Self::ShoreA(hardness) => gent_modulus(hardness),
            Self::Elastic(modulus) => modulus,
        }
    }
}

/// Young's and shear modulus of an isotropic material, Pa.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Moduli {
    pub(super) elastic: f64,
    pub(super) shear: f64,
}

impl Moduli {
    /// Moduli of a composite (Eq. 14, 15): `E = 2 G (1 + nu)`.
    pub(super) fn composite(shore_a: f64, poisson: f64, volume_fraction: f64) -> Self {
        let shear = composite_shear_modulus(gent_modulus(shore_a), poisson, volume_fraction);
        Self { elastic: 2.0 * shear * (1.0 + poisson), shear }
    }

    /// Moduli of a bulk material.
    pub(super) fn bulk(elastic: f64, poisson: f64) -> Self {
        Self { elastic, shear: shear_modulus(elastic, poisson) }
    }
}

//! Specification of a device: dimensions and materials in SI units, not yet validated.

/// An elastic modulus, given directly or by the Shore hardness.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Modulus {
    /// Shore A hardness, converted to Young's modulus by Gent's relation (Eq. 14).
    ShoreA(f64),
    /// Young's modulus, Pa.
    Elastic(f64),
}

/// Arrangement of the spiral's sector in the section.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SpiralKind {
    /// The sector rotates with arc length, as built.
    Helical,
    /// The sector's area is spread evenly over the circle.
    Axisymmetric,
}

/// The magnetic soft helix of a segment (Table 1).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Helix {
    /// Length `L`, m.
    pub length: f64,
    /// Boundary deflection angle `Theta`, rad.
    pub boundary_angle: f64,
    /// Outer radius `R`, m.
    pub radius: f64,
    /// Windings `W`.
    pub windings: f64,
    /// Outer radius of the core cylinder `r_oc`, m.
    pub core_outer_radius: f64,
    /// Inner radius of the core cylinder `r_ic`, m.
    pub core_inner_radius: f64,
    /// Shore A hardness `H` of the elastomer.
    pub shore_a: f64,
    /// Poisson's ratio `nu`.
    pub poisson: f64,
    /// Volume fraction `Phi` of magnetic particles.
    pub volume_fraction: f64,
    /// Remanence `B_r` of the particles, T.
    pub particle_remanence: f64,
    /// Density of the composite, kg/m3; `None`: `7000 Phi + 1000 (1 - Phi)`.
    pub density: Option<f64>,
}

/// The ring magnets between the helices (Table 1); their radii are the helix's `R` and `r_ic`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RingMagnet {
    /// Length `L_mag`, m.
    pub length: f64,
    /// Remanence `B_r`, T.
    pub remanence: f64,
    /// Relative recoil permeability `mu_r`: slope of the demagnetisation curve `B = B_r + mu_0 mu_r H`. Above 1 the
    /// ring's own field weakens it.
    pub recoil_permeability: f64,
    /// Density, kg/m3.
    pub density: f64,
}

/// A tube through all bodies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Backbone {
    /// Outer radius, m.
    pub outer_radius: f64,
    /// Inner radius, m.
    pub inner_radius: f64,
    /// Elastic modulus.
    pub modulus: Modulus,
    /// Poisson's ratio.
    pub poisson: f64,
    /// Density, kg/m3.
    pub density: f64,
}

/// A chain of segments: ring, then `segments` times (disc, core, disc, ring).
#[derive(Debug, Clone, PartialEq)]
pub struct Segmented {
    /// Number of segments `S`.
    pub segments: usize,
    /// Whether the chain starts with a ring.
    pub base_magnet: bool,
    /// Whether the chain ends with a ring.
    pub tip_magnet: bool,
    /// How the spiral is modelled.
    pub spiral: SpiralKind,
    /// The helix of every segment.
    pub helix: Helix,
    /// The ring magnets.
    pub ring: RingMagnet,
    /// The backbone, if there is one.
    pub backbone: Option<Backbone>,
}

/// Material of a plain cylinder.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum CylinderMaterial {
    /// Magnetic polymer composite: elastomer with magnetic particles (Eq. 14, 15).
    Composite {
        /// Shore A hardness of the elastomer.
        shore_a: f64,
        /// Poisson's ratio.
        poisson: f64,
        /// Volume fraction of magnetic particles.
        volume_fraction: f64,
        /// Remanence of the particles, T.
        particle_remanence: f64,
    },
    /// Bulk material with directly given properties.
    Bulk {
        /// Young's modulus, Pa.
        elastic_modulus: f64,
        /// Poisson's ratio.
        poisson: f64,
        /// Remanence along the axis, T.
        remanence: f64,
    },
}

/// A plain magnetised rod.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cylinder {
    /// Length, m.
    pub length: f64,
    /// Outer radius, m.
    pub radius: f64,
    /// Inner radius, m.
    pub inner_radius: f64,
    /// Material.
    pub material: CylinderMaterial,
    /// Density, kg/m3; `None`: that of the composite, or 1000 for a bulk material.
    pub density: Option<f64>,
}

/// Specification of either type of device.
#[derive(Debug, Clone, PartialEq)]
pub enum Specification {
    /// Rings and helices.
    Segmented(Segmented),
    /// A plain magnetised rod.
    Cylinder(Cylinder),
}

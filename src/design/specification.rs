//! Specification of a device: dimensions and materials in SI units, not yet validated.

use core::f64::consts::PI;

use super::modulus::Modulus;
use super::sections::Sections;
use super::value_list::ValueList;

/// Arrangement of the spirals along the chain.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SpiralKind {
    /// All spirals are right-handed, as built.
    Helical,
    /// The sector's area is spread evenly over the circle.
    Axisymmetric,
    /// Every second spiral is left-handed and starts opposite to where the previous one ends: neighbouring segments are point
    /// reflections of each other through the centre of the ring between them.
    ///
    /// Without loads a chain with an even number of segments, and with both or none of its end rings, is then its own
    /// point reflection, so that tip and base are parallel. With an odd number the bend of one segment remains.
    Alternating,
}

/// Angles, right-handed about `d3`, by which the spirals are turned about the axis, rad.
///
/// At 0 the sector of a right-handed spiral begins at `d1` at the core's proximal end and extends towards `d2`.
#[derive(Debug, Clone, PartialEq)]
pub enum SpiralStart {
    /// One angle for all segments.
    Same(f64),
    /// One angle for each segment, base to tip.
    Each(Vec<f64>),
}

impl SpiralStart {
    /// The angle of segment number `index`, from 0; 0 where the list is too short.
    #[must_use]
    pub fn of(&self, index: usize) -> f64 {
        match self {
            Self::Same(angle) => *angle,
            Self::Each(angles) => angles.get(index).copied().unwrap_or_default(),
        }
    }

    /// Sets the angle of segment number `index` (from 0) of `segments`.
    ///
    /// ```
    /// use mcm::design::SpiralStart;
    /// let mut start = SpiralStart::Same(0.0);
    /// start.set(1, 3, 0.5);
    /// assert_eq!(start, SpiralStart::Each(vec![0.0, 0.5, 0.0]));
    /// ```
    pub fn set(&mut self, index: usize, segments: usize, angle: f64) {
        // One angle for all stays one as long as it says the same: equal designs remain equal.
        if self.of(index).to_bits() == angle.to_bits() {
            return;
        }
        let mut angles: Vec<f64> = (0..segments).map(|k| self.of(k)).collect();
        if let Some(own) = angles.get_mut(index) {
            *own = angle;
        }
        *self = Self::Each(angles);
    }
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
    /// Remanence `B_r`, T; negative, which needs a direction: reversed.
    pub remanence: f64,
    /// Direction of the magnetisation, a unit vector in the material frame; `None`: along the axis.
    pub direction: Option<[f64; 3]>,
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

/// A wire inside the device, straight when unloaded: it slides freely and turns freely about its axis, so that it adds its bending
/// stiffness alone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Guidewire {
    /// Radius, m.
    pub radius: f64,
    /// Young's modulus, Pa.
    pub elastic_modulus: f64,
}

impl Guidewire {
    /// Bending stiffness `E pi r^4 / 4`, N m2.
    #[must_use]
    pub fn bending_stiffness(&self) -> f64 {
        self.elastic_modulus * PI * self.radius.powi(4) / 4.0
    }
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
    /// How the spirals are arranged.
    pub spiral: SpiralKind,
    /// Angles by which the spirals are turned about the axis; they mean nothing for [`SpiralKind::Axisymmetric`].
    pub spiral_start: SpiralStart,
    /// The helix of every segment.
    pub helix: Helix,
    /// The ring magnets.
    pub ring: RingMagnet,
    /// Numbers of helices and rings that are not the same for all, at most one list for each quantity.
    pub lists: Vec<ValueList>,
    /// Directions of the rings' magnetisation, one for each; empty: that of [`Segmented::ring`].
    pub ring_directions: Vec<[f64; 3]>,
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

/// Specification of any type of device.
#[derive(Debug, Clone, PartialEq)]
#[allow(
    clippy::large_enum_variant,
    reason = "there is one of a device; where pointers are short, the difference is small"
)]
pub enum Specification {
    /// Rings and helices.
    Segmented(Segmented),
    /// A plain magnetised rod.
    Cylinder(Cylinder),
    /// Any sections in a row.
    Sections(Sections),
}

//! Specification of a device made of sections: tubes, rods, magnets and balls in a row, in SI units, not yet validated.

use core::ptr;

use super::material::{ELASTOMER_DENSITY, PARTICLE_DENSITY, composite_density};
use super::modulus::Modulus;
use super::quantities as of;
use super::section::Stiffness;
use crate::error::Quantity;

/// Most components of a quantity of a section: those of a vector.
const MOST_COMPONENTS: usize = 3;

/// A device made of sections, proximal to distal.
#[derive(Debug, Clone, PartialEq)]
pub struct Sections {
    /// The sections, proximal to distal.
    pub sections: Vec<Section>,
}

/// A section of a device: a tube, elastic or rigid, or a rigid ball.
///
/// Its material frame continues that of the section before it: nothing turns at a joint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Section {
    /// Length along the axis, m; that of a ball is its diameter.
    pub length: f64,
    /// Outer radius at the start and at the end, m; linear in between.
    pub outer_radius: [f64; 2],
    /// Inner radius at the start and at the end, m; that of a ball has no influence.
    pub inner_radius: [f64; 2],
    /// How it deforms.
    pub body: SectionBody,
    /// Density, kg/m3; `None`: that of the composite of an elastic section, 7000 of a rigid one.
    pub density: Option<f64>,
    /// Its magnetisation.
    pub magnet: SectionMagnet,
    /// Direction of the magnetisation at the section's start, a unit vector in the material frame.
    pub direction: [f64; 3],
    /// Turn of that direction along the section, right-handed about the axis, rad/m.
    pub turn: f64,
    /// Curvature about `d1` and `d2` and twist about `d3` without loads, 1/m.
    pub rest_curvature: [f64; 3],
}

/// How a section deforms.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SectionBody {
    /// It is elastic, of an isotropic material.
    Elastic {
        /// Elastic modulus: with a hardness that of the elastomer without particles.
        modulus: Modulus,
        /// Poisson's ratio.
        poisson: f64,
    },
    /// It is elastic, with measured stiffness.
    Measured(MeasuredStiffness),
    /// It is rigid.
    Rigid,
    /// It is a rigid sphere of its outer radius.
    Ball,
}

/// Measured stiffness of a section.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeasuredStiffness {
    /// Bending stiffness, N m2.
    pub bending: f64,
    /// Torsional stiffness, N m2.
    pub torsion: f64,
    /// Axial stiffness, N.
    pub axial: f64,
    /// Shear stiffness, N; `None`: as good as rigid.
    pub shear: Option<f64>,
}

/// Remanence of a section.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SectionMagnet {
    /// Remanence of the material, T; negative: reversed.
    Bulk(f64),
    /// Particles in a matrix.
    Composite {
        /// Volume fraction of the particles.
        volume_fraction: f64,
        /// Remanence of the particles, T; negative: reversed.
        particle_remanence: f64,
    },
}

impl SectionMagnet {
    /// Remanence of the whole material, T.
    #[must_use]
    pub fn remanence(self) -> f64 {
        match self {
            Self::Bulk(remanence) => remanence,
            Self::Composite { volume_fraction, particle_remanence } => volume_fraction * particle_remanence,
        }
    }

    /// Volume fraction of the particles; 0 for a bulk material.
    #[must_use]
    pub fn volume_fraction(self) -> f64 {
        match self {
            Self::Bulk(_) => 0.0,
            Self::Composite { volume_fraction, .. } => volume_fraction,
        }
    }
}

impl MeasuredStiffness {
    /// Shear stiffness of a section that hardly shears, times the square of its outer radius, relative to its bending stiffness:
    /// shear then adds 1e-7 to the deflection of a section as short as that radius.
    const RIGID_SHEAR: f64 = 1e7;

    /// The stiffness of a section of this outer radius (m).
    pub(super) fn stiffness(self, outer_radius: f64) -> Stiffness {
        let rigid = Self::RIGID_SHEAR * self.bending / (outer_radius * outer_radius);
        Stiffness {
            bending: self.bending,
            torsion: self.torsion,
            shear: self.shear.unwrap_or(rigid),
            axial: self.axial,
        }
    }
}

impl Section {
    /// Whether it does not deform.
    #[must_use]
    pub fn is_rigid(&self) -> bool {
        matches!(self.body, SectionBody::Rigid | SectionBody::Ball)
    }

    /// Density, kg/m3: as given, or that of the material.
    #[must_use]
    pub fn density(&self) -> f64 {
        let fraction = self.magnet.volume_fraction();
        self.density.unwrap_or(if self.is_rigid() {
            PARTICLE_DENSITY
        } else if fraction > 0.0 {
            composite_density(fraction)
        } else {
            ELASTOMER_DENSITY
        })
    }

    /// Whether its radii change along it.
    #[must_use]
    pub fn is_tapered(&self) -> bool {
        let changes = |[start, end]: [f64; 2]| start.to_bits() != end.to_bits();
        changes(self.outer_radius) || changes(self.inner_radius)
    }
}

/// A quantity of a section, and the number number `component` (from 0) that holds it, if the section has it.
type Entry = (&'static Quantity, fn(&mut Section, usize) -> Option<&mut f64>);

impl Section {
    /// The quantities that sections have; those that come in several numbers are in one row.
    const ENTRIES: [Entry; 17] = [
        (&of::SECTION_LENGTH, |own, n| (n == 0 && own.body != SectionBody::Ball).then_some(&mut own.length)),
        (&of::SECTION_OUTER, |own, n| (n == 0 || own.is_tapered()).then(|| own.outer_radius.get_mut(n))?),
        (&of::SECTION_INNER, |own, n| (n == 0 || own.is_tapered()).then(|| own.inner_radius.get_mut(n))?),
        (&of::SECTION_SHORE_A, |own, n| match &mut own.body {
            SectionBody::Elastic { modulus: Modulus::ShoreA(value), .. } if n == 0 => Some(value),
            _ => None,
        }),
        (&of::SECTION_ELASTIC_MODULUS, |own, n| match &mut own.body {
            SectionBody::Elastic { modulus: Modulus::Elastic(value), .. } if n == 0 => Some(value),
            _ => None,
        }),
        (&of::SECTION_POISSON, |own, n| match &mut own.body {
            SectionBody::Elastic { poisson, .. } if n == 0 => Some(poisson),
            _ => None,
        }),
        (&of::SECTION_BENDING, |own, n| own.measured(n).map(|own| &mut own.bending)),
        (&of::SECTION_TORSION, |own, n| own.measured(n).map(|own| &mut own.torsion)),
        (&of::SECTION_AXIAL, |own, n| own.measured(n).map(|own| &mut own.axial)),
        (&of::SECTION_SHEAR, |own, n| own.measured(n)?.shear.as_mut()),
        (&of::SECTION_DENSITY, |own, n| (n == 0).then(|| own.density.get_or_insert(0.0))),
        (&of::SECTION_REMANENCE, |own, n| match &mut own.magnet {
            SectionMagnet::Bulk(remanence) if n == 0 => Some(remanence),
            _ => None,
        }),
        (&of::SECTION_VOLUME_FRACTION, |own, n| match &mut own.magnet {
            SectionMagnet::Composite { volume_fraction, .. } if n == 0 => Some(volume_fraction),
            _ => None,
        }),
        (&of::SECTION_PARTICLE_REMANENCE, |own, n| match &mut own.magnet {
            SectionMagnet::Composite { particle_remanence, .. } if n == 0 => Some(particle_remanence),
            _ => None,
        }),
        (&of::SECTION_DIRECTION, |own, n| own.direction.get_mut(n)),
        (&of::SECTION_TURN, |own, n| (n == 0 && !own.is_rigid()).then_some(&mut own.turn)),
        (&of::SECTION_REST, |own, n| (!own.is_rigid()).then(|| own.rest_curvature.get_mut(n))?),
    ];

    fn measured(&mut self, component: usize) -> Option<&mut MeasuredStiffness> {
        match &mut self.body {
            SectionBody::Measured(measured) if component == 0 => Some(measured),
            _ => None,
        }
    }

    /// The quantities that this section has, and in how many numbers.
    pub fn quantities(mut self) -> impl Iterator<Item = (&'static Quantity, usize)> {
        let count = move |(quantity, entry): Entry| {
            (quantity, (0..MOST_COMPONENTS).take_while(|n| entry(&mut self, *n).is_some()).count())
        };
        Self::ENTRIES.into_iter().map(count).filter(|(_, count)| *count > 0)
    }

    /// A number of the section: `component` counts from 0. `None` for what it does not have; of a density, 0 where it follows from the
    /// material.
    #[must_use]
    pub fn number(mut self, quantity: &Quantity, component: usize) -> Option<f64> {
        let (_, entry) = Self::ENTRIES.iter().find(|(own, _)| ptr::eq(*own, quantity))?;
        entry(&mut self, component).copied()
    }

    /// Sets a number of the section, if it has it: a radius of a section without a taper at both ends, a density of 0 as one that
    /// follows from the material, and of a ball its length with its radius.
    pub fn set(&mut self, quantity: &Quantity, component: usize, value: f64) {
        let tapered = self.is_tapered();
        let entry = Self::ENTRIES.iter().find(|(own, _)| ptr::eq(*own, quantity));
        if let Some(number) = entry.and_then(|(_, entry)| entry(self, component)) {
            *number = value;
        }

        if !tapered {
            self.outer_radius[1] = self.outer_radius[0];
            self.inner_radius[1] = self.inner_radius[0];
        }
        self.density = self.density.filter(|density| *density != 0.0);
        if self.body == SectionBody::Ball {
            self.length = 2.0 * self.outer_radius[0];
        }
    }
}

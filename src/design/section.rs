//! The bodies of the chain, with the properties that the rod and the magnetic models need.

use core::f64::consts::PI;
use core::ops::Add;

use super::helix::annulus_area;
use super::material::Moduli;
use crate::constants::VACUUM_PERMEABILITY;

/// Stiffness of a span's section, the diagonals of `K_bt` and `K_se` (Eq. 12).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stiffness {
    /// Bending stiffness `E I`, N m2.
    pub bending: f64,
    /// Torsional stiffness `G J`, N m2.
    pub torsion: f64,
    /// Shear stiffness `G A`, N.
    pub shear: f64,
    /// Axial stiffness `E A`, N.
    pub axial: f64,
}

impl Stiffness {
    /// This stiffness with a lining of this bending stiffness (N m2), which slides and turns freely in it.
    #[must_use]
    pub fn lined(self, lining: f64) -> Self {
        Self { bending: self.bending + lining, ..self }
    }
}

impl Stiffness {
    /// Stiffness of an annulus: `I = pi (r_o^4 - r_i^4) / 4`, `J = 2 I`, `A = pi (r_o^2 - r_i^2)` (Eq. 12, 13).
    pub(super) fn annulus(inner_radius: f64, outer_radius: f64, moduli: Moduli) -> Self {
        let inertia = PI * (outer_radius.powi(4) - inner_radius.powi(4)) / 4.0;
        let area = annulus_area(inner_radius, outer_radius);
        Self {
            bending: moduli.elastic * inertia,
            torsion: moduli.shear * 2.0 * inertia,
            shear: moduli.shear * area,
            axial: moduli.elastic * area,
        }
    }
}

impl Add for Stiffness {
    type Output = Self;

    /// Stiffness of two concentric sections that deform together.
    fn add(self, other: Self) -> Self {
        Self {
            bending: self.bending + other.bending,
            torsion: self.torsion + other.torsion,
            shear: self.shear + other.shear,
            axial: self.axial + other.axial,
        }
    }
}

/// How the sector of a spiral lies in the section.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SectorKind {
    /// It turns with arc length, right-handed about `d3`.
    RightHanded,
    /// It turns with arc length, left-handed about `d3`.
    LeftHanded,
    /// Its area is spread evenly over the circle.
    Axisymmetric,
}

/// The spiral on a core: at arc length `s` a sector between the angles `beta` and `beta + sector_angle` from `d1`, with
/// `beta = start + 2 pi windings s / length`; left-handed, `beta = start - 2 pi windings s / length`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spiral {
    /// Inner radius of the sector (the core's outer radius), m.
    pub inner_radius: f64,
    /// Outer radius of the sector, m.
    pub outer_radius: f64,
    /// Sector angle `phi`, rad.
    pub sector_angle: f64,
    /// Windings over the whole core.
    pub windings: f64,
    /// Right-handed, left-handed or axisymmetric.
    pub kind: SectorKind,
    /// Angle from `d1` at which the sector begins at the span's start, rad.
    pub start: f64,
    /// Angle `Theta` by which the core bends until adjacent windings touch, rad.
    pub boundary_angle: f64,
    /// Bending stiffness of the section whose windings touch (annulus `r_ic` to `R`), N m2.
    pub closed_bending: f64,
}

/// Type of a span.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SpanKind {
    /// A closed and ground end of the helix.
    Disc,
    /// The core cylinder with its spiral.
    Core,
    /// The body of a plain cylinder.
    Rod,
}

/// A deformable piece of constant section, magnetised along `d3`.
#[derive(Debug, Clone, PartialEq)]
pub struct Span {
    /// Type of the span.
    pub kind: SpanKind,
    /// Length along the unstrained centreline, m.
    pub length: f64,
    /// Inner radius of the annulus, m.
    pub inner_radius: f64,
    /// Outer radius of the annulus (without the spiral), m.
    pub outer_radius: f64,
    /// Section stiffness, including the backbone's.
    pub stiffness: Stiffness,
    /// Magnetisation along `d3`, A/m.
    pub magnetisation: f64,
    /// Density of the annulus and the spiral, kg/m3.
    pub density: f64,
    /// Additional mass per length on the centreline (the backbone), kg/m.
    pub line_density: f64,
    /// The spiral, if the span carries one.
    pub spiral: Option<Spiral>,
}

/// A rigid ring magnet, magnetised along its axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ring {
    /// Inner radius, m.
    pub inner_radius: f64,
    /// Outer radius, m.
    pub outer_radius: f64,
    /// Length along the axis, m.
    pub length: f64,
    /// Remanence of the equivalent uniform magnet of permeability 1, T: the ring's polarisation `mu_0 M` along its axis
    /// in its own field, see [`Segmented::ring_polarisation`](super::Segmented::ring_polarisation).
    pub remanence: f64,
    /// Mass, including the backbone's part, kg.
    pub mass: f64,
}

impl Spiral {
    /// Angles from `d1` between which the sector lies at arc length `s` from the start of a span of `length` (m), rad; those of a
    /// right-handed spiral where it is spread over the circle.
    #[must_use]
    pub fn sector(&self, s: f64, length: f64) -> [f64; 2] {
        let turned = 2.0 * PI * self.windings * s / length;
        let from = match self.kind {
            SectorKind::LeftHanded => self.start - turned,
            SectorKind::RightHanded | SectorKind::Axisymmetric => self.start + turned,
        };
        [from, from + self.sector_angle]
    }

    /// Area of the sector, m2.
    #[must_use]
    pub fn area(&self) -> f64 {
        self.sector_angle / (2.0 * PI) * annulus_area(self.inner_radius, self.outer_radius)
    }
}

impl Span {
    /// Area of the annulus without the spiral, m2.
    #[must_use]
    pub fn area(&self) -> f64 {
        annulus_area(self.inner_radius, self.outer_radius)
    }

    /// Outer radius, including the spiral, m.
    #[must_use]
    pub fn widest_radius(&self) -> f64 {
        self.spiral.map_or(self.outer_radius, |spiral| self.outer_radius.max(spiral.outer_radius))
    }

    /// Volume of magnetised material, including the spiral, m3.
    #[must_use]
    pub fn volume(&self) -> f64 {
        (self.area() + self.spiral.map_or(0.0, |spiral| spiral.area())) * self.length
    }

    /// Magnetic moment of the straight span along `d3`, A m2.
    #[must_use]
    pub fn moment(&self) -> f64 {
        self.magnetisation * self.volume()
    }

    /// Mass, including the backbone's part, kg.
    #[must_use]
    pub fn mass(&self) -> f64 {
        self.density * self.volume() + self.line_density * self.length
    }
}

impl Ring {
    /// Volume, m3.
    #[must_use]
    pub fn volume(&self) -> f64 {
        annulus_area(self.inner_radius, self.outer_radius) * self.length
    }

    /// Magnetic moment `B_r V / mu_0` along the axis, A m2.
    #[must_use]
    pub fn moment(&self) -> f64 {
        self.remanence * self.volume() / VACUUM_PERMEABILITY
    }
}

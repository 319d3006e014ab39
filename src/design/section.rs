//! The bodies of the chain, with the properties that the rod and the magnetic models need.

use core::f64::consts::PI;
use core::ops::Add;

use nalgebra::Vector3;

use super::area::annulus_area;
use super::direction::Direction;
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
    /// An elastic section of a device made of sections.
    Section,
}

/// Radii and material of a span whose radii change linearly along it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Taper {
    /// Inner radius at the span's end, m.
    pub inner_radius: f64,
    /// Outer radius at the span's end, m.
    pub outer_radius: f64,
    pub(super) moduli: Moduli,
}

/// A deformable piece, of constant section unless it is tapered.
#[derive(Debug, Clone, PartialEq)]
pub struct Span {
    /// Type of the span.
    pub kind: SpanKind,
    /// Length along the unstrained centreline, m.
    pub length: f64,
    /// Inner radius of the annulus, at the span's start, m.
    pub inner_radius: f64,
    /// Outer radius of the annulus (without the spiral), at the span's start, m.
    pub outer_radius: f64,
    /// How the radii change along it; `None`: they do not.
    pub taper: Option<Taper>,
    /// Stiffness of the section at the span's start, including the backbone's.
    pub stiffness: Stiffness,
    /// Magnetisation, A/m; negative: against its direction.
    pub magnetisation: f64,
    /// Direction of the magnetisation at the span's start, in the directors.
    pub direction: Direction,
    /// Turn of that direction along the span, right-handed about `d3`, rad/m.
    pub turn: f64,
    /// Curvature about `d1` and `d2` and twist about `d3` without loads, 1/m.
    pub rest_curvature: Vector3<f64>,
    /// Density of the annulus and the spiral, kg/m3.
    pub density: f64,
    /// Additional mass per length on the centreline (the backbone), kg/m.
    pub line_density: f64,
    /// The spiral, if the span carries one.
    pub spiral: Option<Spiral>,
}

/// Shape of a rigid body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RigidShape {
    /// A tube or, without a bore, a cylinder.
    Tube,
    /// A sphere.
    Ball,
}

/// A rigid body of the chain: a ring magnet, any rigid tube, or a ball.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ring {
    /// Its shape.
    pub shape: RigidShape,
    /// Inner radius, m; 0 of a ball.
    pub inner_radius: f64,
    /// Outer radius, m.
    pub outer_radius: f64,
    /// Length along the axis, m.
    pub length: f64,
    /// Remanence of the equivalent uniform magnet of permeability 1, T: the body's polarisation `mu_0 M` along its direction
    /// in its own field, see [`Segmented::ring_polarisation`](super::Segmented::ring_polarisation).
    pub remanence: f64,
    /// Direction of the magnetisation, in the directors.
    pub direction: Direction,
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
    /// Nothing: what most spans have in common is taken from it.
    pub(super) fn plain() -> Self {
        Self {
            kind: SpanKind::Rod,
            length: 0.0,
            inner_radius: 0.0,
            outer_radius: 0.0,
            taper: None,
            stiffness: Stiffness { bending: 0.0, torsion: 0.0, shear: 0.0, axial: 0.0 },
            magnetisation: 0.0,
            direction: Direction::Axial,
            turn: 0.0,
            rest_curvature: Vector3::zeros(),
            density: 0.0,
            line_density: 0.0,
            spiral: None,
        }
    }

    /// Inner and outer radius of the annulus at arc length `s` (m) from the span's start, m.
    #[must_use]
    pub fn radii_at(&self, s: f64) -> [f64; 2] {
        let own = [self.inner_radius, self.outer_radius];
        let Some(taper) = &self.taper else { return own };
        let t = s / self.length;
        let [inner, outer] = own;
        [inner + t * (taper.inner_radius - inner), outer + t * (taper.outer_radius - outer)]
    }

    /// Stiffness of the section at arc length `s` (m) from the span's start.
    #[must_use]
    pub fn stiffness_at(&self, s: f64) -> Stiffness {
        let Some(taper) = &self.taper else { return self.stiffness };
        let [inner, outer] = self.radii_at(s);
        Stiffness::annulus(inner, outer, taper.moduli)
    }

    /// Direction of the magnetisation at arc length `s` (m) from the span's start, in the directors.
    #[must_use]
    pub fn direction_at(&self, s: f64) -> Direction {
        self.direction.turned(self.turn * s)
    }

    /// Whether the section, or the direction of its magnetisation, changes along the span; a spiral apart.
    #[must_use]
    pub fn varies(&self) -> bool {
        self.taper.is_some() || (self.turn != 0.0 && !self.direction.is_axial())
    }

    /// Area of the annulus at the span's start without the spiral, m2.
    #[must_use]
    pub fn area(&self) -> f64 {
        annulus_area(self.inner_radius, self.outer_radius)
    }

    /// Outer radius at the widest place, including the spiral, m.
    #[must_use]
    pub fn widest_radius(&self) -> f64 {
        let tapered = self.taper.map_or(self.outer_radius, |taper| self.outer_radius.max(taper.outer_radius));
        self.spiral.map_or(tapered, |spiral| tapered.max(spiral.outer_radius))
    }

    /// Inner radius at the narrowest place, m.
    #[must_use]
    pub fn narrowest_bore(&self) -> f64 {
        self.taper.map_or(self.inner_radius, |taper| self.inner_radius.min(taper.inner_radius))
    }

    /// Volume of magnetised material, including the spiral, m3.
    #[must_use]
    pub fn volume(&self) -> f64 {
        // The area is quadratic along a taper: Simpson's rule is exact.
        let area = match self.taper {
            Some(taper) => {
                let [inner, outer] = self.radii_at(0.5 * self.length);
                let ends = self.area() + annulus_area(taper.inner_radius, taper.outer_radius);
                (ends + 4.0 * annulus_area(inner, outer)) / 6.0
            }
            None => self.area(),
        };
        (area + self.spiral.map_or(0.0, |spiral| spiral.area())) * self.length
    }

    /// Magnetic moment of the straight span along its direction, A m2.
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
        match self.shape {
            RigidShape::Tube => annulus_area(self.inner_radius, self.outer_radius) * self.length,
            RigidShape::Ball => 4.0 / 3.0 * PI * self.outer_radius.powi(3),
        }
    }

    /// Magnetic moment `B_r V / mu_0` along its direction, A m2.
    #[must_use]
    pub fn moment(&self) -> f64 {
        self.remanence * self.volume() / VACUUM_PERMEABILITY
    }
}

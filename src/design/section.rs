//! The bodies of the chain, as rod and magnetics see them.

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

/// How the spiral's sector lies in the section.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SpiralKind {
    /// The sector turns with arc length, as built.
    Helical,
    /// The sector's area is spread evenly over the circle.
    Axisymmetric,
}

/// The spiral on a core: at arc length `s` a sector between the angles `beta` and `beta + sector_angle`
/// from `d1`, with `beta = 2 pi windings s / length`.
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
    /// Turning or spread.
    pub kind: SpiralKind,
}

/// What a span is.
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
    /// What it is.
    pub kind: SpanKind,
    /// Length along the unstrained centreline, m.
    pub length: f64,
    /// Inner radius of the annulus, m.
    pub inner_radius: f64,
    /// Outer radius of the annulus (without the spiral), m.
    pub outer_radius: f64,
    /// Section stiffness, a backbone's included.
    pub stiffness: Stiffness,
    /// Magnetisation along `d3`, A/m.
    pub magnetisation: f64,
    /// Density of the annulus and the spiral, kg/m3.
    pub density: f64,
    /// Further mass per length on the centreline (the backbone), kg/m.
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
    /// Remanence along the axis, T.
    pub remanence: f64,
    /// Mass, a backbone's part included, kg.
    pub mass: f64,
}

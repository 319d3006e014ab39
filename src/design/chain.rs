//! The chain of bodies from base to tip, validated once.

use core::f64::consts::PI;

use super::helix::annulus_area;
use super::limits;
use super::material::{ELASTOMER_DENSITY, Moduli, composite_density};
use super::section::{Ring, SectorKind, Span, SpanKind, Spiral, Stiffness};
use super::specification::{
    Backbone, Cylinder, CylinderMaterial, Guidewire, Segmented, Specification, SpiralKind,
};
use crate::constants::VACUUM_PERMEABILITY;
use crate::error::Error;

/// The deformable spans between two rings (or between base and tip), and the ring at their distal end.
#[derive(Debug, Clone, PartialEq)]
pub struct Segment {
    /// The deformable spans, base to tip.
    pub spans: Vec<Span>,
    /// The ring at the distal end, if there is one.
    pub ring: Option<Ring>,
}

/// A validated design: all quantities are within their ranges, and the bodies are derived from them.
#[derive(Debug, Clone, PartialEq)]
pub struct Design {
    specification: Specification,
    base_ring: Option<Ring>,
    segments: Vec<Segment>,
    shaft: Option<Span>,
    guidewire: Option<Guidewire>,
}

impl Design {
    /// Checks a specification and derives its bodies.
    ///
    /// A plain cylinder becomes one segment with one span and no rings.
    ///
    /// ```
    /// use mcm::design::{Design, Segmented, Specification};
    /// let Specification::Segmented(paper) = Specification::paper(1) else { unreachable!() };
    /// let refused = Design::new(Specification::Segmented(Segmented { segments: 0, ..paper })).unwrap_err();
    /// assert_eq!(refused.to_string(), "number of segments = 0 is not allowed: it must be from 1 to 64");
    /// ```
    ///
    /// # Errors
    /// [`Error::Range`] naming the first quantity out of range.
    pub fn new(specification: Specification) -> Result<Self, Error> {
        let (base_ring, segments) = match &specification {
            Specification::Segmented(chain) => segmented(chain)?,
            Specification::Cylinder(rod) => (None, vec![plain(rod)?]),
        };
        Ok(Self { specification, base_ring, segments, shaft: None, guidewire: None })
    }

    /// This device at the end of a shaft: a tube that is pushed through a port, as long as its inserted part is.
    ///
    /// # Errors
    /// [`Error::Range`] naming the first quantity out of range.
    pub fn with_shaft(self, tube: &Backbone) -> Result<Self, Error> {
        limits::shaft(tube)?;
        let Tube { stiffness, line_density } = Tube::of(tube);
        let span = Span {
            kind: SpanKind::Rod,
            length: 1.0,
            inner_radius: tube.inner_radius,
            outer_radius: tube.outer_radius,
            stiffness,
            magnetisation: 0.0,
            density: 0.0,
            line_density,
            spiral: None,
        };
        Ok(Self { shaft: Some(span), ..self })
    }

    /// This device, and its shaft if it has one by now, with a guidewire inside.
    ///
    /// # Errors
    /// [`Error::Range`] for a radius that does not fit into every body, or a modulus out of range; [`Error::Unsupported`] where a
    /// body has no lumen.
    pub fn with_guidewire(self, wire: &Guidewire) -> Result<Self, Error> {
        let device = match &self.specification {
            Specification::Segmented(chain) => chain
                .backbone
                .map_or(("core", chain.helix.core_inner_radius), |tube| ("backbone", tube.inner_radius)),
            Specification::Cylinder(rod) => ("cylinder", rod.inner_radius),
        };
        let shaft = self.shaft.iter().map(|span| ("shaft", span.inner_radius));
        limits::guidewire(wire, &shaft.chain([device]).collect::<Vec<_>>())?;
        Ok(Self { guidewire: Some(*wire), ..self })
    }

    /// This device with these, as far as they are given.
    ///
    /// # Errors
    /// As [`Self::with_shaft`] and [`Self::with_guidewire`].
    pub fn with(self, shaft: Option<&Backbone>, guidewire: Option<&Guidewire>) -> Result<Self, Error> {
        let design = match shaft {
            Some(tube) => self.with_shaft(tube)?,
            None => self,
        };
        match guidewire {
            Some(wire) => design.with_guidewire(wire),
            None => Ok(design),
        }
    }

    /// The guidewire inside, if there is one.
    #[must_use]
    pub fn guidewire(&self) -> Option<&Guidewire> {
        self.guidewire.as_ref()
    }

    /// The shaft, a metre of it; `None` for a device that is clamped at its base.
    #[must_use]
    pub fn shaft(&self) -> Option<&Span> {
        self.shaft.as_ref()
    }

    /// The specification from which the design was made.
    #[must_use]
    pub fn specification(&self) -> &Specification {
        &self.specification
    }

    /// The ring at the base, clamped with the base frame at its proximal face.
    #[must_use]
    pub fn base_ring(&self) -> Option<&Ring> {
        self.base_ring.as_ref()
    }

    /// The segments, base to tip.
    #[must_use]
    pub fn segments(&self) -> &[Segment] {
        &self.segments
    }

    /// All rings, base to tip.
    pub fn rings(&self) -> impl Iterator<Item = &Ring> {
        self.base_ring.iter().chain(self.segments.iter().filter_map(|segment| segment.ring.as_ref()))
    }

    /// Whether every body is symmetric about its axis: no spiral winds in one direction.
    #[must_use]
    pub fn is_axisymmetric(&self) -> bool {
        let mut spirals =
            self.segments.iter().flat_map(|segment| &segment.spans).filter_map(|span| span.spiral);
        spirals.all(|spiral| spiral.kind == SectorKind::Axisymmetric)
    }

    /// Length of the straight unloaded manipulator without a shaft, m.
    #[must_use]
    pub fn length(&self) -> f64 {
        let spans: f64 = self.segments.iter().flat_map(|s| &s.spans).map(|span| span.length).sum();
        spans + self.rings().map(|ring| ring.length).sum::<f64>()
    }

    /// Largest radius of its bodies without a shaft, m.
    #[must_use]
    pub fn largest_radius(&self) -> f64 {
        let spans = self.segments.iter().flat_map(|segment| &segment.spans).map(Span::widest_radius);
        self.rings().map(|ring| ring.outer_radius).chain(spans).fold(0.0, f64::max)
    }

    /// Mass of all bodies, kg.
    #[must_use]
    pub fn mass(&self) -> f64 {
        let spans: f64 = self.segments.iter().flat_map(|s| &s.spans).map(Span::mass).sum();
        spans + self.rings().map(|ring| ring.mass).sum::<f64>()
    }

    /// Magnetic moment of the straight manipulator along `d3`, A m2.
    #[must_use]
    pub fn moment(&self) -> f64 {
        let spans: f64 = self.segments.iter().flat_map(|s| &s.spans).map(Span::moment).sum();
        spans + self.rings().map(Ring::moment).sum::<f64>()
    }
}

/// The base ring and the segments of a chain of rings and helices.
fn segmented(chain: &Segmented) -> Result<(Option<Ring>, Vec<Segment>), Error> {
    limits::segmented(chain)?;

    let helix = &chain.helix;
    let geometry = helix.geometry()?;
    let tube = chain.backbone.as_ref().map(Tube::of).unwrap_or_default();

    let ring = Ring {
        inner_radius: helix.core_inner_radius,
        outer_radius: helix.radius,
        length: chain.ring.length,
        remanence: chain.ring_polarisation(),
        mass: (chain.ring.density * annulus_area(helix.core_inner_radius, helix.radius) + tube.line_density)
            * chain.ring.length,
    };

    let moduli = Moduli::composite(helix.shore_a, helix.poisson, helix.volume_fraction);
    let body = |kind, length, outer_radius, spiral| Span {
        kind,
        length,
        inner_radius: helix.core_inner_radius,
        outer_radius,
        stiffness: Stiffness::annulus(helix.core_inner_radius, outer_radius, moduli) + tube.stiffness,
        magnetisation: helix.volume_fraction * helix.particle_remanence / VACUUM_PERMEABILITY,
        density: helix.density.unwrap_or_else(|| composite_density(helix.volume_fraction)),
        line_density: tube.line_density,
        spiral,
    };

    let disc = body(SpanKind::Disc, geometry.height, helix.radius, None);
    let spiral = Spiral {
        inner_radius: helix.core_outer_radius,
        outer_radius: helix.radius,
        sector_angle: geometry.sector_angle,
        windings: helix.windings,
        kind: SectorKind::Axisymmetric,
        start: 0.0,
        boundary_angle: helix.boundary_angle,
        closed_bending: disc.stiffness.bending,
    };

    let core = body(SpanKind::Core, geometry.core_length, helix.core_outer_radius, None);
    let segments = (0..chain.segments)
        .map(|index| {
            let (kind, start) = sector(chain, index);
            let core = Span { spiral: Some(Spiral { kind, start, ..spiral }), ..core.clone() };
            Segment {
                spans: vec![disc.clone(), core, disc.clone()],
                ring: (index + 1 < chain.segments || chain.tip_magnet).then_some(ring),
            }
        })
        .collect();

    Ok((chain.base_magnet.then_some(ring), segments))
}

/// How the sector of the spiral of segment number `index` (from 0) lies, and where it begins (rad).
fn sector(chain: &Segmented, index: usize) -> (SectorKind, f64) {
    let start = chain.spiral_start.of(index);
    match chain.spiral {
        // The same for all segments, so that they remain alike.
        SpiralKind::Axisymmetric => (SectorKind::Axisymmetric, 0.0),
        // Opposite to the end of the previous spiral, whole turns left out.
        SpiralKind::Alternating if index % 2 == 1 => {
            (SectorKind::LeftHanded, start + PI * (1.0 + 2.0 * chain.helix.windings.fract()))
        }
        SpiralKind::Helical | SpiralKind::Alternating => (SectorKind::RightHanded, start),
    }
}

/// The one segment of a plain cylinder.
fn plain(rod: &Cylinder) -> Result<Segment, Error> {
    limits::cylinder(rod)?;
    let (moduli, remanence, bulk_density) = match rod.material {
        CylinderMaterial::Composite { shore_a, poisson, volume_fraction, particle_remanence } => (
            Moduli::composite(shore_a, poisson, volume_fraction),
            volume_fraction * particle_remanence,
            composite_density(volume_fraction),
        ),
        CylinderMaterial::Bulk { elastic_modulus, poisson, remanence } => {
            (Moduli::bulk(elastic_modulus, poisson), remanence, ELASTOMER_DENSITY)
        }
    };

    let span = Span {
        kind: SpanKind::Rod,
        length: rod.length,
        inner_radius: rod.inner_radius,
        outer_radius: rod.radius,
        stiffness: Stiffness::annulus(rod.inner_radius, rod.radius, moduli),
        magnetisation: remanence / VACUUM_PERMEABILITY,
        density: rod.density.unwrap_or(bulk_density),
        line_density: 0.0,
        spiral: None,
    };
    Ok(Segment { spans: vec![span], ring: None })
}

/// Contribution of a backbone to every section.
struct Tube {
    stiffness: Stiffness,
    line_density: f64,
}

impl Tube {
    fn of(backbone: &Backbone) -> Self {
        let moduli = Moduli::bulk(backbone.modulus.elastic(), backbone.poisson);
        Self {
            stiffness: Stiffness::annulus(backbone.inner_radius, backbone.outer_radius, moduli),
            line_density: backbone.density * annulus_area(backbone.inner_radius, backbone.outer_radius),
        }
    }
}

impl Default for Tube {
    /// No backbone.
    fn default() -> Self {
        Self {
            stiffness: Stiffness { bending: 0.0, torsion: 0.0, shear: 0.0, axial: 0.0 },
            line_density: 0.0,
        }
    }
}

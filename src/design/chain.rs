//! The chain of bodies from base to tip, validated once.

use nalgebra::Vector2;

use super::material::{ELASTOMER_DENSITY, Moduli, composite_density};
use super::section::{Ring, SectorKind, Span, SpanKind, Stiffness};
use super::segment::Segment;
use super::specification::{Backbone, Cylinder, CylinderMaterial, Guidewire, Specification};
use super::tube::Tube;
use super::{checks, sectioned, segmented};
use crate::constants::VACUUM_PERMEABILITY;
use crate::error::Error;

/// A validated design: all quantities are within their ranges, and the bodies are derived from them.
#[derive(Debug, Clone, PartialEq)]
pub struct Design {
    specification: Specification,
    base_rings: Vec<Ring>,
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
        let (base_rings, segments) = match &specification {
            Specification::Segmented(chain) => segmented::bodies(chain)?,
            Specification::Cylinder(rod) => (Vec::new(), vec![plain(rod)?]),
            Specification::Sections(device) => sectioned::bodies(device)?,
        };
        Ok(Self { specification, base_rings, segments, shaft: None, guidewire: None })
    }

    /// This device at the end of a shaft: a tube that is pushed through a port, as long as its inserted part is.
    ///
    /// # Errors
    /// [`Error::Range`] naming the first quantity out of range.
    pub fn with_shaft(self, tube: &Backbone) -> Result<Self, Error> {
        checks::shaft(tube)?;
        let Tube { stiffness, line_density } = Tube::of(tube);
        let span = Span {
            kind: SpanKind::Rod,
            length: 1.0,
            inner_radius: tube.inner_radius,
            outer_radius: tube.outer_radius,
            stiffness,
            line_density,
            ..Span::plain()
        };
        Ok(Self { shaft: Some(span), ..self })
    }

    /// This device, and its shaft if it has one by now, with a guidewire inside.
    ///
    /// # Errors
    /// [`Error::Range`] for a radius that does not fit into every body, or a modulus out of range; [`Error::Unsupported`] where a
    /// body has no lumen.
    pub fn with_guidewire(self, wire: &Guidewire) -> Result<Self, Error> {
        let narrowest = |bores: &mut dyn Iterator<Item = f64>| bores.fold(f64::INFINITY, f64::min);
        let device = match &self.specification {
            Specification::Segmented(chain) => match chain.backbone {
                Some(tube) => ("backbone", tube.inner_radius),
                None => ("core", narrowest(&mut chain.helices().map(|helix| helix.core_inner_radius))),
            },
            Specification::Cylinder(rod) => ("cylinder", rod.inner_radius),
            Specification::Sections(_) => {
                let spans = self.segments.iter().flat_map(|segment| &segment.spans);
                let bores = spans.map(Span::narrowest_bore);
                ("section", narrowest(&mut bores.chain(self.rings().map(|ring| ring.inner_radius))))
            }
        };
        let shaft = self.shaft.iter().map(|span| ("shaft", span.inner_radius));
        checks::guidewire(wire, &shaft.chain([device]).collect::<Vec<_>>())?;
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

    /// The rigid bodies at the base, welded to one another and clamped with the base frame at their proximal face.
    #[must_use]
    pub fn base_rings(&self) -> &[Ring] {
        &self.base_rings
    }

    /// The segments, base to tip.
    #[must_use]
    pub fn segments(&self) -> &[Segment] {
        &self.segments
    }

    /// All rings and other rigid bodies, base to tip.
    pub fn rings(&self) -> impl Iterator<Item = &Ring> {
        self.base_rings.iter().chain(self.segments.iter().flat_map(|segment| &segment.rings))
    }

    /// Whether every body is symmetric about its axis: no spiral winds in one direction, none is bent without loads, and none is
    /// magnetised across its axis.
    #[must_use]
    pub fn is_axisymmetric(&self) -> bool {
        let even = |span: &Span| {
            let spiral = span.spiral.is_none_or(|spiral| spiral.kind == SectorKind::Axisymmetric);
            let magnet = span.magnetisation == 0.0 || span.direction.is_axial();
            spiral && magnet && span.rest_curvature.xy() == Vector2::zeros()
        };
        let own = self.shaft.iter().chain(self.segments.iter().flat_map(|segment| &segment.spans));
        own.into_iter().all(even)
            && self.rings().all(|ring| ring.remanence == 0.0 || ring.direction.is_axial())
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
        let spans = self.segments.iter().flat_map(|segment| &segment.spans);
        let spans: f64 = spans.map(|span| span.moment() * span.direction.vector().z).sum();
        spans + self.rings().map(|ring| ring.moment() * ring.direction.vector().z).sum::<f64>()
    }
}

/// The one segment of a plain cylinder.
fn plain(rod: &Cylinder) -> Result<Segment, Error> {
    checks::cylinder(rod)?;
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
        ..Span::plain()
    };
    Ok(Segment { spans: vec![span], rings: Vec::new() })
}

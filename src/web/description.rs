//! What a page draws of a device and offers to set.

use serde::Serialize;

use crate::constants::VACUUM_PERMEABILITY;
use crate::design::{Design, Ring, SectorKind, Span, SpanKind};
use crate::error::Error;
use crate::fmi::Package;
use crate::fmi::value::{DataType, Value};
use crate::fmi::variable::{Availability, Causality, Request, Variable};
use crate::magnetics::{Drive, Outline};
use crate::manipulator::FeedMode;
use crate::vessel::Branch;

/// Distance between the balls of a branch that a page gets, m, and the most of them.
const BALL_SPACING: f64 = 1.5e-3;
const MOST_BALLS: f64 = 600.0;

/// A device and what is around it; lengths in m, angles in rad, remanences in T.
#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Description {
    level: &'static str,
    inputs: Vec<Row>,
    outputs: Vec<Row>,
    shape_points: usize,
    bodies: Vec<Body>,
    shaft: Option<Tube>,
    feed_mode: FeedMode,
    guidewire: Option<Wire>,
    magnet: Vec<Part>,
    /// The magnets after the first one, then the coils.
    #[serde(rename = "further")]
    others: Vec<Source>,
    vessel: Option<Wall>,
}

/// An input or output.
#[derive(Debug, Serialize)]
struct Row {
    name: String,
    unit: &'static str,
    description: String,
    start: Option<f64>,
    min: Option<f64>,
    max: Option<f64>,
}

/// A body of the device.
#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
struct Body {
    kind: &'static str,
    /// Unstrained arc length from the device's base.
    begin: f64,
    length: f64,
    inner_radius: f64,
    outer_radius: f64,
    remanence: f64,
    spiral: Option<Spiral>,
    boundary_angle: Option<f64>,
}

/// The spiral on a core.
#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
struct Spiral {
    inner_radius: f64,
    outer_radius: f64,
    sector_angle: f64,
    windings: f64,
    turn: i8,
    start: f64,
}

#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
struct Tube {
    inner_radius: f64,
    outer_radius: f64,
}

#[derive(Debug, Serialize)]
struct Wire {
    radius: f64,
}

/// A magnet after the first one, or a coil. The part of a coil is its winding, with core if there is one, and has the remanence of
/// its dipole moment at one ampere.
#[derive(Debug, Serialize)]
struct Source {
    name: String,
    coil: bool,
    parts: Vec<Part>,
}

/// A part of a magnet or coil.
#[derive(Debug, Serialize)]
struct Part {
    #[serde(flatten)]
    solid: Solid,
    /// Position of its centre along the source's `z`.
    offset: f64,
    remanence: [f64; 3],
    volume: f64,
}

/// What a page draws of a part.
#[derive(Debug, Serialize)]
#[serde(tag = "shape", rename_all = "camelCase", rename_all_fields = "camelCase")]
enum Solid {
    Cylinder { inner_radius: f64, outer_radius: f64, length: f64 },
    Cuboid { size: [f64; 3] },
    Sphere { radius: f64 },
}

/// The wall of the vessel; that of a mesh has no branches here, and its triangles are known to whoever has the mesh.
#[derive(Debug, Serialize)]
struct Wall {
    branches: Vec<Course>,
    triangles: [f64; 0],
}

/// A branch as balls along its centreline: x, y, z and radius of each.
#[derive(Debug, Serialize)]
struct Course {
    name: String,
    balls: Vec<f64>,
}

impl Description {
    /// That of a packed design.
    pub(super) fn of(package: &Package) -> Result<Self, Error> {
        let (table, start) = (package.table(), package.start());
        let rows = |listed: fn(&Variable) -> bool| {
            let listed = table.variables().iter().filter(move |row| listed(row));
            listed
                .map(|variable| Row::of(variable, variable.host_value(start).and_then(Value::real)))
                .collect()
        };

        let design = start.design()?;
        let sources = start.sources()?;
        let mut sources = start.source_names().zip(sources.list()).map(|((name, drive), source)| {
            let parts = source.parts().iter().map(Part::of).collect();
            Source { name, coil: drive == Drive::Current, parts }
        });

        let walls = start.vessel.as_ref().map(|vessel| Wall {
            branches: vessel.lumen.branches().iter().map(Course::of).collect(),
            triangles: [],
        });

        Ok(Self {
            level: start.settings.interaction.name(),
            inputs: rows(|row| row.causality == Causality::Input),
            outputs: rows(is_shown),
            shape_points: table.counts().shape_points,
            bodies: bodies(&design),
            shaft: design
                .shaft()
                .map(|span| Tube { inner_radius: span.inner_radius, outer_radius: span.outer_radius }),
            feed_mode: start.feed_mode,
            guidewire: design.guidewire().map(|wire| Wire { radius: wire.radius }),
            magnet: sources.next().map_or_else(Vec::new, |magnet| magnet.parts),
            others: sources.collect(),
            vessel: walls,
        })
    }

    pub(super) fn to_json(&self) -> Result<String, Error> {
        serde_json::to_string(self)
            .map_err(|error| Error::Syntax { what: "description".into(), reason: error.to_string() })
    }
}

impl Part {
    fn of(part: &crate::magnetics::Part) -> Self {
        let solid = match &part.outline {
            Outline::Cylinder(body) => Solid::Cylinder {
                inner_radius: body.inner_radius(),
                outer_radius: body.outer_radius(),
                length: body.length(),
            },
            Outline::Cuboid(half) => Solid::Cuboid { size: (2.0 * half).into() },
            Outline::Sphere(radius) => Solid::Sphere { radius: *radius },
        };
        let (remanence, volume) = (part.remanence.into(), part.outline.volume());
        Self { solid, offset: part.centre.z, remanence, volume }
    }
}

impl Row {
    fn of(variable: &Variable, start: Option<f64>) -> Self {
        let unit = match variable.data_type {
            DataType::Real(quantity) => quantity.unit,
            DataType::Integer | DataType::Boolean | DataType::Enumeration(_) => "1",
        };
        Self {
            name: variable.name.clone(),
            unit,
            description: variable.description.clone(),
            start,
            min: variable.min,
            max: variable.max,
        }
    }
}

/// Whether a page gets a variable as an output: tangents and curvatures are many, and a page draws the centreline without them.
pub(super) fn is_shown(variable: &Variable) -> bool {
    variable.is_result() && variable.availability != Availability::OnRequest(Request::Strains)
}

/// The bodies, base to tip.
fn bodies(design: &Design) -> Vec<Body> {
    let mut bodies: Vec<Body> = design.base_rings().iter().map(Body::ring).collect();
    for segment in design.segments() {
        bodies.extend(segment.spans.iter().map(Body::span));
        bodies.extend(segment.rings.iter().map(Body::ring));
    }
    let mut begin = 0.0;
    for body in &mut bodies {
        body.begin = begin;
        begin += body.length;
    }
    bodies
}

impl Body {
    fn ring(ring: &Ring) -> Self {
        Self {
            kind: "ring",
            begin: 0.0,
            length: ring.length,
            inner_radius: ring.inner_radius,
            outer_radius: ring.outer_radius,
            remanence: ring.remanence,
            spiral: None,
            boundary_angle: None,
        }
    }

    fn span(span: &Span) -> Self {
        Self {
            kind: match span.kind {
                SpanKind::Disc => "disc",
                SpanKind::Core => "core",
                SpanKind::Rod | SpanKind::Section => "rod",
            },
            begin: 0.0,
            length: span.length,
            inner_radius: span.inner_radius,
            outer_radius: span.outer_radius,
            remanence: VACUUM_PERMEABILITY * span.magnetisation,
            spiral: span.spiral.map(|spiral| Spiral {
                inner_radius: spiral.inner_radius,
                outer_radius: spiral.outer_radius,
                sector_angle: spiral.sector_angle,
                windings: spiral.windings,
                turn: match spiral.kind {
                    SectorKind::RightHanded => 1,
                    SectorKind::LeftHanded => -1,
                    SectorKind::Axisymmetric => 0,
                },
                start: spiral.start,
            }),
            boundary_angle: span.spiral.map(|spiral| spiral.boundary_angle),
        }
    }
}

impl Course {
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a count between 2 and the most"
    )]
    fn of(branch: &Branch) -> Self {
        let (from, to) = branch.range().into_inner();
        let count = ((to - from) / BALL_SPACING).ceil().clamp(2.0, MOST_BALLS) as usize;
        let balls = (0..=count).flat_map(|number| {
            let (centre, radius) = branch.ball(from + (to - from) * number as f64 / count as f64);
            [centre.x, centre.y, centre.z, radius]
        });
        Self { name: branch.name().into(), balls: balls.collect() }
    }
}

//! The paper's force experiment: the magnet pair, and devices held straight in a rigid holder.

use nalgebra::Vector3;

use crate::constants::VACUUM_PERMEABILITY;
use crate::design::{Cylinder, CylinderMaterial, Design, Helix, Ring, Span, Specification, Spiral};
use crate::error::Error;
use crate::geometry::Pose;
use crate::magnetics::{AxialMagnet, AxialSource, Cylinders, Source};
use crate::numerics::quadrature::gauss_legendre;

/// Radius of the external magnets, m.
const MAGNET_RADIUS: f64 = 22.5e-3;

/// Distance from the surface of the magnets to the axis of the device, m.
pub(super) const DISTANCE: f64 = 40e-3;

/// Number of segments of the measured device.
pub(super) const SEGMENTS: usize = 9;

/// Relative accuracy requested for the force on an annulus.
const ACCURACY: f64 = 1e-8;

/// Numbers of Gauss nodes over a spiral's length, its squared radius and its sector. More than 20 of its radii from the
/// magnets' axis the field is nearly a polynomial of low degree; most nodes are needed for two windings.
const SPIRAL_NODES: [usize; 3] = [16, 3, 6];

/// The external magnet: two N45 cylinders of 45 mm by 30 mm with a gap of 10 mm, on a common axis.
pub(super) fn magnet_pair() -> Result<Source, Error> {
    let magnet = |offset| AxialMagnet {
        radius: MAGNET_RADIUS,
        inner_radius: 0.0,
        length: 30e-3,
        offset,
        remanence: 1.35,
    };
    Ok(Cylinders::new(vec![magnet(-20e-3), magnet(20e-3)])?.into())
}

/// The magnetic polymer cylinder of the same length and diameter as the device, volume fraction 0.2.
pub(super) fn solid_cylinder(length: f64) -> Result<Design, Error> {
    let helix = Helix::paper();
    Design::new(Specification::Cylinder(Cylinder {
        length,
        radius: helix.radius,
        inner_radius: 0.0,
        material: CylinderMaterial::Composite {
            shore_a: helix.shore_a,
            poisson: helix.poisson,
            volume_fraction: 0.2,
            particle_remanence: helix.particle_remanence,
        },
        density: None,
    }))
}

/// Distance (m) of the magnets' axis from a point at `distance` (m) from their surface.
pub(super) fn axis_distance(distance: f64) -> f64 {
    MAGNET_RADIUS + distance
}

/// Force (N) of the magnet on a device held straight, in the device's axes.
///
/// The device lies along `z` with its middle at the origin. The centre of the magnet is at `(0, -distance, offset)` (m)
/// and its axis points along `-z`, so that its field beside it points along the device's magnetisation and attracts.
pub(super) fn held_force(
    design: &Design,
    magnet: &Source,
    distance: f64,
    offset: f64,
) -> Result<Vector3<f64>, Error> {
    // A half turn about x takes the device's axes to the magnet's.
    let turn = Pose::new([0.0; 3], [0.0, 1.0, 0.0, 0.0])?.rotation;
    let mut base = Pose {
        position: turn * (Vector3::new(0.0, distance, -offset) - Vector3::z() * (0.5 * design.length())),
        rotation: turn,
    };
    let mut force = Vector3::zeros();
    for ring in design.base_rings() {
        force += force_on_ring(magnet, ring, &mut base)?;
    }
    for segment in design.segments() {
        for span in &segment.spans {
            if let Some(spiral) = &span.spiral {
                force += force_on_spiral(magnet, span, spiral, &base)?;
            }
            let remanence = span.magnetisation * VACUUM_PERMEABILITY;
            let body = AxialSource::new(span.inner_radius, span.outer_radius, span.length, remanence)?;
            force += force_on(magnet, &body, &mut base)?;
        }
        for ring in &segment.rings {
            force += force_on_ring(magnet, ring, &mut base)?;
        }
    }
    Ok(turn.transpose() * force)
}

fn force_on_ring(magnet: &Source, ring: &Ring, base: &mut Pose) -> Result<Vector3<f64>, Error> {
    let body = AxialSource::new(ring.inner_radius, ring.outer_radius, ring.length, ring.remanence)?;
    force_on(magnet, &body, base)
}

/// Force (N) on a body whose first face is at `base`; advances `base` to its other face.
fn force_on(magnet: &Source, body: &AxialSource, base: &mut Pose) -> Result<Vector3<f64>, Error> {
    let wrench = magnet.wrench_on(body, &base.advanced(0.5 * body.length()), ACCURACY)?;
    *base = base.advanced(body.length());
    Ok(wrench.force)
}

/// Force on a spiral whose span begins at `base`: the volume integral of `M grad(B d3)`.
fn force_on_spiral(
    magnet: &Source,
    span: &Span,
    spiral: &Spiral,
    base: &Pose,
) -> Result<Vector3<f64>, Error> {
    let axis = base.axis();
    let [along, across, around] = SPIRAL_NODES.map(gauss_legendre);
    let squares = [spiral.inner_radius.powi(2), spiral.outer_radius.powi(2)];
    let mut force = Vector3::zeros();
    for (s, length) in between(&along, [0.0, span.length]) {
        for (square, area) in between(&across, squares) {
            for (angle, sector) in between(&around, spiral.sector(s, span.length)) {
                let arm = Vector3::new(angle.cos(), angle.sin(), 0.0) * square.sqrt();
                let point = base.position + axis * s + base.rotation * arm;
                let (_, gradient) = magnet.field_gradient(&point)?;
                force += gradient * axis * (span.magnetisation * length * 0.5 * area * sector);
            }
        }
    }
    Ok(force)
}

/// Nodes and weights of a quadrature rule on `[-1, 1]`, mapped to an interval.
fn between(
    (nodes, weights): &(Vec<f64>, Vec<f64>),
    [from, to]: [f64; 2],
) -> impl Iterator<Item = (f64, f64)> + '_ {
    let half = 0.5 * (to - from);
    nodes.iter().zip(weights).map(move |(node, weight)| (from + half * (1.0 + node), half * weight))
}

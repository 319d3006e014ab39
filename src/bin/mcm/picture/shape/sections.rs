//! Outlines of the bodies of a device: rods of each elastic part, and the rigid bodies.

use mcm::design::{Design, RigidShape, Ring, SpanKind};
use mcm::geometry::Pose;
use mcm::manipulator::Outputs;
use mcm::nalgebra::{Matrix3, Vector3};

use super::outline::{Outline, of_cylinder, of_rod};
use super::view::View;

/// Outlines of the elastic parts of a device behind `inserted` (m) of shaft: those of bodies and those of what they surround.
pub(super) fn of_elastic(
    view: &View,
    design: &Design,
    outputs: &Outputs,
    inserted: f64,
) -> (Vec<Outline>, Vec<Outline>) {
    let cores = || design.segments().iter().flat_map(|segment| &segment.spans);
    // Spirals and discs are seen as one rod around the cores.
    if let Some(core) = cores().find(|span| span.kind == SpanKind::Core) {
        let whole = between(outputs, inserted, f64::INFINITY);
        let rod = |radius: f64| vec![of_rod(view, &whole, [radius; 2])];
        return (rod(design.largest_radius()), rod(core.outer_radius));
    }

    let mut start = inserted + design.base_rings().iter().map(|ring| ring.length).sum::<f64>();
    let mut rods = Vec::new();
    for segment in design.segments() {
        for span in &segment.spans {
            let radii = [0.0, span.length].map(|s| span.radii_at(s)[1]);
            rods.push(of_rod(view, &between(outputs, start, start + span.length), radii));
            start += span.length;
        }
        start += segment.rings.iter().map(|ring| ring.length).sum::<f64>();
    }
    (rods, Vec::new())
}

/// Outlines of the rigid bodies of a device at these poses of their centres.
pub(super) fn of_rigid(view: &View, design: &Design, poses: &[Pose]) -> Vec<Outline> {
    let body = |(ring, pose): (&Ring, &Pose)| match ring.shape {
        RigidShape::Tube => {
            let half = 0.5 * ring.length;
            of_cylinder(view, pose, [-half, half], ring.outer_radius)
        }
        RigidShape::Ball => {
            // Seen from any side it is a circle.
            let towards = view.towards;
            let across = towards.cross(&pose.axis()).try_normalize(1e-9).unwrap_or_else(Vector3::x);
            let facing = Matrix3::from_columns(&[across, towards.cross(&across), towards]);
            of_cylinder(view, &Pose { rotation: facing, ..*pose }, [0.0; 2], ring.outer_radius)
        }
    };
    design.rings().zip(poses).map(body).collect()
}

/// Places of the centreline between two arc lengths (m), the ends interpolated.
fn between(outputs: &Outputs, from: f64, to: f64) -> Vec<Vector3<f64>> {
    let (arcs, shape) = (&outputs.shape_arc_length, &outputs.shape);
    let at = |s: f64| {
        let next = arcs.iter().position(|own| *own >= s).unwrap_or(arcs.len() - 1).max(1);
        let share = (s - arcs[next - 1]) / (arcs[next] - arcs[next - 1]);
        shape[next - 1] + (shape[next] - shape[next - 1]) * share.clamp(0.0, 1.0)
    };
    let inside = arcs.iter().zip(shape).filter(|(s, _)| from < **s && **s < to);
    let mut out = vec![at(from)];
    out.extend(inside.map(|(_, point)| *point));
    out.push(at(to.min(arcs[arcs.len() - 1])));
    out
}

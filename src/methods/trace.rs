//! A solved shape as poses and strains along the arc length, independent of the method; the outputs are evaluated from it.

use nalgebra::{Matrix3, Vector3, Vector6};

use super::line::{Line, MaterialPoint};
use super::strong_form::Rates;
use super::surroundings::Surroundings;
use crate::equilibrium::{Frame, TermWrenches};
use crate::geometry::{Pose, RotationVector, rotation_log};
use crate::numerics::quadrature::gauss_legendre;
use crate::rod::{Order, SectionMaterial};

/// Gauss points per link for the quadrature of loads and energies.
const LINK_POINTS: usize = 3;

/// Distance from a joint, relative to the length of the device, up to which a point counts as at the joint.
const AT_JOINT: f64 = 1e-10;

/// A part of the centreline between two places with known position, rotation and rates.
///
/// Interpolated by cubics (Hermite) in position and rotation vector.
#[derive(Debug, Clone)]
struct Link {
    /// Its start on the chain; `None` on a rigid part.
    place: Option<MaterialPoint>,
    /// Unstrained arc length from the base to its start, and its length, m.
    from: f64,
    length: f64,
    start: Pose,
    /// Displacement from start to end, m, and rotation vector.
    whole: [Vector3<f64>; 2],
    /// Rates of both with respect to arc length at start and end, times the length.
    rates: [[Vector3<f64>; 2]; 2],
}

/// All links from base to tip.
#[derive(Debug, Clone, Default)]
pub(super) struct Trace {
    links: Vec<Link>,
}

/// External wrenches on the spans, and their energy (J).
#[derive(Debug, Clone, Copy)]
pub(super) struct Totals {
    pub(super) wrenches: TermWrenches,
    pub(super) energy: f64,
}

/// Value and slope of the cubic from `0` to `whole` with end slopes `rates`.
fn cubic(whole: &Vector3<f64>, rates: [&Vector3<f64>; 2], x: f64) -> [Vector3<f64>; 2] {
    let (square, cube) = (x * x, x * x * x);
    let value = whole * (3.0 * square - 2.0 * cube)
        + rates[0] * (x - 2.0 * square + cube)
        + rates[1] * (cube - square);
    let slope = whole * (6.0 * (x - square))
        + rates[0] * (1.0 - 4.0 * x + 3.0 * square)
        + rates[1] * (3.0 * square - 2.0 * x);
    [value, slope]
}

impl Link {
    /// Pose at the fraction `x` of the link, with the derivatives of position and rotation (fixed axes) with respect to `x`.
    fn at(&self, x: f64) -> (Pose, Vector3<f64>, Vector3<f64>) {
        let component = |c: usize| cubic(&self.whole[c], [&self.rates[0][c], &self.rates[1][c]], x);
        let ([position, tangent], [theta, rate]) = (component(0), component(1));
        let theta = RotationVector::new(theta);
        let pose =
            Pose { position: self.start.position + position, rotation: theta.matrix() * self.start.rotation };
        (pose, tangent, theta.left_jacobian() * rate)
    }
}

impl Trace {
    /// The straight shape at the origin and its nodes.
    pub(super) fn straight(line: &Line) -> (Self, Vec<Pose>) {
        let mut trace = Self::default();
        let mut nodes = vec![Pose::identity()];
        for (element, spans) in line.spans.iter().enumerate() {
            let offset = line.chain.elements[element].offset;
            trace.add_rigid(offset, &nodes[element]);
            let mut pose = nodes[element].advanced(offset);
            for (piece, span) in spans.iter().enumerate() {
                let end = pose.advanced(span.length);
                let rates =
                    Rates { tangent: pose.axis(), turning: Vector3::zeros(), wrench: Vector6::zeros() };
                trace.add(&MaterialPoint { element, piece, s: 0.0 }, span.length, [&pose, &end], &[rates; 2]);
                pose = end;
            }
            nodes.push(pose);
        }
        trace.add_rigid(line.chain.tip_offset, &nodes[line.count()]);
        (trace, nodes)
    }

    /// Unstrained length of all links so far, m.
    fn length(&self) -> f64 {
        self.links.last().map_or(0.0, |link| link.from + link.length)
    }

    /// Appends a link on a span.
    pub(super) fn add(&mut self, place: &MaterialPoint, length: f64, ends: [&Pose; 2], rates: &[Rates; 2]) {
        let turn = rotation_log(&(ends[1].rotation * ends[0].rotation.transpose()));
        let inverse = RotationVector::new(turn).left_jacobian_inverse().unwrap_or_default();
        let rate = |side: usize| rates[side].turning * length;
        self.links.push(Link {
            place: Some(*place),
            from: self.length(),
            length,
            start: *ends[0],
            whole: [ends[1].position - ends[0].position, turn],
            rates: [[rates[0].tangent * length, rate(0)], [rates[1].tangent * length, inverse * rate(1)]],
        });
    }

    /// Appends a rigid part.
    pub(super) fn add_rigid(&mut self, length: f64, start: &Pose) {
        let along = start.axis() * length;
        let rates = [along, Vector3::zeros()];
        self.links.push(Link {
            place: None,
            from: self.length(),
            length,
            start: *start,
            whole: rates,
            rates: [rates, rates],
        });
    }

    /// Pose at unstrained arc length `s` from the base.
    pub(super) fn pose(&self, s: f64) -> Pose {
        let after = self.links.partition_point(|link| link.from <= s);
        let Some(link) = self.links.get(after.saturating_sub(1)) else { return Pose::identity() };
        let x = if link.length > 0.0 { (s - link.from) / link.length } else { 0.0 };
        link.at(x.clamp(0.0, 1.0)).0
    }

    /// Directors and curvature (1/m, material frame) at unstrained arc length `s` from the base; at a joint those of the part towards
    /// the tip.
    pub(super) fn strain(&self, s: f64) -> (Matrix3<f64>, Vector3<f64>) {
        let slack = AT_JOINT * self.length();
        let begun = |link: &&Link| link.from <= s + slack && link.length > slack;
        let Some(link) = self.links.iter().rfind(begun) else {
            return (Matrix3::identity(), Vector3::zeros());
        };
        let x = (s - link.from) / link.length;
        let (pose, _, turning) = link.at(x.clamp(0.0, 1.0));
        (pose.rotation, pose.rotation.tr_mul(&turning) / link.length)
    }

    /// Bending angle of each core, or of each segment without one.
    pub(super) fn core_angles(&self, line: &Line) -> Vec<f64> {
        let axis = |link: Option<&Link>, x: f64| link.map_or(Vector3::z(), |link| link.at(x).0.axis());
        let on = |link: &&Link, element: usize| {
            link.place.is_some_and(|place| place.element == element && place.piece == line.core(element))
        };
        let angle = |&(first, last): &(usize, usize)| {
            let start = axis(self.links.iter().find(|link| on(link, first)), 0.0);
            start.angle(&axis(self.links.iter().rfind(|link| on(link, last)), 1.0))
        };
        line.chain.cores.iter().map(angle).collect()
    }

    /// Energy of touching windings, J.
    fn stop_energy(&self, around: &Surroundings<'_>) -> f64 {
        let chain = &around.line.chain;
        let energy = |((element, _), angle): (&(usize, usize), f64)| {
            let stop = around.terms.stops.of(&chain.elements[*element]);
            stop.and_then(|stop| stop.energy(angle)).map_or(0.0, |[energy, ..]| energy)
        };
        chain.cores.iter().zip(self.core_angles(around.line)).map(energy).sum()
    }

    /// External wrenches on the spans and all energy of the spans, integrated along the shape.
    pub(super) fn totals(&self, around: &Surroundings<'_>) -> Option<Totals> {
        let (points, weights) = gauss_legendre(LINK_POINTS);
        let mut out = Totals { wrenches: TermWrenches::none(), energy: self.stop_energy(around) };
        for (link, from) in self.links.iter().filter_map(|link| Some((link, link.place?))) {
            let span = &around.line.spans[from.element][from.piece];

            for (point, weight) in points.iter().zip(&weights) {
                let x = 0.5 * (1.0 + point);
                let weight = 0.5 * weight * link.length;
                let place = MaterialPoint { s: from.s + x * link.length, ..from };
                let (pose, tangent, turning) = link.at(x);

                // Strains in the material frame: rates along the unstrained arc length.
                let stretch = pose.rotation.tr_mul(&tangent) / link.length - Vector3::z();
                let curvature = pose.rotation.tr_mul(&turning) / link.length;

                let k = &span.stiffness;
                let bent = Vector3::new(k.bending, k.bending, k.torsion).component_mul(&curvature);
                let sheared = Vector3::new(k.shear, k.shear, k.axial).component_mul(&stretch);
                let stored = 0.5 * (bent.dot(&curvature) + sheared.dot(&stretch));

                let (material, mut wrenches) =
                    (SectionMaterial::section(span, place.s), TermWrenches::none());
                let load = around.on(&Frame::Section(&material), &pose, Order::Gradient, &mut wrenches)?;
                out.energy += weight * (stored + load.energy);
                out.wrenches.add(&wrenches, weight);
            }
        }
        Some(out)
    }
}

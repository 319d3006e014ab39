//! Piecewise constant curvature: each core is an arc, all else is rigid, without torsion, shear or extension.
//!
//! Each element has two angles. Their balance, stiffness times angle against the moment of all loads that the arc carries, is
//! the gradient of the energy where one exists; its derivative is exact.
//!
//! Source: Webster and Jones, Int. J. Robot. Res. 29, 2010, doi:10.1177/0278364910368147 (kinematics).

use nalgebra::{DMatrix, DVector, Dyn, LU, Matrix2, Matrix3, Matrix6, Vector2, Vector3, Vector6};

use super::arc::{Arc, Bent};
use super::line::{Line, MaterialPoint};
use super::shape::Shape;
use super::strong_form::Rates;
use super::surroundings::{Surroundings, column, derivative, gradient};
use super::trace::Trace;
use crate::geometry::Pose;
use crate::numerics::levenberg_marquardt::Ending;
use crate::numerics::newton::{self, Equations};
use crate::rod::Order;

/// Number of links per arc in the traced shape.
const LINKS: usize = 8;

/// The angles of the last solved shape, about `d1` and `d2` of each element.
#[derive(Debug, Clone)]
pub(super) struct Arcs {
    arcs: Vec<Arc>,
    angles: Vec<Vector2<f64>>,
}

/// A loaded body and what it moves with: all arcs before `carriers`, and possibly a part of the next one.
struct Body {
    carriers: usize,
    part: Option<Bent>,
    position: Vector3<f64>,
    gradient: Vector6<f64>,
    own: Matrix6<f64>,
}

/// The balance of one scene.
struct Balance<'a, 'b> {
    around: &'a Surroundings<'b>,
    arcs: &'a [Arc],
    residual: DVector<f64>,
    factors: Option<LU<f64, Dyn, Dyn>>,
}

/// Poses of the nodes, and the bent arcs between them.
fn place(arcs: &[Arc], angles: &[Vector2<f64>], base: &Pose) -> (Vec<Pose>, Vec<Bent>) {
    let (mut nodes, mut bent) = (vec![*base], Vec::new());
    for (k, (arc, angles)) in arcs.iter().zip(angles).enumerate() {
        let whole = arc.bent(&nodes[k].advanced(arc.before), angles, 1.0);
        nodes.push(whole.pose.advanced(arc.after));
        bent.push(whole);
    }
    (nodes, bent)
}

impl Arcs {
    pub(super) fn straight(line: &Line) -> Self {
        let arcs: Vec<Arc> = (0..line.count()).map(|element| Arc::new(line, element)).collect();
        Self { angles: vec![Vector2::zeros(); arcs.len()], arcs }
    }

    pub(super) fn solve(&mut self, around: &Surroundings<'_>, tolerance: f64, iterations: u32) -> Ending {
        let residual = DVector::zeros(2 * self.arcs.len());
        let mut balance = Balance { around, arcs: &self.arcs, residual, factors: None };
        let mut angles = self.angles.clone();
        let end = newton::solve(&mut balance, &mut angles, tolerance, iterations);
        if end.converged {
            self.angles = angles;
        }
        end
    }

    pub(super) fn shape(&self, around: &Surroundings<'_>) -> Option<Shape> {
        let base = around.inputs.base;
        let (nodes, _) = place(&self.arcs, &self.angles, &base);
        let mut trace = Trace::default();

        for (element, (arc, angles)) in self.arcs.iter().zip(&self.angles).enumerate() {
            let offset = around.line.chain.elements[element].offset;
            trace.add_rigid(offset, &nodes[element]);
            let mut pose = nodes[element].advanced(offset);

            for (piece, span) in around.line.spans[element].iter().enumerate() {
                let (start, bends) = (pose, piece == arc.core);
                let local = Vector3::new(angles.x, angles.y, 0.0) / arc.length;
                let turning = if bends { start.rotation * local } else { Vector3::zeros() };
                let links = if bends { LINKS } else { 1 };

                for link in 0..links {
                    let part = (link + 1) as f64 / links as f64;
                    let end =
                        if bends { arc.bent(&start, angles, part).pose } else { pose.advanced(span.length) };
                    let length = span.length / links as f64;
                    let rates = [&pose, &end].map(|at| Rates {
                        tangent: at.axis(),
                        turning,
                        wrench: Vector6::zeros(),
                    });
                    let at = MaterialPoint { element, piece, s: link as f64 * length };
                    trace.add(&at, length, [&pose, &end], &rates);
                    pose = end;
                }
            }
        }

        trace.add_rigid(around.line.chain.tip_offset, &nodes[self.arcs.len()]);
        let residual = DVector::zeros(0);
        let balance = Balance { around, arcs: &self.arcs, residual, factors: None };
        let (bodies, _, _, _) = balance.bodies(&self.angles, Order::Gradient)?;

        // All loads together, with their moments about the base.
        let total = bodies.iter().fold(Vector6::zeros(), |total, body| {
            let force = body.gradient.fixed_rows::<3>(0).into_owned();
            let moment = (body.position - base.position).cross(&force) + body.gradient.fixed_rows::<3>(3);
            total - column(&force, &moment)
        });

        Some(Shape { nodes, base: total, trace })
    }
}

/// Bodies, nodes (as indices of bodies), bent arcs and the couplings between nodes.
type Loaded = (Vec<Body>, Vec<usize>, Vec<Bent>, Vec<(usize, usize, Matrix6<f64>)>);

impl Balance<'_, '_> {
    /// All loaded bodies beyond the base node.
    fn bodies(&self, angles: &[Vector2<f64>], order: Order) -> Option<Loaded> {
        let (nodes, bent) = place(self.arcs, angles, &self.around.inputs.base);
        let (loads, totals) = self.around.nodes(&nodes, order)?;
        let (mut bodies, mut numbers, mut couplings) = (Vec::new(), Vec::new(), Vec::new());
        for (element, arc) in self.arcs.iter().enumerate() {
            let start = nodes[element].advanced(arc.before);
            let table = &self.around.line.chain.elements[element];
            for station in &table.stations {
                // Measured from the arc's start, which is a rigid length away from the element's start.
                let along = station.row.arc_length + table.offset - arc.before;
                let part = (0.0..=arc.length)
                    .contains(&along)
                    .then(|| arc.bent(&start, &angles[element], along / arc.length));
                let behind = usize::from(along > arc.length);
                let pose = match &part {
                    Some(part) => part.pose,
                    None if behind == 1 => bent[element].pose.advanced(along - arc.length),
                    None => start.advanced(along),
                };
                let load = self.around.external(&station.material, &pose, order)?;
                bodies.push(Body {
                    carriers: element + behind,
                    part,
                    position: pose.position,
                    gradient: gradient(&load),
                    own: derivative(&load),
                });
            }
            let node = element + 1;
            numbers.push(bodies.len());
            let position = nodes[node].position;
            let (gradient, own) = (totals[node], loads[node].own);
            bodies.push(Body { carriers: node, part: None, position, gradient, own });
        }
        for (node, load) in loads.iter().enumerate() {
            for pair in load.pairs.iter().filter(|pair| pair.node > 0) {
                couplings.push((node, pair.node, pair.by_first));
                couplings.push((pair.node, pair.node, pair.reaction_by[0]));
                couplings.push((pair.node, node, pair.reaction_by[1]));
            }
        }
        Some((bodies, numbers, bent, couplings))
    }

    /// Derivatives of a body's displacement and rotation with respect to every angle.
    fn columns(&self, body: &Body, bent: &[Bent]) -> DMatrix<f64> {
        let mut out = DMatrix::zeros(6, 2 * self.arcs.len());
        for (j, arc) in bent[..body.carriers].iter().enumerate() {
            let arm = body.position - arc.pose.position;
            for c in 0..2 {
                let moved = arc.moved[c] + arc.turned[c].cross(&arm);
                out.column_mut(2 * j + c).copy_from(&column(&moved, &arc.turned[c]));
            }
        }
        if let Some(part) = &body.part {
            for c in 0..2 {
                out.column_mut(2 * body.carriers + c).copy_from(&column(&part.moved[c], &part.turned[c]));
            }
        }
        out
    }

    /// Moment of an element's bending stop against its angles (N m), and its derivative.
    fn stop(&self, element: usize, angles: &Vector2<f64>) -> (Vector2<f64>, Matrix2<f64>) {
        let (bend, element) = (angles.norm(), &self.around.line.chain.elements[element]);
        let energy = self.around.terms.stops.of(element).and_then(|stop| stop.energy(bend));
        energy.map_or_else(Default::default, |[_, first, second]| {
            let (along, by_angle) = (angles / bend, first / bend);
            let outer = along * along.transpose();
            (along * first, Matrix2::identity() * by_angle + outer * (second - by_angle))
        })
    }

    /// The balance in units of moment; `columns` are the derivatives of all bodies, see [`Balance::columns`].
    fn balance(&self, angles: &[Vector2<f64>], bodies: &[Body], columns: &[DMatrix<f64>]) -> DVector<f64> {
        let mut out =
            DVector::from_fn(2 * self.arcs.len(), |i, _| self.arcs[i / 2].stiffness * angles[i / 2][i % 2]);
        for (element, angles) in angles.iter().enumerate() {
            let mut own = out.fixed_rows_mut::<2>(2 * element);
            own += self.stop(element, angles).0;
        }
        for (body, columns) in bodies.iter().zip(columns) {
            out += columns.tr_mul(&body.gradient);
        }
        out / self.around.line.moment
    }
}

/// Adds the geometric stiffness: derivatives of the bodies' displacement directions with respect to the angles, times the
/// loads.
fn geometric(out: &mut DMatrix<f64>, bodies: &[Body], bent: &[Bent]) {
    for (j, arc) in bent.iter().enumerate() {
        let (mut force, mut couple, mut arms) = (Vector3::zeros(), Vector3::zeros(), Matrix3::zeros());
        // Lever terms of this arc's own motion: of forces, and of couples.
        let mut levers = [[Vector3::zeros(); 2]; 2];
        for body in bodies {
            let pull: Vector3<f64> = body.gradient.fixed_rows::<3>(0).into_owned();
            let moment: Vector3<f64> = body.gradient.fixed_rows::<3>(3).into_owned();
            if body.carriers > j {
                force += pull;
                couple += moment;
                arms += (body.position - arc.pose.position) * pull.transpose();
            } else if let Some(part) = body.part.as_ref().filter(|_| body.carriers == j) {
                for c in 0..2 {
                    levers[0][c] += part.moved[c].cross(&pull);
                    levers[1][c] += part.turned[c].cross(&moment);
                    let bending = part.moved_derivative(&pull);
                    for d in 0..2 {
                        out[(2 * j + c, 2 * j + d)] +=
                            bending[(c, d)] + part.turned_derivative(c, d).dot(&moment);
                    }
                }
            }
        }
        let bending = arc.moved_derivative(&force);
        // Sum of (a x arm) x force, for a rotation a.
        let swung = |a: &Vector3<f64>| arms * a - a * arms.trace();
        for c in 0..2 {
            levers[0][c] += arc.moved[c].cross(&force) + swung(&arc.turned[c]);
            levers[1][c] += arc.turned[c].cross(&couple);
            for d in 0..2 {
                let turned = arc.turned_derivative(c, d);
                // Sum of (a x arm) . force, which is a . (sum of arm x force).
                let lever = Vector3::new(arms.m23 - arms.m32, arms.m31 - arms.m13, arms.m12 - arms.m21);
                out[(2 * j + c, 2 * j + d)] += bending[(c, d)]
                    + turned.dot(&(couple + lever))
                    + arc.turned[c].dot(&swung(&arc.turned[d]));
            }
            for (l, before) in bent[..j].iter().enumerate() {
                for d in 0..2 {
                    let by_force = before.turned[d].dot(&levers[0][c]);
                    out[(2 * j + c, 2 * l + d)] += by_force + before.turned[d].dot(&levers[1][c]);
                    out[(2 * l + d, 2 * j + c)] += by_force;
                }
            }
        }
    }
}

impl Equations for Balance<'_, '_> {
    type Point = Vec<Vector2<f64>>;

    fn evaluate(&mut self, at: &Self::Point) -> Option<f64> {
        let (bodies, _, bent, _) = self.bodies(at, Order::Gradient)?;
        let columns: Vec<_> = bodies.iter().map(|body| self.columns(body, &bent)).collect();
        self.residual = self.balance(at, &bodies, &columns);
        Some(self.residual.norm()).filter(|norm| norm.is_finite())
    }

    fn linearise(&mut self, at: &Self::Point) -> Option<f64> {
        let (bodies, numbers, bent, couplings) = self.bodies(at, Order::Hessian)?;
        let columns: Vec<_> = bodies.iter().map(|body| self.columns(body, &bent)).collect();
        self.residual = self.balance(at, &bodies, &columns);
        let size = self.residual.len();
        let mut matrix =
            DMatrix::from_fn(size, size, |i, j| if i == j { self.arcs[i / 2].stiffness } else { 0.0 });
        for (body, columns) in bodies.iter().zip(&columns) {
            matrix += columns.tr_mul(&(body.own * columns));
        }
        for (row, by, block) in &couplings {
            let [row, by] = [row, by].map(|node| &columns[numbers[node - 1]]);
            matrix += row.tr_mul(&(block * by));
        }
        for (element, angles) in at.iter().enumerate() {
            let mut own = matrix.fixed_view_mut::<2, 2>(2 * element, 2 * element);
            own += self.stop(element, angles).1;
        }
        geometric(&mut matrix, &bodies, &bent);
        self.factors = Some((matrix / self.around.line.moment).lu());
        Some(self.residual.norm()).filter(|norm| norm.is_finite())
    }

    fn correction(&mut self) -> Option<Vec<f64>> {
        let step = self.factors.as_ref()?.solve(&-&self.residual)?;
        Some(step.iter().copied().collect())
    }

    fn moved(&self, at: &Self::Point, step: &[f64], factor: f64) -> Self::Point {
        let turned = at.iter().zip(step.chunks_exact(2));
        turned.map(|(angles, part)| angles + Vector2::new(part[0], part[1]) * factor).collect()
    }
}

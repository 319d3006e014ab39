//! Planar reduction to three displacements per node, for loads and fields in one plane with the straight manipulator.
//!
//! With the coordinates `x1` across and `x2` along the base's axis, the angle `theta` of the tangent, forces `n1`, `n2` and the
//! moment `m` about the normal, `d = (sin theta, cos theta)` and `t = (cos theta, -sin theta)`:
//!
//! ```text
//! x' = d (1 + n.d / EA) + t (n.t / GA)    theta' = m / EI    n' = -f    m' = x1' n2 - x2' n1 - l
//! ```
//!
//! The spiral's material is averaged around the core: out-of-plane effects of its sector are neglected.

use nalgebra::{Matrix6, SMatrix, SVector, Vector3, Vector6};

use super::line::{MaterialPoint, SpanIndex};
use super::multiple_shooting::Crossing;
use super::node_shape::{Basis, NodeShape};
use super::node_system::Link;
use super::plane::Plane;
use super::runge_kutta::{NODES, WEIGHTS};
use super::strong_form::{Matrix12, Rates, State};
use super::surroundings::{Surroundings, column, derivative, gradient};
use super::trace::Trace;
use crate::geometry::{Pose, RotationVector};
use crate::rod::{Order, SectionMaterial};

/// Integration over elements in a plane.
pub(super) struct InPlane<'a, 'b> {
    around: &'a Surroundings<'b>,
    plane: Plane,
    axes: SMatrix<f64, 6, 3>,
    basis: Basis<3>,
    steps: usize,
}

/// Rates of the six coordinates, and their derivatives.
type Linear = (Vector6<f64>, Matrix6<f64>);

impl<'a, 'b> InPlane<'a, 'b> {
    pub(super) fn new(around: &'a Surroundings<'b>, plane: Plane, steps: usize) -> Self {
        let axes = plane.axes();
        Self { around, plane, basis: Basis::new(around.line, &axes), axes, steps }
    }

    fn coordinates(&self, state: &State) -> Vector6<f64> {
        let offset = state.pose.position - self.plane.base.position;
        let place = self.axes.tr_mul(&column(&offset, &Vector3::zeros()));
        let wrench = self.axes.tr_mul(&state.wrench);
        Vector6::new(
            place[0],
            place[1],
            self.plane.angle(&state.pose.axis()),
            wrench[0],
            wrench[1],
            wrench[2],
        )
    }

    fn state(&self, y: &Vector6<f64>) -> State {
        let place = self.axes * Vector3::new(y[0], y[1], 0.0);
        let position = self.plane.base.position + place.fixed_rows::<3>(0);
        State { pose: self.plane.pose(position, y[2]), wrench: self.axes * y.fixed_rows::<3>(3) }
    }

    fn rates(&self, place: &MaterialPoint, y: &Vector6<f64>, order: Order) -> Option<Linear> {
        let span = &self.around.line.spans[place.element][place.piece];
        let material = SectionMaterial::section(span, place.s).axisymmetric();
        let load = self.around.external(&material, &self.state(y).pose, order)?;

        let (sine, cosine) = y[2].sin_cos();
        let (d, t) = (SVector::<f64, 2>::new(sine, cosine), SVector::<f64, 2>::new(cosine, -sine));
        let n = SVector::<f64, 2>::new(y[3], y[4]);

        let k = &span.stiffness;
        let (along, across) = (n.dot(&d), n.dot(&t));
        let tangent = d * (1.0 + along / k.axial) + t * (across / k.shear);

        // n' = dU/dr and m' = n x r' + dU/d(angle); angles turn from the second axis to the first.
        let force = self.axes.tr_mul(&gradient(&load));
        let couple = tangent[0] * n[1] - tangent[1] * n[0] + force[2];
        let rates = Vector6::new(tangent[0], tangent[1], y[5] / k.bending, force[0], force[1], couple);

        let mut by = Matrix6::zeros();
        if order == Order::Gradient {
            return Some((rates, by));
        }

        // Both directions turn with the angle: d' = t, t' = -d.
        let by_angle = t * (1.0 + along * (1.0 / k.axial - 1.0 / k.shear))
            + d * (across * (1.0 / k.axial - 1.0 / k.shear));
        let by_force = d * d.transpose() / k.axial + t * t.transpose() / k.shear;
        by.fixed_view_mut::<2, 1>(0, 2).copy_from(&by_angle);
        by.fixed_view_mut::<2, 2>(0, 3).copy_from(&by_force);
        by[(2, 5)] = 1.0 / k.bending;
        by.fixed_view_mut::<3, 3>(3, 0).copy_from(&(self.axes.transpose() * derivative(&load) * self.axes));

        by[(5, 2)] += by_angle[0] * n[1] - by_angle[1] * n[0];
        by[(5, 3)] = by_force[(0, 0)] * n[1] - by_force[(1, 0)] * n[0] - tangent[1];
        by[(5, 4)] = by_force[(0, 1)] * n[1] - by_force[(1, 1)] * n[0] + tangent[0];

        Some((rates, by))
    }

    fn step(&self, place: &MaterialPoint, length: f64, start: &Vector6<f64>) -> Option<Vector6<f64>> {
        let (mut end, mut rate) = (*start, Vector6::zeros());
        for (node, weight) in NODES.iter().zip(WEIGHTS) {
            let at = MaterialPoint { s: place.s + node * length, ..*place };
            rate = self.rates(&at, &(start + rate * (node * length)), Order::Gradient)?.0;
            end += rate * (weight * length);
        }
        Some(end)
    }

    fn step_linear(&self, place: &MaterialPoint, length: f64, start: &Vector6<f64>) -> Option<Linear> {
        let (mut end, mut rate) = (*start, Vector6::zeros());
        let (mut by_start, mut columns) = (Matrix6::identity(), Matrix6::zeros());
        for (node, weight) in NODES.iter().zip(WEIGHTS) {
            let at = MaterialPoint { s: place.s + node * length, ..*place };
            let here = Matrix6::identity() + columns * (node * length);
            let (next, by) = self.rates(&at, &(start + rate * (node * length)), Order::Hessian)?;
            (rate, columns) = (next, by * here);
            end += rate * (weight * length);
            by_start += columns * (weight * length);
        }
        Some((end, by_start))
    }

    /// Integrates a state along one span, with the derivative with respect to displacement and wrench in the plane.
    fn span(&self, element: usize, piece: usize, state: &State) -> Option<(State, Matrix12)> {
        let (mut y, mut own) = (self.coordinates(state), Matrix6::identity());
        let (count, length) = self.around.steps(element, piece, self.steps);
        for index in 0..count {
            let place = MaterialPoint { element, piece, s: index as f64 * length };
            let (next, by_start) = self.step_linear(&place, length, &y)?;
            (y, own) = (next, by_start * own);
        }
        let mut whole = Matrix12::zeros();
        for (i, j) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
            let block = self.axes * own.fixed_view::<3, 3>(3 * i, 3 * j) * self.axes.transpose();
            whole.fixed_view_mut::<6, 6>(6 * i, 6 * j).copy_from(&block);
        }
        Some((self.state(&y), whole))
    }

    /// The rates in the form of those of a rod in space.
    fn spatial(&self, place: &MaterialPoint, y: &Vector6<f64>) -> Option<Rates> {
        let (rates, _) = self.rates(place, y, Order::Gradient)?;
        let pose = self.axes * rates.fixed_rows::<3>(0);
        let (tangent, turning) = (pose.fixed_rows::<3>(0).into_owned(), pose.fixed_rows::<3>(3).into_owned());
        Some(Rates { tangent, turning, wrench: self.axes * rates.fixed_rows::<3>(3) })
    }
}

impl Crossing<3> for InPlane<'_, '_> {
    fn basis(&self) -> &Basis<3> {
        &self.basis
    }

    fn cross(&self, element: usize, state: &State, mut trace: Option<&mut Trace>) -> Option<State> {
        let mut y = self.coordinates(&self.around.offset(element, state, trace.as_deref_mut()));
        for piece in 0..self.around.line.spans[element].len() {
            let (count, length) = self.around.steps(element, piece, self.steps);
            let relief = self.around.relief(SpanIndex { element, piece }, &self.state(&y), |state| {
                self.span(element, piece, state)
            })?;
            let carried = self.plane.normal.dot(&relief);
            y[5] -= carried;
            for index in 0..count {
                let place = MaterialPoint { element, piece, s: index as f64 * length };
                let next = self.step(&place, length, &y)?;
                if let Some(trace) = trace.as_deref_mut() {
                    let end = MaterialPoint { s: place.s + length, ..place };
                    let rates = [self.spatial(&place, &y)?, self.spatial(&end, &next)?];
                    trace.add(&place, length, [&self.state(&y).pose, &self.state(&next).pose], &rates);
                }
                y = next;
            }
            y[5] += carried;
        }
        y.iter().all(|entry| entry.is_finite()).then(|| self.state(&y))
    }

    fn cross_linear(&self, element: usize, state: &State) -> Option<(State, Link<3>)> {
        let mut own = state.advance_derivative(self.around.line.chain.elements[element].offset);
        let mut state = self.around.offset(element, state, None);
        for piece in 0..self.around.line.spans[element].len() {
            let across = |state: &State| self.span(element, piece, state);
            let span = self.around.crossed(SpanIndex { element, piece }, &state, across)?;
            (state, own) = (span.end, span.own * own);
        }
        state.is_finite().then(|| (state, self.basis.link(&own)))
    }
}

impl Plane {
    /// Pose in the plane with its tangent at this angle.
    fn pose(&self, position: Vector3<f64>, angle: f64) -> Pose {
        let turn = RotationVector::new(self.normal * angle);
        Pose { position, rotation: turn.matrix() * self.base.rotation }
    }

    /// Angle of a tangent in the plane, rad.
    fn angle(&self, tangent: &Vector3<f64>) -> f64 {
        tangent.dot(&self.across).atan2(tangent.dot(&self.base.axis()))
    }

    /// Unit displacements across and along the base's axis, and the rotation about the normal.
    fn axes(&self) -> SMatrix<f64, 6, 3> {
        let zero = Vector3::zeros();
        SMatrix::from_columns(&[
            column(&self.across, &zero),
            column(&self.base.axis(), &zero),
            column(&zero, &self.normal),
        ])
    }

    /// Rotates a shape bent in a plane through its base into this plane, by the smaller of the two rotations.
    pub(super) fn carried(&self, shape: &NodeShape) -> NodeShape {
        let moved = shape.carried(&self.base);
        let axis = self.base.axis();

        let across = |p: &Vector3<f64>| p - axis * p.dot(&axis);
        let aside = moved.nodes.iter().map(|node| across(&(node.position - self.base.position)));
        let bent = aside.fold(Vector3::zeros(), |a, b| if b.norm() > a.norm() { b } else { a });
        let old = bent.try_normalize(f64::MIN_POSITIVE).unwrap_or(self.across);
        let new = if old.dot(&self.across) < 0.0 { -self.across } else { self.across };

        let (old_normal, new_normal) = (axis.cross(&old), axis.cross(&new));
        let turned =
            |v: &Vector3<f64>| axis * v.dot(&axis) + new * v.dot(&old) + new_normal * v.dot(&old_normal);
        let in_plane = |v: &Vector3<f64>| v - self.normal * v.dot(&self.normal);

        let mut out = moved;
        for node in &mut out.nodes[1..] {
            let angle = self.angle(&turned(&node.axis()));
            let offset = in_plane(&turned(&(node.position - self.base.position)));
            *node = self.pose(self.base.position + offset, angle);
        }

        for wrench in &mut out.wrenches {
            let force = in_plane(&turned(&wrench.fixed_rows::<3>(0).into_owned()));
            let moment = turned(&wrench.fixed_rows::<3>(3).into_owned());
            *wrench = column(&force, &(self.normal * self.normal.dot(&moment)));
        }

        out
    }
}

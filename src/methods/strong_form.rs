//! The static Cosserat rod as differential equations, with their exact derivatives.
//!
//! With position `p`, rotation `R`, internal force `n` and moment `m` (exerted by the distal on the proximal part), all in
//! fixed axes, force `f` and couple `l` per length, stretch `v` and curvature `u` in the directors:
//!
//! ```text
//! p' = R v      R' = hat(w) R,  w = R u      n' = -f      m' = -p' x n - l
//! v = e3 + K_se^-1 R^T n                     u = K_bt^-1 R^T m
//! ```
//!
//! Rotations are integrated as rotation vectors `theta` relative to the start of an interval, `R = exp(theta) R_start`,
//! `J_l(theta) theta' = w`, so that every `R` is a rotation (Munthe-Kaas, BIT 38, 1998, doi:10.1007/BF02510919).
//!
//! Source: Antman, Nonlinear Problems of Elasticity, ch. 8; Richter et al., Eq. 9 and 10.

use nalgebra::{Matrix3, SMatrix, SVector, Vector3, Vector6};

use super::line::MaterialPoint;
use super::surroundings::{Surroundings, column, derivative};
use crate::design::Stiffness;
use crate::geometry::{Pose, RotationVector, hat};
use crate::rod::{Load, Order};

/// Position, rotation (vector), force and moment, three each.
pub(super) type Vector12 = SVector<f64, 12>;

/// A linear map between such vectors.
pub(super) type Matrix12 = SMatrix<f64, 12, 12>;

/// State of the rod at a cross section, the initial value for the rest of the chain.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct State {
    pub(super) pose: Pose,
    /// Internal force and moment.
    pub(super) wrench: Vector6<f64>,
}

/// Derivatives of a state with respect to arc length.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rates {
    /// Derivative of the position, `p'`.
    pub(super) tangent: Vector3<f64>,
    /// Rate of rotation `w`, 1/m.
    pub(super) turning: Vector3<f64>,
    /// Derivatives of force and moment.
    pub(super) wrench: Vector6<f64>,
}

impl State {
    pub(super) fn force(&self) -> Vector3<f64> {
        self.wrench.fixed_rows::<3>(0).into_owned()
    }

    pub(super) fn moment(&self) -> Vector3<f64> {
        self.wrench.fixed_rows::<3>(3).into_owned()
    }

    /// The state displaced in the local coordinates of an interval that starts here.
    pub(super) fn displaced(&self, local: &Vector12) -> Self {
        let turned = RotationVector::new(local.fixed_rows::<3>(3).into_owned()).matrix();
        let position = self.pose.position + local.fixed_rows::<3>(0);
        Self {
            pose: Pose { position, rotation: turned * self.pose.rotation },
            wrench: self.wrench + local.fixed_rows::<6>(6),
        }
    }

    /// The state at the distal end of a rigid part of length `distance`, m.
    pub(super) fn advanced(&self, distance: f64) -> Self {
        let moment = self.moment() - self.pose.axis().cross(&self.force()) * distance;
        Self { pose: self.pose.advanced(distance), wrench: column(&self.force(), &moment) }
    }

    /// Derivative of [`State::advanced`] with respect to displacement and wrench.
    pub(super) fn advance_derivative(&self, distance: f64) -> Matrix12 {
        let arm = hat(&(self.pose.axis() * distance));
        let mut out = Matrix12::identity();
        out.fixed_view_mut::<3, 3>(0, 3).copy_from(&-arm);
        out.fixed_view_mut::<3, 3>(9, 3).copy_from(&-(hat(&self.force()) * arm));
        out.fixed_view_mut::<3, 3>(9, 6).copy_from(&-arm);
        out
    }

    pub(super) fn is_finite(&self) -> bool {
        let pose = self.pose.position.iter().chain(self.pose.rotation.iter());
        pose.chain(self.wrench.iter()).all(|entry| entry.is_finite())
    }
}

/// Compliances `R K^-1 R^T` of a section in fixed axes.
struct Compliances {
    /// Strain by force, 1/N.
    force: Matrix3<f64>,
    /// Curvature by moment, 1/(N m2).
    moment: Matrix3<f64>,
}

fn compliances(rotation: &Matrix3<f64>, k: &Stiffness) -> Compliances {
    let turned = |across: f64, along: f64| {
        let axis = rotation.column(2);
        Matrix3::identity() * (1.0 / across) + axis * axis.transpose() * (1.0 / along - 1.0 / across)
    };
    Compliances { force: turned(k.shear, k.axial), moment: turned(k.bending, k.torsion) }
}

/// The right-hand sides of the rod equations for a load per length.
fn rates(state: &State, compliances: &Compliances, load: &Load) -> Rates {
    let force = state.force();
    let tangent = state.pose.axis() + compliances.force * force;
    let turning = compliances.moment * state.moment();
    let wrench = column(&load.force, &(load.moment() - tangent.cross(&force)));
    Rates { tangent, turning, wrench }
}

/// Derivative of the right-hand sides with respect to displacement (position, rotation) and wrench.
fn rates_derivative(state: &State, compliances: &Compliances, load: &Load, rates: &Rates) -> Matrix12 {
    let (force, moment) = (hat(&state.force()), hat(&state.moment()));
    let by_turn = compliances.force * force - hat(&rates.tangent);
    let mut out = Matrix12::zeros();
    out.fixed_view_mut::<3, 3>(0, 3).copy_from(&by_turn);
    out.fixed_view_mut::<3, 3>(0, 6).copy_from(&compliances.force);
    // Derivative of `w` itself; its rotation with the frame is part of the local coordinates' derivative.
    out.fixed_view_mut::<3, 3>(3, 3).copy_from(&(compliances.moment * moment - hat(&rates.turning)));
    out.fixed_view_mut::<3, 3>(3, 9).copy_from(&compliances.moment);
    let mut loads = out.fixed_view_mut::<6, 6>(6, 0);
    loads += derivative(load);
    let mut turn = out.fixed_view_mut::<3, 3>(9, 3);
    turn += force * by_turn;
    let by_force = force * compliances.force - hat(&rates.tangent);
    out.fixed_view_mut::<3, 3>(9, 6).copy_from(&by_force);
    out
}

/// The equations at a point inside an interval, in the interval's local coordinates.
#[derive(Debug, Clone)]
pub(super) struct Stage {
    /// Derivative of the local coordinates with respect to arc length, as given by the equations.
    pub(super) rate: Vector12,
    /// Derivative of that rate with respect to the local coordinates there.
    pub(super) by_local: Matrix12,
    /// Derivative of that rate with respect to a rotation of the interval's start.
    pub(super) by_start: SMatrix<f64, 12, 3>,
}

impl Surroundings<'_> {
    /// The rates of a state.
    pub(super) fn rates(&self, place: &MaterialPoint, state: &State) -> Option<Rates> {
        let load = self.along(place, &state.pose, Order::Gradient)?;
        let span = &self.line.spans[place.element][place.piece];
        Some(rates(state, &compliances(&state.pose.rotation, &span.stiffness), &load))
    }

    /// The rate of the local coordinates at `local` in an interval that starts at `start`.
    pub(super) fn local_rate(
        &self,
        place: &MaterialPoint,
        start: &State,
        local: &Vector12,
    ) -> Option<Vector12> {
        let rates = self.rates(place, &start.displaced(local))?;
        let theta = RotationVector::new(local.fixed_rows::<3>(3).into_owned());
        let rate = theta.left_jacobian_inverse()? * rates.turning;
        Some(assembled(&rates.tangent, &rate, &rates.wrench))
    }

    /// The rate of the local coordinates with its derivatives.
    pub(super) fn stage(&self, place: &MaterialPoint, start: &State, local: &Vector12) -> Option<Stage> {
        let state = start.displaced(local);
        let load = self.along(place, &state.pose, Order::Hessian)?;
        let span = &self.line.spans[place.element][place.piece];
        let compliances = compliances(&state.pose.rotation, &span.stiffness);
        let rates = rates(&state, &compliances, &load);
        let spatial = rates_derivative(&state, &compliances, &load, &rates);
        let theta = RotationVector::new(local.fixed_rows::<3>(3).into_owned());
        let left = theta.left_jacobian();
        let inverse = theta.left_jacobian_inverse()?;
        let rate = inverse * rates.turning;
        let by_turn = spatial.fixed_view::<12, 3>(0, 3).into_owned();
        let mut by_local = spatial;
        by_local.fixed_view_mut::<12, 3>(0, 3).copy_from(&(by_turn * left));
        let mut turning = by_local.fixed_view_mut::<3, 3>(3, 3);
        turning -= theta.left_product_derivative(&rate);
        let mut by_start = by_turn * theta.matrix();
        let rows = inverse * by_local.fixed_view::<3, 12>(3, 0);
        by_local.fixed_view_mut::<3, 12>(3, 0).copy_from(&rows);
        let rows = inverse * by_start.fixed_view::<3, 3>(3, 0);
        by_start.fixed_view_mut::<3, 3>(3, 0).copy_from(&rows);
        Some(Stage { rate: assembled(&rates.tangent, &rate, &rates.wrench), by_local, by_start })
    }
}

fn assembled(tangent: &Vector3<f64>, turning: &Vector3<f64>, wrench: &Vector6<f64>) -> Vector12 {
    let mut out = Vector12::zeros();
    out.fixed_rows_mut::<3>(0).copy_from(tangent);
    out.fixed_rows_mut::<3>(3).copy_from(turning);
    out.fixed_rows_mut::<6>(6).copy_from(wrench);
    out
}

/// Splits the columns of a state's change into local coordinates and the rotation of the interval's start.
///
/// The local rotation vector is zero at the start.
pub(super) fn split<const C: usize>(
    columns: &SMatrix<f64, 12, C>,
) -> (SMatrix<f64, 12, C>, SMatrix<f64, 3, C>) {
    let mut local = *columns;
    let turned = columns.fixed_view::<3, C>(3, 0).into_owned();
    local.fixed_view_mut::<3, C>(3, 0).fill(0.0);
    (local, turned)
}

/// Recombines both parts at the end of an interval, where the local coordinates are `end`.
pub(super) fn join<const C: usize>(
    end: &Vector12,
    local: &SMatrix<f64, 12, C>,
    turned: &SMatrix<f64, 3, C>,
) -> SMatrix<f64, 12, C> {
    let theta = RotationVector::new(end.fixed_rows::<3>(3).into_owned());
    let whole = theta.left_jacobian() * local.fixed_view::<3, C>(3, 0) + theta.matrix() * turned;
    let mut out = *local;
    out.fixed_view_mut::<3, C>(3, 0).copy_from(&whole);
    out
}

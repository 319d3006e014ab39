//! Potential energy of a load on a moving frame, to second order in the frame's displacement.

use nalgebra::{Matrix3, Vector3};

use crate::geometry::{axial, hat};

/// Potential energy of a load on a frame at `p` with directors `A`, and its derivatives in fixed axes.
///
/// The frame is displaced to `p + pi`, `exp(omega) A`. The derivatives with respect to position and directors are kept apart
/// from the second-order rotation of the directors, because the chain rule needs both.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Load {
    /// Potential energy, J.
    pub energy: f64,
    /// Derivative with respect to `p`: minus the force, N.
    pub force: Vector3<f64>,
    /// Derivative with respect to `A`, times the transpose of `A`, N m.
    pub couple: Matrix3<f64>,
    /// Second derivative with respect to the position, N/m.
    pub position_position: Matrix3<f64>,
    /// Mixed second derivative, for first-order changes of the directors only, N.
    pub position_rotation: Matrix3<f64>,
    /// Second derivative with respect to the rotation, for first-order changes of the directors only, N m.
    pub rotation_rotation: Matrix3<f64>,
    /// Whether any of the second derivatives is nonzero.
    pub stiff: bool,
}

impl Load {
    /// No load.
    #[must_use]
    pub fn zero() -> Self {
        Self {
            energy: 0.0,
            force: Vector3::zeros(),
            couple: Matrix3::zeros(),
            position_position: Matrix3::zeros(),
            position_rotation: Matrix3::zeros(),
            rotation_rotation: Matrix3::zeros(),
            stiff: false,
        }
    }

    /// A fixed force (N) at `arm` (m, fixed axes) from the frame's origin at `origin`.
    #[must_use]
    pub fn fixed_force(force: &Vector3<f64>, origin: &Vector3<f64>, arm: &Vector3<f64>) -> Self {
        Self {
            energy: -force.dot(&(origin + arm)),
            force: -force,
            couple: -force * arm.transpose(),
            ..Self::zero()
        }
    }

    /// Adds a magnetic charge (A m) at `arm` from the origin.
    ///
    /// `potential` (T m), `field` (T) and, for the second derivatives, `gradient` (T/m) are those at the charge.
    pub fn add_charge(
        &mut self,
        charge: f64,
        arm: &Vector3<f64>,
        (potential, field): (f64, &Vector3<f64>),
        gradient: Option<&Matrix3<f64>>,
    ) {
        let force = field * -charge;
        self.energy += charge * potential;
        self.force += force;
        self.couple += force * arm.transpose();
        let Some(gradient) = gradient else { return };
        let (own, lever) = (gradient * charge, hat(arm));
        self.position_position -= own;
        self.position_rotation += own * lever;
        self.rotation_rotation += lever * own * lever;
        self.stiff = true;
    }

    /// The load on another frame of the same rigid body, from whose origin it is `arm` (m) to that of this one.
    #[must_use]
    pub fn carried(&self, arm: &Vector3<f64>) -> Self {
        let lever = hat(arm);
        let cross = lever * self.position_rotation;
        Self {
            couple: self.couple + self.force * arm.transpose(),
            position_rotation: self.position_rotation - self.position_position * lever,
            rotation_rotation: self.rotation_rotation + cross + cross.transpose()
                - lever * self.position_position * lever,
            ..*self
        }
    }

    /// Derivative of the energy with respect to `omega`: minus the torque about `p`, N m.
    #[must_use]
    pub fn moment(&self) -> Vector3<f64> {
        axial(&self.couple)
    }

    /// Force and moment alone, without energy or second derivatives.
    ///
    /// For the interaction of a pair, whose own second derivatives include the second-order rotation.
    #[must_use]
    pub fn wrench_alone(&self) -> Self {
        Self { force: self.force, couple: (self.couple - self.couple.transpose()) * 0.5, ..Self::zero() }
    }

    /// Second derivative with respect to `omega`, including the second-order rotation of the directors, N m.
    #[must_use]
    pub fn rotation_hessian(&self) -> Matrix3<f64> {
        self.rotation_rotation + turning(&self.couple)
    }

    /// The load of so many times as much.
    #[must_use]
    pub fn times(self, factor: f64) -> Self {
        Self {
            energy: self.energy * factor,
            force: self.force * factor,
            couple: self.couple * factor,
            position_position: self.position_position * factor,
            position_rotation: self.position_rotation * factor,
            rotation_rotation: self.rotation_rotation * factor,
            stiff: self.stiff,
        }
    }

    /// The load in the axes given by the columns of `axes`.
    #[must_use]
    pub fn in_axes(&self, axes: &Matrix3<f64>) -> Self {
        let turn = |m: &Matrix3<f64>| axes.tr_mul(m) * axes;
        let mut out = Self { force: axes.tr_mul(&self.force), couple: turn(&self.couple), ..Self::zero() };
        out.energy = self.energy;
        out.stiff = self.stiff;
        if self.stiff {
            out.position_position = turn(&self.position_position);
            out.position_rotation = turn(&self.position_rotation);
            out.rotation_rotation = turn(&self.rotation_rotation);
        }
        out
    }

    /// Adds a dipole `moment axis` (A m2; `axis` is a unit vector that turns with the frame) at `arm` from the origin.
    ///
    /// `field`, its `gradient` and, for the second derivatives, `hessian_along = sum_i axis_i d2B_i/dx_j dx_k` are those at the
    /// dipole.
    pub fn add_dipole(
        &mut self,
        moment: f64,
        axis: &Vector3<f64>,
        arm: &Vector3<f64>,
        field: &Vector3<f64>,
        gradient: &Matrix3<f64>,
        hessian_along: Option<&Matrix3<f64>>,
    ) {
        let force = gradient * axis * -moment;
        self.energy -= moment * axis.dot(field);
        self.force += force;
        self.couple += force * arm.transpose() - field * (axis.transpose() * moment);
        let Some(hessian_along) = hessian_along else { return };
        let (turn, lever) = (hat(axis), hat(arm));
        let second = hessian_along * moment;
        let swing = gradient * turn * moment;
        let cross = turn * (gradient * lever) * moment;
        self.position_position -= second;
        self.position_rotation += swing + second * lever;
        self.rotation_rotation += cross + cross.transpose() + lever * second * lever;
        self.stiff = true;
    }
}

impl core::ops::AddAssign for Load {
    fn add_assign(&mut self, other: Self) {
        self.energy += other.energy;
        self.force += other.force;
        self.couple += other.couple;
        if other.stiff {
            self.position_position += other.position_position;
            self.position_rotation += other.position_rotation;
            self.rotation_rotation += other.rotation_rotation;
            self.stiff = true;
        }
    }
}

/// Second derivative of `N : exp(hat(omega))` at zero: the symmetric part of `N` minus its trace.
#[must_use]
pub fn turning(n: &Matrix3<f64>) -> Matrix3<f64> {
    let mut out = (n + n.transpose()) * 0.5;
    let trace = n.trace();
    for i in 0..3 {
        out[(i, i)] -= trace;
    }
    out
}

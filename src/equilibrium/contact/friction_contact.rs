//! Friction contact of the wall with one material place of the chain: a stick point in the wall, and the friction that pulls towards it.

use nalgebra::{Matrix3, Vector3};
use serde::{Deserialize, Serialize};

use crate::geometry::{Pose, hat};
use crate::rod::Load;
use crate::vessel::friction::{GIVE, smoothed};

/// A material place at which friction acts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub(crate) enum Place {
    /// A place of the shaft, by its distance behind the shaft's distal end, in spacings. It moves along the elements, which share
    /// the length inside.
    Shaft(usize),
    /// A place of another element: numbers of the element, its piece and the place on that.
    Skin(usize, usize, usize),
    /// A rim of a ring, by the ring's number: the proximal (0) or the distal one (1).
    Rim(usize, usize),
    /// The round end of a chain that ends without a ring.
    Tip,
}

/// Friction at one material place. Its normal force and the direction of that are those of an earlier shape.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) struct FrictionContact {
    pub(crate) place: Place,
    /// Where the touching point is without friction, m, world frame.
    pub(crate) stick_point: Vector3<f64>,
    /// From the frame's origin to the touching point, m, in the frame's directors.
    pub(crate) arm: Vector3<f64>,
    /// Unit normal of the wall, world axes.
    pub(crate) normal: Vector3<f64>,
    /// Normal force, N.
    pub(crate) force: f64,
}

impl FrictionContact {
    pub(crate) fn is_finite(&self) -> bool {
        let Self { stick_point, arm, normal, force, .. } = self;
        force.is_finite()
            && [stick_point, arm, normal].iter().all(|vector| vector.iter().all(|x| x.is_finite()))
    }

    fn point(&self, frame: &Pose) -> Vector3<f64> {
        frame.position + frame.rotation * self.arm
    }

    /// Displacement from the stick point along the wall, m.
    fn slip(&self, frame: &Pose) -> Vector3<f64> {
        let away = self.point(frame) - self.stick_point;
        away - self.normal * self.normal.dot(&away)
    }

    /// Potential of the friction on the frame of the place, and its stiffness (N/m), for this coefficient of friction.
    pub(crate) fn load(&self, frame: &Pose, coefficient: f64) -> (Load, f64) {
        let slip = self.slip(frame);
        let distance = slip.norm();
        let limit = coefficient * self.force;
        let [energy, secant, second] = smoothed(distance).map(|value| limit * value);
        let arm = frame.rotation * self.arm;
        let (force, lever) = (slip * secant, hat(&arm));
        let mut stiffness = (Matrix3::identity() - self.normal * self.normal.transpose()) * secant;
        if distance > 0.0 {
            stiffness += slip * slip.transpose() * ((second - secant) / (distance * distance));
        }
        let load = Load {
            energy,
            force,
            couple: force * arm.transpose(),
            position_position: stiffness,
            position_rotation: -stiffness * lever,
            rotation_rotation: -lever * stiffness * lever,
            stiff: true,
        };
        (load, secant)
    }

    /// Force of the friction on the chain, N.
    pub(crate) fn pull(&self, frame: &Pose, coefficient: f64) -> Vector3<f64> {
        let slip = self.slip(frame);
        slip * (-coefficient * self.force * smoothed(slip.norm())[1])
    }

    /// Return mapping: puts the stick point where it is after the frame has come here, behind a place that slides by as much as the
    /// friction gives elastically.
    pub(crate) fn return_map(&mut self, frame: &Pose) {
        let slip = self.slip(frame);
        let kept = (GIVE / slip.norm()).min(1.0); // 1 where the slip is zero
        self.stick_point = self.point(frame) - slip * kept;
    }

    /// Keeps the stick point for a touching point at another arm, on a frame that had these directors when the stick point was set.
    pub(crate) fn on_arm(&mut self, arm: &Vector3<f64>, directors: &Matrix3<f64>) {
        self.stick_point += directors * (arm - self.arm);
        self.arm = *arm;
    }
}

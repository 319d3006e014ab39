//! Applied loads: forces on the rings and the tip, and the moment on the tip, all fixed in the world frame.

use nalgebra::{Matrix3, Vector3};

use super::super::inputs::Inputs;
use super::super::layout::Input;
use super::{Frame, LoadDerivatives, Term};
use crate::geometry::{Pose, hat};
use crate::rod::{Load, Order};

/// The applied loads of the inputs.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Applied<'a>(&'a Inputs);

impl<'a> Applied<'a> {
    pub(crate) fn new(inputs: &'a Inputs) -> Self {
        Self(inputs)
    }

    /// The input, its force (N), and the arm (m) from the frame's origin to its point of application.
    fn force(self, frame: &Frame<'_>, pose: &Pose) -> Option<(Input, Vector3<f64>, Vector3<f64>)> {
        let (input, force, distance) = match frame {
            Frame::Ring(number, body) => {
                (Input::RingForce(*number), self.0.ring_forces.get(*number)?, body.to_centre())
            }
            Frame::Tip(offset) => (Input::TipForce, &self.0.tip_force, *offset),
            Frame::Station(..) | Frame::Section(_) => return None,
        };
        Some((input, *force, pose.axis() * distance))
    }
}

impl Term for Applied<'_> {
    fn acts_on(&self, frame: &Frame<'_>) -> bool {
        match frame {
            Frame::Ring(number, _) => self.0.ring_forces.get(*number).is_some_and(|f| *f != Vector3::zeros()),
            Frame::Tip(_) => self.0.tip_force != Vector3::zeros() || !self.has_potential(),
            Frame::Station(..) | Frame::Section(_) => false,
        }
    }

    fn has_potential(&self) -> bool {
        self.0.tip_moment == Vector3::zeros()
    }

    fn is_symmetric_about(&self, axis: &Pose) -> bool {
        let Inputs { tip_force, tip_moment, ring_forces, .. } = self.0;
        ring_forces.iter().chain([tip_force, tip_moment]).all(|vector| axis.is_along_axis(vector))
    }

    fn load(&self, frame: &Frame<'_>, pose: &Pose, axes: &Matrix3<f64>, _: Order) -> Option<Load> {
        let Some((input, force, arm)) = self.force(frame, pose) else { return Some(Load::zero()) };
        let mut load = Load::fixed_force(&force, &pose.position, &arm);
        if input == Input::TipForce && !self.has_potential() {
            // A fixed moment has no energy and does not turn with the frame: its derivative is not symmetric.
            let turning = hat(&self.0.tip_moment) * -0.5;
            load.couple += turning;
            (load.rotation_rotation, load.stiff) = (turning, true);
        }
        Some(load.in_axes(axes))
    }

    fn add_input_derivatives(&self, frame: &Frame<'_>, pose: &Pose, out: &mut LoadDerivatives) -> Option<()> {
        let Some((input, _, arm)) = self.force(frame, pose) else { return Some(()) };
        for (axis, column) in input.columns().enumerate() {
            let force = Vector3::ith(axis, -1.0);
            out.add(column, &force, &arm.cross(&force));
        }
        if input == Input::TipForce {
            for (axis, column) in Input::TipMoment.columns().enumerate() {
                out.add(column, &Vector3::zeros(), &Vector3::ith(axis, -1.0));
            }
        }
        Some(())
    }
}

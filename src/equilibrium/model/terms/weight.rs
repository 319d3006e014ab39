//! Weight of rings, section material and backbone.

use nalgebra::{Matrix3, Vector3};

use super::super::inputs::Inputs;
use super::super::layout::Input;
use super::{Frame, LoadDerivatives, Term};
use crate::geometry::Pose;
use crate::rod::{Load, Order};

/// Weight of all bodies at this acceleration, m/s2.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Weight(Vector3<f64>);

impl Weight {
    pub(crate) fn new(inputs: &Inputs) -> Self {
        Self(inputs.gravity)
    }

    /// Mass (kg) of the body in a frame, and its first moment about the frame's origin (kg m, world axes).
    fn mass(frame: &Frame<'_>, pose: &Pose) -> Option<(f64, Vector3<f64>)> {
        if let Frame::Ring(_, body) = frame {
            let mass = body.ring.mass;
            return Some((mass, pose.axis() * (body.to_centre() * mass)));
        }
        let material = frame.material()?;
        let first = material.moments.first * material.density;
        let mass = material.density * material.moments.volume + material.line_mass;
        Some((mass, pose.rotation * Vector3::new(first.x, first.y, 0.0)))
    }

    /// The load in world axes.
    fn in_world(&self, frame: &Frame<'_>, pose: &Pose) -> Load {
        let Some((mass, first)) = Self::mass(frame, pose) else { return Load::zero() };
        Load {
            energy: -self.0.dot(&(pose.position * mass + first)),
            force: self.0 * -mass,
            couple: self.0 * first.transpose() * -1.0,
            ..Load::zero()
        }
    }
}

impl Term for Weight {
    fn acts_on(&self, frame: &Frame<'_>) -> bool {
        self.0 != Vector3::zeros() && !matches!(frame, Frame::Tip(_))
    }

    fn is_symmetric_about(&self, axis: &Pose) -> bool {
        axis.is_along_axis(&self.0)
    }

    fn load(&self, frame: &Frame<'_>, pose: &Pose, axes: &Matrix3<f64>, _: Order) -> Option<Load> {
        Some(self.in_world(frame, pose).in_axes(axes))
    }

    fn add_input_derivatives(&self, frame: &Frame<'_>, pose: &Pose, out: &mut LoadDerivatives) -> Option<()> {
        for (axis, column) in Input::Gravity.columns().enumerate() {
            let load = Self(Vector3::ith(axis, 1.0)).in_world(frame, pose);
            out.add(column, &load.force, &load.moment());
        }
        Some(())
    }
}

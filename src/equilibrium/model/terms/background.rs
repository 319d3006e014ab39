//! Uniform and linear background field.

use nalgebra::{Matrix3, Vector2, Vector3};

use super::super::inputs::Inputs;
use super::super::layout::Input;
use super::load_derivatives::{BACKGROUND_INPUTS, FieldRate, LoadDerivatives};
use super::{Frame, Term};
use crate::geometry::Pose;
use crate::magnetics::LinearField;
use crate::rod::{Load, Order};

/// Largest part of a gradient that is not symmetric about an axis and counts as rounding, relative.
const ASYMMETRY: f64 = 1e-9;

/// A field that is linear in the whole world; it acts on a body at its centroid.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Background {
    field: LinearField,
    uniform: bool,
    is_on: bool,
}

impl Background {
    pub(crate) fn new(inputs: &Inputs) -> Self {
        let field = LinearField::new(inputs.uniform_field, inputs.field_gradient);
        let uniform = field.gradient() == Matrix3::zeros();
        Self { field, uniform, is_on: !uniform || inputs.uniform_field != Vector3::zeros() }
    }

    /// The field (T) at a point in the world frame.
    pub(crate) fn at(&self, point: &Vector3<f64>) -> Vector3<f64> {
        self.field.at(point)
    }

    /// Its gradient, T/m.
    pub(crate) fn gradient(&self) -> Matrix3<f64> {
        self.field.gradient()
    }

    /// Derivatives of the field with respect to its inputs at a point in the world frame.
    pub(crate) fn rates(point: &Vector3<f64>) -> [FieldRate; BACKGROUND_INPUTS] {
        core::array::from_fn(|column| {
            if column < 3 {
                return (Vector3::ith(column, 1.0), Matrix3::zeros());
            }
            let entry = core::array::from_fn(|i| f64::from(u8::from(i == column - 3)));
            let gradient = LinearField::new(Vector3::zeros(), entry).gradient();
            (gradient * point, gradient)
        })
    }

    /// Magnetic moment (A m2) of the body in a frame along its direction; zero for the tip.
    fn moment(frame: &Frame<'_>) -> f64 {
        match frame {
            Frame::Ring(_, body) => body.moment,
            _ => frame.material().map_or(0.0, |material| material.magnetisation * material.moments.volume),
        }
    }

    /// Arm from the frame's origin to the centre of that moment, m, world axes.
    fn arm(frame: &Frame<'_>, pose: &Pose) -> Vector3<f64> {
        if let Frame::Ring(_, body) = frame {
            return pose.axis() * body.to_centre();
        }
        let centroid = frame.material().map_or(Vector2::zeros(), |material| material.moments.centroid());
        pose.rotation * Vector3::new(centroid.x, centroid.y, 0.0)
    }
}

impl Term for Background {
    fn acts_on(&self, frame: &Frame<'_>) -> bool {
        self.is_on && !matches!(frame, Frame::Tip(_))
    }

    fn is_symmetric_about(&self, axis: &Pose) -> bool {
        // About its axis a linear field is turned into itself: in its frame the gradient is diagonal, with two equal entries.
        let gradient = axis.rotation.tr_mul(&self.gradient()) * axis.rotation;
        let along = gradient[(2, 2)];
        let symmetric = Matrix3::from_diagonal(&Vector3::new(-0.5 * along, -0.5 * along, along));
        let rest = gradient - symmetric;
        rest.norm() <= ASYMMETRY * gradient.norm() && axis.is_along_axis(&self.at(&axis.position))
    }

    fn load(&self, frame: &Frame<'_>, pose: &Pose, axes: &Matrix3<f64>, order: Order) -> Option<Load> {
        let mut load = Load::zero();
        let moment = Self::moment(frame);
        if moment == 0.0 {
            return Some(load);
        }
        let axis = axes.tr_mul(&frame.direction().seen_in(&pose.rotation));
        if self.uniform {
            let field = axes.tr_mul(&self.at(&pose.position));
            load.energy = -moment * axis.dot(&field);
            load.couple = field * (axis.transpose() * -moment);
            return Some(load);
        }
        let arm = Self::arm(frame, pose);
        let field = axes.tr_mul(&self.at(&(pose.position + arm)));
        let (gradient, arm) = (axes.tr_mul(&self.gradient()) * axes, axes.tr_mul(&arm));
        let flat = (order == Order::Hessian).then(Matrix3::zeros);
        load.add_dipole(moment, &axis, &arm, &field, &gradient, flat.as_ref());
        Some(load)
    }

    fn add_input_derivatives(&self, frame: &Frame<'_>, pose: &Pose, out: &mut LoadDerivatives) -> Option<()> {
        let (first, arm) = (Input::UniformField.columns().start, Self::arm(frame, pose));
        let moment = frame.direction().seen_in(&pose.rotation) * Self::moment(frame);
        out.add_dipole(first, &moment, &arm, &Self::rates(&(pose.position + arm)));
        Some(())
    }
}

//! One arc of constant curvature between rigid ends, and the motion that its bending imposes on what it carries.

use nalgebra::{Matrix3, Vector2, Vector3};

use super::line::Line;
use crate::geometry::{Pose, RotationVector};

/// The arc of one element: its core, or all of a plain rod.
#[derive(Debug, Clone)]
pub(super) struct Arc {
    /// Index of the span that bends.
    pub(super) core: usize,
    /// Rigid lengths before and after the arc, and its own length, m.
    pub(super) before: f64,
    pub(super) after: f64,
    pub(super) length: f64,
    /// Moment per angle, including the lumped compliance of the discs, N m.
    pub(super) stiffness: f64,
}

/// An arc bent by some angles, from its start to the fraction `part` of it.
#[derive(Debug, Clone)]
pub(super) struct Bent {
    /// Axes of the arc's start.
    axes: Matrix3<f64>,
    /// Pose of its end.
    pub(super) pose: Pose,
    /// Derivatives of rotation and displacement of the end with respect to both angles.
    pub(super) turned: [Vector3<f64>; 2],
    pub(super) moved: [Vector3<f64>; 2],
    theta: RotationVector,
    /// Negative rotation vector: its right Jacobian equals the left Jacobian of `theta`.
    back: RotationVector,
    part: f64,
    length: f64,
}

impl Arc {
    pub(super) fn new(line: &Line, element: usize) -> Self {
        let spans = &line.spans[element];
        let core = line.core(element);
        let lengths = |from: usize, to: usize| spans[from..to].iter().map(|span| span.length).sum::<f64>();
        let compliance: f64 = spans.iter().map(|span| span.length / span.stiffness.bending).sum();
        Self {
            core,
            before: line.chain.elements[element].offset + lengths(0, core),
            after: lengths(core + 1, spans.len()),
            length: spans[core].length,
            stiffness: 1.0 / compliance,
        }
    }

    /// The fraction `part` of the arc that starts at `start` and bends in total by `angles` about `d1` and `d2`.
    pub(super) fn bent(&self, start: &Pose, angles: &Vector2<f64>, part: f64) -> Bent {
        let vector = Vector3::new(angles.x, angles.y, 0.0) * part;
        let theta = RotationVector::new(vector);
        let left = theta.left_jacobian();
        let by_vector = theta.left_product_derivative(&Vector3::z());
        let (axes, reach) = (start.rotation, self.length * part);
        Bent {
            pose: Pose {
                position: start.position + axes * left.column(2) * reach,
                rotation: axes * theta.matrix(),
            },
            turned: [0, 1].map(|c| axes * left.column(c) * part),
            moved: [0, 1].map(|c| axes * by_vector.column(c) * (reach * part)),
            back: RotationVector::new(-vector),
            theta,
            axes,
            part,
            length: self.length,
        }
    }
}

impl Bent {
    /// Derivative of `turned[c]`, see [`Bent::turned`], with respect to angle `d`.
    pub(super) fn turned_derivative(&self, c: usize, d: usize) -> Vector3<f64> {
        let mut unit = Vector3::zeros();
        unit[c] = 1.0;
        self.axes * self.theta.left_product_derivative(&unit).column(d) * (self.part * self.part)
    }

    /// Derivative of `force . moved[c]` with respect to angle `d`.
    pub(super) fn moved_derivative(&self, force: &Vector3<f64>) -> Matrix3<f64> {
        let local = self.axes.tr_mul(force);
        self.back.contract_curvature(&local, &Vector3::z()) * (self.length * self.part.powi(3))
    }
}
